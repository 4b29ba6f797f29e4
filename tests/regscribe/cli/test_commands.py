import csv
import io
import json
import re
import signal
import socket
import struct
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from regscribe.checks import catalogue
from regscribe.model import Order
from regscribe.pipeline import compile_map
from regscribe.simulate import simulate


@pytest.mark.parametrize("rule", [rule.id for rule in catalogue.all_rules()])
def test_every_rule_can_be_explained(cli: Callable[..., Any], rule: str) -> None:
    result = cli("explain", rule)
    assert (result.code, result.err) == (0, "")
    assert f"[{rule}]: " in result.out


def test_an_explanation_marks_the_lines_in_which_bad_and_good_differ(cli: Callable[..., Any]) -> None:
    out = cli("explain", "rs0109").out
    bad, good = out.split("\nBad:\n")[1].split("\nGood:\n")
    assert [line for line in bad.splitlines() if line.startswith("- ")]
    assert not [line for line in good.splitlines() if line.startswith("- ")]


def test_an_explanation_without_docstrings_leaves_the_reason_out(
    cli: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    bare = tuple(replace(rule, why="") for rule in catalogue.all_rules())  # as python -OO has them
    monkeypatch.setattr(catalogue, "all_rules", lambda: bare)
    assert cli("explain", "RS0401").out.startswith("error[RS0401]: Addresses overlap\n\nBad:\n")


def test_without_a_rule_all_rules_are_listed_by_what_they_are_about(cli: Callable[..., Any]) -> None:
    result = cli("explain")
    listed = [line.split("  ")[0] for line in result.out.splitlines() if not line.startswith("#")]
    assert (result.code, result.err) == (0, "")
    assert sorted(listed) == [rule.id for rule in catalogue.all_rules()]
    assert "# changes between two versions\nRS0701  " in result.out


def test_rules_are_listed_for_programs(cli: Callable[..., Any]) -> None:
    every = json.loads(cli("explain", "--format", "json").out)["rules"]
    (one,) = json.loads(cli("explain", "rs0401", "--format", "json").out)["rules"]
    assert [rule["rule"] for rule in every] == [rule.id for rule in catalogue.all_rules()]
    assert one in every
    assert (one["rule"], one["severity"], one["title"]) == ("RS0401", "error", "Addresses overlap")


@pytest.mark.parametrize("name", ["acme/oven", "acme/oven-3", "my-maker/the-3rd-family", "a/b", "true/no", "3m/93-pm"])
def test_a_new_map_passes_check(cli: Callable[..., Any], name: str) -> None:
    result = cli("new", name)
    assert (result.code, result.err) == (0, "")
    assert result.out == f"maps/{name}.yaml is ready to be filled in; then: regscribe check maps/{name}.yaml\n"
    assert cli("check", "--strict").out == "1 map checked: no findings\n"


@pytest.mark.usefixtures("folder")
def test_a_new_map_names_a_schema_that_exists(cli: Callable[..., Any]) -> None:
    for folder in ("maps", "deep/er"):
        cli("new", "acme/oven", "--dir", folder)
        path = Path(folder, "acme", "oven.yaml")
        (schema,) = re.findall(r"\$schema=(\S+)", path.read_text())
        assert json.loads((path.parent / schema).read_text())["$schema"].startswith("https://json-schema.org/")


@pytest.mark.usefixtures("folder")
def test_a_new_map_uses_the_schema_beside_the_maps(cli: Callable[..., Any]) -> None:
    Path("schema").mkdir()
    Path("schema/map.schema.json").write_text("{}")
    cli("new", "acme/oven")
    assert "$schema=../../schema/map.schema.json\n" in Path("maps/acme/oven.yaml").read_text()
    assert not Path("maps/map.schema.json").exists()


def test_a_new_map_makes_a_driver_that_can_be_imported(cli: Callable[..., Any], process: Callable[..., Any]) -> None:
    cli("new", "acme/oven-3")
    assert cli("generate").code == 0
    script = "from regscribe_devices.acme.oven_3 import AcmeBasic, AcmePlus; print(AcmePlus.model)"
    assert process(script, python=True, env={"PYTHONPATH": "generated"}).out == "Plus\n"


KINDS = (
    *("holding", "input", "coil", "discrete", "float32", "uint32", "int16", "string"),
    *("enum", "flags", "fields", "boolean", "number", "integer"),
)
"""What a beginner must find an example of."""


def test_a_new_map_shows_every_common_kind_of_register(cli: Callable[..., Any]) -> None:
    cli("new", "acme/oven")
    found = compile_map(Path("maps/acme/oven.yaml")).map
    assert found is not None
    registers = found.model("Plus").registers
    shown = {str(each) for one in registers for each in (one.base.space, one.base.type, one.kind)}

    assert set(KINDS) - shown == set()
    assert any(one.base.order is Order.LITTLE for one in registers)
    assert any(one.sentinels for one in registers)
    assert any(one.specials for one in registers)
    assert any(one.index for one in registers)


def test_the_tests_of_a_new_map_pass(cli: Callable[..., Any], folder: Path) -> None:
    cli("new", "acme/oven")
    cli("generate")
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "generated/tests"]
    done = subprocess.run(  # noqa: S603 - our own command
        command, cwd=folder, check=False, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout


def test_an_id_that_starts_with_a_digit_is_a_module_with_an_n_in_front(
    cli: Callable[..., Any], process: Callable[..., Any]
) -> None:
    cli("new", "3m/93-pm")
    assert cli("generate").code == 0
    script = "from regscribe_devices.n3m.n93_pm import N3MPlus; print(N3MPlus.map_id)"
    assert process(script, python=True, env={"PYTHONPATH": "generated"}).out == "3m/93-pm\n"
    assert "from regscribe_devices.n3m.n93_pm import N3MBasic" in Path("generated/docs/3m/93-pm.md").read_text()


@pytest.mark.usefixtures("oven")
def test_of_a_map_with_one_model_no_command_asks_for_the_model(cli: Callable[..., Any]) -> None:
    assert "M1" in cli("plan", "acme/oven", "--all").out
    assert "M1" in cli("export", "acme/oven", "--format", "collectd", "--at", "127.0.0.1:502").out
    with simulate("maps/acme/oven.yaml") as running:
        assert running.device.model.name == "M1"


@pytest.mark.usefixtures("oven")
def test_export_prints_a_table_or_a_document_to_standard_output(cli: Callable[..., Any]) -> None:
    rows = list(csv.DictReader(io.StringIO(cli("export", "--format", "csv").out)))
    assert [(row["map"], row["model"], row["id"], row["address"]) for row in rows] == [
        ("acme/oven", "M1", "setpoint", "1"),
        ("acme/oven", "M1", "mode", "2"),
    ]
    assert "acme/oven" in json.dumps(json.loads(cli("export", "acme/oven", "--format", "json").out))


def test_export_prints_nothing_of_a_map_that_is_wrong(cli: Callable[..., Any], oven: Path) -> None:
    oven.with_name("bad.yaml").write_text("")
    result = cli("export", "--format", "csv")
    assert (result.code, result.out) == (1, "")
    assert "nothing was exported" in result.err


def test_a_simulated_device_answers_over_tcp_until_ctrl_c(folder: Path, oven: Path) -> None:
    command = [sys.executable, "-u", "-c", "from regscribe.cli import main; main()"]
    arguments = ["simulate", str(oven), "--model", "M1", "--tcp", "127.0.0.1:0", "--unit", "7"]
    with subprocess.Popen(  # noqa: S603 - our own command
        [*command, *arguments], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as running:
        assert running.stdout is not None
        line = running.stdout.readline()
        found = re.fullmatch(r"Oven M1 answers as unit 7 on 127\.0\.0\.1:(\d+); Ctrl-C stops it\n", line)
        assert found, line
        with socket.create_connection(("127.0.0.1", int(found[1])), timeout=10) as client:
            client.sendall(struct.pack(">HHHBBHH", 1, 0, 6, 7, 3, 1, 1))
            assert client.recv(64) == struct.pack(">HHHBBBh", 1, 0, 5, 7, 3, 2, 200)
        running.send_signal(signal.SIGINT)
        _, err = running.communicate(timeout=20)
    assert (running.returncode, err.strip()) == (130, "")


def test_a_simulated_device_asks_for_its_givens(cli: Callable[..., Any]) -> None:
    arguments = ["simulate", "fdc/series-100", "--model", "C21", "--rtu", "/dev/no-such-tty"]
    result = cli(*arguments)
    assert (result.code, "--given linear_inputs=" in result.err) == (2, True)
    assert cli(*arguments, "--given", "linear_inputs=1,14..16").code == 1
    for wrong in ("linear_inputs", "linear_inputs=", "linear_inputs=9..1", "linear_inputs=0..999999", "x=1"):
        assert cli(*arguments, "--given", wrong).code == 2
