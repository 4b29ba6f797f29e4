"""`regscribe export`: where it goes, what it chooses, how it tells its losses, and what it refuses."""

import io
import json
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from .conftest import PLAIN

Cli = Callable[..., Any]
HEADER = ("export", "acme/oven", "--format", "c-header")
TELEGRAF = ("export", "acme/oven", "--format", "telegraf", "--at", "10.0.0.7:502")


@pytest.fixture
def wide(oven: Path) -> Path:
    """The map with a register that exists under a condition, and a second group."""
    more = (
        "      - {at: 3, name: Boost, when: {mode: run}}\n"
        '  - {id: alarm, name: Alarm, source: "2", each: {access: rw}, '
        "registers: [{at: 9, name: Alarm Limit}, {at: 10, name: Alarm Delay}]}\n"
    )
    oven.write_text(PLAIN + more, encoding="utf-8")
    return oven


@pytest.mark.usefixtures("oven")
def test_the_export_goes_to_standard_output_and_the_report_to_standard_error(cli: Cli) -> None:
    done = cli(*HEADER)
    assert done.code == 0
    assert "#define ACMEM1_SETPOINT_ADDR 1u\n" in done.out
    assert done.err.splitlines()[:2] == [
        "c-header: verified with gcc 12 (C99) and g++ 12 (C++11)",
        "c-header cannot say everything: 2 cosmetic",
    ]
    assert "c-header cannot" not in done.out


@pytest.mark.usefixtures("oven")
def test_an_export_without_losses_says_nothing_besides(cli: Cli) -> None:
    done = cli("export", "acme/oven", "--format", "json", "--strict")
    assert (done.code, done.err) == (0, "")
    assert json.loads(done.out)["maps"][0]["id"] == "acme/oven"


@pytest.mark.usefixtures("oven")
def test_strict_writes_nothing_and_fails(cli: Cli, folder: Path) -> None:
    done = cli(*HEADER, "--strict", "-o", "oven.h")
    assert done.code == 1
    assert not (folder / "oven.h").exists()
    assert "nothing was exported: c-header cannot say everything" in done.err
    printed = cli(*HEADER, "--strict")
    assert (printed.code, printed.out) == (1, "")


@pytest.mark.usefixtures("oven")
def test_the_report_as_json_has_each_register_and_each_loss(cli: Cli) -> None:
    report = json.loads(cli(*HEADER, "--report", "json").err)
    assert (report["format"], report["export"]) == (1, "c-header")
    assert report["losses"] == [
        {"register": path, "fact": "default", "grade": "cosmetic", "done": "left out: default", "model": "M1"}
        for path in ("setpoint", "mode")
    ]


@pytest.mark.parametrize("report", ["json", "sarif"])
def test_warnings_do_not_stand_before_a_report_that_programs_read(cli: Cli, oven: Path, report: str) -> None:
    oven.write_text(PLAIN + "      - {at: 3, name: Setpoint, id: other}\n", encoding="utf-8")
    assert "RS0413" in cli(*HEADER).err
    assert isinstance(json.loads(cli(*HEADER, "--report", report).err), dict)
    assert "RS0413" in cli(*HEADER, "--report", report, "--report-to", "losses").err


@pytest.mark.usefixtures("oven")
def test_the_report_as_sarif_is_valid_and_has_each_loss(cli: Cli) -> None:
    (run,) = json.loads(cli(*TELEGRAF, "--report", "sarif").err)["runs"]
    rules = {result["ruleId"] for result in run["results"]}
    assert {"telegraf/default", "telegraf/enum", "telegraf/write"} <= rules
    (enum,) = [result for result in run["results"] if result["ruleId"] == "telegraf/enum"]
    place = enum["locations"][0]["physicalLocation"]
    assert place["artifactLocation"]["uri"].endswith("maps/acme/oven.yaml")
    assert place["region"]["startLine"] == 14  # where `Mode` stands


@pytest.mark.usefixtures("oven")
@pytest.mark.parametrize("report", ["text", "json", "sarif"])
def test_the_report_goes_into_a_file(cli: Cli, folder: Path, report: str) -> None:
    done = cli(*HEADER, "-o", "oven.h", "--report", report, "--report-to", "losses")
    assert (done.code, done.out, done.err) == (0, "", "wrote oven.h: 3 kB\n")
    assert "default" in (folder / "losses").read_text(encoding="utf-8")
    assert (folder / "oven.h").read_text(encoding="utf-8").endswith("#endif /* ACMEM1_H */\n")


@pytest.mark.usefixtures("wide")
def test_what_is_worse_is_told_first(cli: Cli) -> None:
    kinds = [
        line.split(":")[0].strip() for line in cli(*TELEGRAF, "--with", "mode=run").err.splitlines() if line[:2] == "  "
    ]
    assert kinds[0] == "wrong if the device is set otherwise"
    assert kinds == sorted(kinds, key=["wrong if the device is set otherwise", "lost", "cosmetic"].index)


@pytest.mark.usefixtures("wide")
@pytest.mark.parametrize(
    ("choice", "there", "gone"),
    [
        (("--group", "alarm"), ["ALARM_LIMIT", "ALARM_DELAY"], ["SETPOINT", "MODE"]),
        (("--register", "alarm_*"), ["ALARM_LIMIT", "ALARM_DELAY"], ["SETPOINT", "MODE"]),
        (("--register", "*limit"), ["ALARM_LIMIT"], ["ALARM_DELAY", "SETPOINT"]),
        (("--register", "mode", "--register", "setpoint"), ["SETPOINT", "MODE"], ["ALARM_LIMIT"]),
        (("--group", "alarm", "--register", "mode"), ["ALARM_LIMIT", "MODE"], ["SETPOINT"]),
    ],
)
def test_groups_and_patterns_choose_registers(
    cli: Cli, choice: tuple[str, ...], there: list[str], gone: list[str]
) -> None:
    text = cli(*HEADER, *choice).out
    assert [name for name in there if f"ACMEM1_{name}_ADDR" not in text] == []
    assert [name for name in gone if f"ACMEM1_{name}_ADDR" in text] == []


@pytest.mark.usefixtures("wide")
@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--model", "M2"), "acme/oven has no model `M2`: it has M1; did you mean `M1`?"),
        (("--group", "alarms"), "--group alarms: M1 has the groups control, alarm"),
        (
            ("--register", "alarm_limits"),
            "--register alarm_limits: M1 has no such register; did you mean `alarm_limit`?",
        ),
        (("--register", "x*"), "--register x*: M1 has no such register"),
        (("--with", "mode=go"), "--with mode=go: the value of `mode` is a number or one of STOP, RUN"),
        (
            ("--with", "mode=70000"),
            "--with mode=70000: the device cannot hold 70000 in `mode`, which is",
        ),
        (("--with", "gone=1"), "--with gone=1: write PATH=VALUE, PATH being a register of M1"),
        (("--given", "card=1"), "--given card=1: write ID=VALUE; acme/oven has the givens (none)"),
        (("--at", "10.0.0.7:502"), "--at: the format c-header takes no such option"),
    ],
)
def test_unknown_names_are_wrong_usage(cli: Cli, arguments: tuple[str, ...], said: str) -> None:
    done = cli(*HEADER, *arguments)
    assert (done.code, done.out) == (2, "")
    assert said in done.err.replace("'", "")


@pytest.mark.usefixtures("oven")
def test_an_unknown_format_is_wrong_usage_that_names_those_there_are(cli: Cli) -> None:
    done = cli("export", "acme/oven", "--format", "c-heads")
    assert done.code != 0
    assert "c-header" in done.err


@pytest.mark.usefixtures("oven")
def test_a_format_for_a_device_needs_to_know_where_it_answers(cli: Cli) -> None:
    done = cli("export", "acme/oven", "--format", "telegraf")
    assert (done.code, done.out) == (2, "")
    assert "--at" in done.err


@pytest.mark.usefixtures("oven")
@pytest.mark.parametrize("arguments", [("-o", "gone/oven.h"), ("-o", "oven.h", "--report-to", "gone/losses")])
def test_a_place_that_cannot_be_written_is_told_in_one_message(cli: Cli, arguments: tuple[str, ...]) -> None:
    done = cli(*HEADER, *arguments)
    assert (done.code, done.out) == (74, "")
    assert "gone/" in done.err
    assert "cannot be written (No such file or directory)" in done.err


@pytest.mark.usefixtures("oven")
def test_the_report_does_not_take_the_place_of_the_export(cli: Cli, folder: Path) -> None:
    done = cli(*HEADER, "-o", "oven.h", "--report-to", "./oven.h")
    assert (done.code, done.out) == (2, "")
    assert "--out and --report-to are both oven.h" in done.err
    assert not (folder / "oven.h").exists()


@pytest.mark.usefixtures("oven")
@pytest.mark.parametrize("host", ['h"', "a b", "h/x", "u@h"])
def test_a_host_that_no_address_can_have_is_refused(cli: Cli, host: str) -> None:
    done = cli("export", "acme/oven", "--format", "telegraf", "--at", f"{host}:502")
    assert (done.code, done.out) == (2, "")
    assert "write HOST:PORT" in done.err


@pytest.mark.usefixtures("oven")
def test_a_folder_is_no_file(cli: Cli, folder: Path) -> None:
    (folder / "there").mkdir()
    done = cli(*HEADER, "-o", "there")
    assert done.code == 2
    assert "the format c-header makes one file, and this is a folder" in done.err
    assert list((folder / "there").iterdir()) == []


@pytest.mark.usefixtures("oven")
def test_a_file_that_was_there_stays_whole_if_the_export_is_refused(cli: Cli, folder: Path) -> None:
    (folder / "oven.h").write_text("mine", encoding="utf-8")
    assert cli(*HEADER, "--model", "M2", "-o", "oven.h").code == 2
    assert cli(*HEADER, "--strict", "-o", "oven.h").code == 1
    assert (folder / "oven.h").read_text(encoding="utf-8") == "mine"
    assert {path.name for path in folder.iterdir()} == {"maps", "oven.h"}


@pytest.mark.usefixtures("oven")
def test_bytes_go_into_a_file_and_through_a_pipe(cli: Cli, folder: Path) -> None:
    assert cli("export", "acme/oven", "--format", "xlsx", "-o", "oven.xlsx").code == 0
    written = (folder / "oven.xlsx").read_bytes()
    assert zipfile.is_zipfile(io.BytesIO(written))
    command = [sys.executable, "-m", "regscribe", "export", "acme/oven", "--format", "xlsx"]
    piped = subprocess.run(command, capture_output=True, timeout=60, check=True)  # noqa: S603 - our own
    assert piped.stdout == written


@pytest.mark.usefixtures("oven")
def test_a_reader_that_goes_away_ends_the_export_without_a_word(folder: Path) -> None:
    command = f"{sys.executable} -m regscribe export acme/oven --format json 2>said | true; echo ${{PIPESTATUS[0]}}"
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, timeout=60, check=True)  # noqa: S603, S607 - our own
    assert done.stdout.strip() in {"0", "141"}
    assert (folder / "said").read_text(encoding="utf-8") == ""
