"""What comes from outside: no terminal or spreadsheet obeys it, and no command breaks on it."""

import csv
import io
import json
import os
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from regscribe.cli.app import run
from regscribe.emit import build_cache
from regscribe.simulate import simulate as simulated
from regscribe.simulate.map_cache import find_map
from regscribe.visible import INVISIBLE, cell, json_text, safe, safe_lines

from .labelled import MAP, put_map

HOSTILE = "\x1b[31mred\x1b]0;title\x07"
LONG = "x" * 300
ENVIRONMENT = {key: value for key, value in os.environ.items() if key != "PYTHONUNBUFFERED"}
"""Unbuffered, Python hides that a reader went away."""


@pytest.fixture
def bench(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[tuple[str, Any]]:
    """A folder with a map and its driver, and a simulated device whose text is hostile."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    put_map(tmp_path)
    assert run(["generate", "--out", "mine"]) == 0
    with simulated("acme/oven", "O1") as device:
        device.poke("label", HOSTILE)
        yield f"tcp:{device.host}:{device.port}?model=O1&unit=1", device


def _said(capsys: pytest.CaptureFixture[str]) -> str:
    found = capsys.readouterr()
    return found.out + found.err


def _is_tame(text: str) -> bool:
    return INVISIBLE.sub(lambda found: "" if found[0] in "\n\t" else "!", text) == text.replace("\n", "").replace(
        "\t", ""
    )


PACKAGE = ["--package", "./mine/regscribe_devices/acme"]


@pytest.mark.parametrize(
    "arguments",
    [
        ["read", "TARGET", "label"],
        ["read", "TARGET", "label", "--json"],
        ["read", "TARGET", HOSTILE],
        ["dump", "TARGET"],
        ["dump", "TARGET", "--json"],
        ["write", "TARGET", "level", HOSTILE],
        ["write", "TARGET", HOSTILE, "1"],
        ["backup", "TARGET"],
        ["diff", "TARGET", "factory"],
        ["diff", "TARGET", HOSTILE],
        ["watch", "TARGET", "label", "--count", "1"],
        ["compare", "acme/oven", "hostile.csv"],
        ["compare", "acme/oven", "hostile.csv", "--format", "csv"],
        ["compare", "acme/oven", "hostile.csv", "--format", "json"],
        ["restore", "TARGET", "hostile.yaml"],
        ["decode", "O1", HOSTILE],
        ["check", "hostile.yaml"],
        ["export", HOSTILE, "--format", "csv"],
        ["read", "kiln", "label"],
        ["identify", "kiln"],
        [HOSTILE],
        ["explain", HOSTILE],
    ],
    ids=lambda one: " ".join(one).replace("\x1b", "ESC").replace("\x07", "BEL"),
)
def test_no_text_from_outside_reaches_the_terminal_as_it_is(
    arguments: list[str], bench: tuple[str, Any], capsys: pytest.CaptureFixture[str]
) -> None:
    target, _ = bench
    Path("hostile.csv").write_text(
        f"address,name,{HOSTILE}\n0,{HOSTILE},{HOSTILE}\n99,=1+1,{HOSTILE}\n", encoding="utf-8"
    )
    Path("hostile.yaml").write_text(f'format: 1\nbackup: "{HOSTILE}"\n{HOSTILE}: 1\n', encoding="utf-8")
    link = json.dumps(f"tcp:{HOSTILE}")
    Path("regscribe.yaml").write_text(
        f'format: 1\npackages: [./mine/regscribe_devices/acme]\ndevices:\n  kiln: {{link: {link}, model: "O1"}}\n',
        encoding="utf-8",
    )
    capsys.readouterr()

    run([target if one == "TARGET" else one for one in arguments])

    said = _said(capsys)
    assert said
    assert _is_tame(said), repr(said)


def test_a_backup_of_any_text_is_read_back(bench: tuple[str, Any], capsys: pytest.CaptureFixture[str]) -> None:
    target, device = bench
    for text in (HOSTILE, "a\rb", "\x7f\x01", "=1+1", "off", " a", "\x0b"):
        device.poke("label", text)
        assert run(["backup", target, "kept.yaml", "--force", *PACKAGE]) == 0
        device.poke("label", "other")
        assert run(["restore", target, "kept.yaml", *PACKAGE]) == 0, _said(capsys)
        assert device.peek("label") == text.rstrip(" ")
        assert run(["diff", target, "kept.yaml", *PACKAGE]) == 0


def test_cells_are_no_formulas_and_hold_no_control_characters() -> None:
    for text in ("=1+1", "\n=1+1", "\t=1", "\r=1", " @A1", "+1|x", "\r\n=cmd|x!A0"):
        assert cell(text).startswith("'")
        row = next(csv.reader(io.StringIO(f'"{cell(text)}"')))
        assert row[0].startswith("'")
    assert cell("-1.5") == "-1.5"
    assert cell("a\x1bb") == "a\\x1bb"


def test_one_door_spells_out_what_a_terminal_obeys() -> None:
    assert safe("a\x1b\x9b\u202eb\n") == "a\\x1b\\x9b\\u202eb\\n"
    assert safe_lines("a\x07\nb") == "a\\x07\nb"
    assert json.loads(json_text({"é": "\x9b\u202e"})) == {"é": "\x9b\u202e"}
    assert _is_tame(json_text({"é": "\x9b\u202e"}))
    assert "é" in json_text("é")


@pytest.mark.parametrize(
    "arguments",
    [
        ["devices", "--package", "."],
        ["devices", "--package", ""],
        ["devices", "--package", LONG],
        ["devices", "--package", ".x"],
        ["devices", "--package", "a..b"],
        ["devices", "--package", "/"],
        ["generate", "--out", LONG],
        ["generate", "--out", "maps/acme/oven.yaml"],
        ["read", "--config", LONG, "oven", "label"],
        ["read", "--config", ".", "oven", "label"],
        ["read", "--config", "", "oven", "label"],
        ["diff", "A", "factory"],
        ["diff", "factory", "factory"],
        ["diff", "", "factory"],
        ["diff", LONG, "factory"],
        ["diff", ".", "factory"],
        ["backup", LONG],
        ["restore", "A", LONG],
        ["restore", "A", "."],
        ["compare", "acme/oven", LONG],
        ["compare", "acme/oven", "."],
        ["program", "show", LONG],
        ["program", "check", LONG],
        ["program", "check", "."],
        ["simulate", "acme/oven", "--state", LONG],
        ["simulate", "acme/oven", "--tcp", LONG],
        ["simulate", "acme/oven", "--serial", LONG],
        ["simulate", LONG],
        ["decode", "O1", LONG],
        ["decode", LONG, "01"],
        ["plan", LONG],
        ["explain", LONG],
        ["new", LONG],
        ["new", f"a/{LONG}"],
        ["scan", LONG],
        ["identify", f"rtu:{LONG}"],
        ["check", LONG],
        ["check", ""],
        ["export", "", "--format", "csv"],
        ["coverage", LONG],
    ],
    ids=lambda one: " ".join(one)[:40],
)
def test_a_strange_argument_is_an_error_of_usage(
    arguments: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    put_map(tmp_path)

    code = run(arguments)

    said = _said(capsys)
    assert code in {1, 2, 3, 74}
    assert "internal error" not in said
    assert "rror" in said or "there is no frame" in said


def _command(*arguments: str) -> list[str]:
    return [sys.executable, "-m", "regscribe", *arguments]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that is always full")
@pytest.mark.parametrize(
    "arguments",
    [
        ["check"],
        ["devices"],
        ["export", "fdc/series-100", "--format", "csv"],
        ["explain", "RS0401"],
        ["--help"],
        ["read", "nobody", "value", "--json"],
    ],
)
def test_a_full_disk_behind_the_output_is_said(arguments: list[str]) -> None:
    with Path("/dev/full").open("w") as full:
        found = subprocess.run(  # noqa: S603 (our own program)
            _command(*arguments), stdout=full, stderr=subprocess.PIPE, text=True, check=False, env=ENVIRONMENT
        )
    assert found.returncode == 74
    assert "standard output: No space left on device" in found.stderr
    assert "internal" not in found.stderr
    assert "Exception ignored" not in found.stderr


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that is always full")
@pytest.mark.parametrize("arguments", [["check", "nothing"], ["-v", "check"], ["decode", "16C", "zz"], ["--nope"]])
def test_a_full_disk_behind_standard_error_has_the_exit_code_of_output(arguments: list[str], tmp_path: Path) -> None:
    put_map(tmp_path)
    found = _with_streams("2>/dev/full", arguments, tmp_path)
    assert found.returncode == 74
    assert _with_streams(">/dev/full 2>/dev/full", arguments, tmp_path).returncode == 74


@pytest.mark.parametrize(
    "arguments", [["check"], ["devices"], ["explain", "RS0401"], ["--version"], ["generate", "--out", "out"]]
)
def test_a_closed_output_is_said_and_nothing_is_done(arguments: list[str], tmp_path: Path) -> None:
    put_map(tmp_path)
    found = _with_streams(">&-", arguments, tmp_path)
    assert found.returncode == 74
    assert found.stderr == "Error: standard output is closed, so nothing was done\n"
    assert not (tmp_path / "out").exists()
    assert _with_streams(">&- 2>&-", arguments, tmp_path).returncode == 74


@pytest.mark.parametrize(
    ("streams", "arguments", "code"),
    [
        ("2>&-", ["check"], 0),
        ("2>&-", ["check", "--nope"], 2),
        ("2>&-", ["read", "tcp:127.0.0.1:1?model=16C", "setpoint_ram"], 3),
        ("2>&- <&-", ["generate", "--out", "out"], 0),
        ("<&-", ["decode", "16C"], 1),
    ],
)
def test_other_closed_streams_change_no_exit_code(
    streams: str, arguments: list[str], code: int, tmp_path: Path
) -> None:
    put_map(tmp_path)
    found = _with_streams(streams, arguments, tmp_path)
    assert found.returncode == code
    assert "internal" not in found.stdout + found.stderr


def _with_streams(streams: str, arguments: list[str], folder: Path) -> subprocess.CompletedProcess[str]:
    """Run the command where a shell has closed some of its streams."""
    line = f"exec {shlex.join(_command(*arguments))} {streams}"
    return subprocess.run(line, shell=True, capture_output=True, text=True, check=False, env=ENVIRONMENT, cwd=folder)  # noqa: S602 (only a shell closes streams)


def test_a_reader_that_goes_away_ends_a_command_as_every_other_tool() -> None:
    with subprocess.Popen(  # noqa: S603 (our own program)
        _command("export", "athena/platinum-x5000", "athena/series-c", "omega/cn8200", "--format", "json"),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=ENVIRONMENT,
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.readline()
        process.stdout.close()
        said = process.stderr.read()
        assert process.wait() == 141
    assert said == b""


def test_several_runs_into_one_new_folder_all_succeed(tmp_path: Path) -> None:
    maps = tmp_path / "maps" / "acme"
    maps.mkdir(parents=True)
    for number in range(4):
        text = MAP.replace("acme/oven", f"acme/oven-{number}").replace(
            "class_prefix: Acme", f"class_prefix: Acme{number}"
        )
        (maps / f"oven-{number}.yaml").write_text(text, encoding="utf-8")
    for attempt in range(2):
        out = tmp_path / f"out-{attempt}"
        environment = {**ENVIRONMENT, "XDG_CACHE_HOME": str(tmp_path / f"cache-{attempt}")}
        runs = [
            subprocess.Popen(  # noqa: S603 (our own program)
                _command("generate", "--out", str(out)),
                cwd=tmp_path,
                env=environment,
                stderr=subprocess.PIPE,
                text=True,
            )
            for _ in range(3)
        ]
        ends = [(one.communicate()[1], one.returncode) for one in runs]
        assert [code for _, code in ends] == [0, 0, 0], ends
        assert not list(out.rglob("*.tmp"))
        check = subprocess.run(  # noqa: S603 (our own program)
            _command("generate", "--out", str(out), "--check"), cwd=tmp_path, env=environment, check=False
        )
        assert check.returncode == 0


def test_what_a_killed_run_left_is_removed_and_what_another_writes_is_not(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    put_map(tmp_path)
    assert run(["generate", "--out", "out"]) == 0
    driver = next(Path("out").rglob("oven.py"))
    with subprocess.Popen([sys.executable, "-c", "pass"]) as gone:
        gone.wait()
    left = driver.with_name(f".oven.py.{gone.pid}.tmp")
    mine = driver.with_name(f".oven.py.{os.getpid()}.tmp")
    for path in (left, mine):
        path.write_bytes(driver.read_bytes())

    assert run(["generate", "--out", "out"]) == 0

    assert not left.exists()
    assert mine.exists()


def _local(tmp_path: Path) -> Path:
    folder = tmp_path / "maps"
    for name in ("acme", "athena"):
        (folder / name).mkdir(parents=True)
    lines = [
        "format: 1",
        "map: {id: acme/mine, title: Mine, maker: Acme, class_prefix: Mine}",
        "extends: athena/series-c",
        'manual: {title: Manual, number: "1"}',
        "models: {M16: {from: 16C}}",
    ]
    (folder / "acme" / "mine.yaml").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return folder


def test_a_file_that_begins_or_ceases_to_shadow_a_shipped_one_is_noticed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    folder = _local(tmp_path)
    shipped = Path(build_cache.__file__).parents[3] / "maps" / "athena" / "series-c.yaml"
    arguments = ["generate", str(folder / "acme" / "mine.yaml"), "--out", "out"]
    assert run(arguments) == 0, _said(capsys)
    first = {path: path.read_bytes() for path in Path("out").rglob("mine.*")}
    (folder / "athena").mkdir(exist_ok=True)
    shadow = folder / "athena" / "series-c.yaml"
    shadow.write_text(
        shipped.read_text(encoding="utf-8").replace("name: Input Filter,", "name: Shadowed Filter,"), encoding="utf-8"
    )
    capsys.readouterr()

    assert run(arguments) == 0
    second = {path: path.read_bytes() for path in Path("out").rglob("mine.*")}
    shadow.unlink()
    assert run(arguments) == 0
    third = {path: path.read_bytes() for path in Path("out").rglob("mine.*")}

    assert second != first
    assert third == first


USING = """
format: 1
map: {id: acme/user, title: User, maker: Acme, class_prefix: User}
uses: [acme/names]
manual: {title: Manual, number: "1"}
models: {U1: {}}
groups:
  - id: all
    name: All
    source: "1"
    registers:
      - {at: 0, name: Mode, type: uint16, access: r, enum: mode}
"""
NAMES = """
format: 1
library: {id: acme/names, title: Names}
enums:
  mode: {0: idle, 1: CODE}
"""


def test_a_link_that_leads_elsewhere_is_noticed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    folder = tmp_path / "maps" / "acme"
    folder.mkdir(parents=True)
    (folder / "user.yaml").write_text(USING, encoding="utf-8")
    for name in ("auto", "manual"):
        (tmp_path / name).write_text(NAMES.replace("CODE", name), encoding="utf-8")
    link = folder / "names.library.yaml"
    link.symlink_to(tmp_path / "auto")
    assert run(["generate", "maps/acme/user.yaml", "--out", "out"]) == 0, _said(capsys)
    link.unlink()
    link.symlink_to(tmp_path / "manual")

    assert run(["generate", "maps/acme/user.yaml", "--out", "out"]) == 0

    assert "MANUAL" in "".join(path.read_text(encoding="utf-8") for path in Path("out").rglob("*.py"))


def test_a_simulator_notices_a_file_that_begins_to_shadow_a_shipped_one(tmp_path: Path) -> None:
    folder = _local(tmp_path)
    shipped = Path(build_cache.__file__).parents[3] / "maps" / "athena" / "series-c.yaml"
    mine = folder / "acme" / "mine.yaml"
    before = find_map(mine)
    shadow = folder / "athena" / "series-c.yaml"
    shadow.write_text(
        shipped.read_text(encoding="utf-8").replace("name: Input Filter,", "name: Shadowed Filter,"), encoding="utf-8"
    )

    assert find_map(mine) is not before
    assert "shadowed_filter" in {register.path for register in find_map(mine).models[0].registers}


@pytest.mark.parametrize("spoil", ["flip", "cut", "swap", "empty", "append"])
def test_a_spoilt_cache_is_not_believed(
    spoil: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    maps = tmp_path / "maps" / "acme"
    maps.mkdir(parents=True)
    for number in range(2):
        text = MAP.replace("acme/oven", f"acme/oven-{number}").replace(
            "class_prefix: Acme", f"class_prefix: Acme{number}"
        )
        (maps / f"oven-{number}.yaml").write_text(text, encoding="utf-8")
    assert run(["generate", "--out", "out"]) == 0
    good = {path: path.read_bytes() for path in Path("out").rglob("*") if path.is_file()}
    (record,) = (tmp_path / "cache" / "regscribe").iterdir()
    whole = record.read_bytes()
    for place in range(70, len(whole), max(1, len(whole) // 12)):
        changed = {
            "flip": whole[:place] + bytes([whole[place] ^ 1]) + whole[place + 1 :],
            "cut": whole[:place],
            "swap": whole.replace(b"oven-0", b"oven-X").replace(b"oven-1", b"oven-0").replace(b"oven-X", b"oven-1"),
            "empty": b"",
            "append": whole + b" ",
        }[spoil]
        record.write_bytes(changed)
        (maps / "oven-1.yaml").write_text((maps / "oven-1.yaml").read_text(encoding="utf-8") + "\n", encoding="utf-8")
        assert run(["generate", "--out", "out"]) == 0
        index = (Path("out") / "docs" / "README.md").read_bytes()
        assert index == good[Path("out") / "docs" / "README.md"]
        if spoil in {"swap", "empty", "append"}:
            break
    capsys.readouterr()
    assert run(["generate", "--out", "out", "--check"]) == 0


@pytest.mark.parametrize("form", ["8E1", "7O2"])
def test_a_simulated_line_with_parity_is_opened_again_and_again(form: str) -> None:
    from regscribe_devices.athena.series_c import Athena16C  # noqa: PLC0415 (as above)
    from regscribe_runtime.driver.device import serial_link  # noqa: PLC0415 (for this test alone)

    with simulated("athena/series-c", "16C", transport="pty") as device:
        for _ in range(3):
            link = serial_link(
                Athena16C.protocol, device.path, data_bits=int(form[0]), parity=form[1], stop_bits=int(form[2])
            )
            with Athena16C(link, unit=1) as controller:
                controller.setpoint_ram.read()
