"""Node-RED runs the exported flow: it reads what the driver reads, writes what it is told, and refuses the rest."""

import json
import socket
import subprocess
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from regscribe_runtime import SensorFault

from .install import consumer
from .stage import Held, Stage, readings, staged

pytestmark = pytest.mark.interop("node-red")

PATIENCE = 60
"""Seconds for Node-RED to start, and for each answer."""

LEFT_OUT = {"cooling"}
"""What does not exist as the device is stated."""

WRITTEN = {
    "setpoint": 123.4,
    "delay": "off",
    "limit": 3999999999,
    "gain": 0.1,
    "choice": "slow",
    "counter": "-999999999999",
    "pump": False,
    "valve": "closed",
}
REFUSED = {
    "setpoint": (400.1, "setpoint: 400.1 lies outside -50..400"),
    "delay": (101, "delay: 101 lies outside 1..100"),
    "choice": ("warp", 'choice: "warp" is none of off (0), slow (3), fast (7)'),
    "tenth": (1, '"tenth" is none of the registers that this flow writes'),
}
MARK = "SAID "

Json = Any


@dataclass(frozen=True, slots=True)
class Told:
    """What Node-RED printed: messages of the flow's output, and lines of its log."""

    messages: list[Json]
    lines: list[str]

    def merged(self, part: str) -> dict[str, Json]:
        """A part of all messages (payload, codes, notes, units) by path, the newest first."""
        return {path: value for message in self.messages for path, value in message[part].items()}


@dataclass(slots=True)
class NodeRed:
    """A running Node-RED, whose log is followed."""

    process: subprocess.Popen[str]
    log: Path

    def until(self, wanted: Any) -> Told:
        """Wait until what was printed is what is wanted (a function of it)."""
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            lines = self.log.read_text(encoding="utf-8").splitlines()
            told = Told([json.loads(one.partition(MARK)[2]) for one in lines if MARK in one], lines)
            if wanted(told):
                return told
            assert self.process.poll() is None, "\n".join(lines)
            time.sleep(0.2)
        pytest.fail("\n".join(lines[-30:]))


def flow_of(stage: Stage, commands: Mapping[str, Json]) -> list[Json]:
    """The exported flow, with nodes that print all messages and that send commands."""
    nodes: list[Json] = json.loads(stage.text("node-red", writes="yes", every="1"))
    of_type = {one["type"]: one for one in nodes}
    sheet, out, into = of_type["tab"]["id"], of_type["link out"], of_type["link in"]
    plain = {"z": sheet, "x": 0, "y": 0, "name": ""}
    code = f"node.log('{MARK}' + JSON.stringify(msg)); return null"
    nodes += [
        {"id": "0a", "type": "link in", **plain, "links": [out["id"]], "wires": [["0b"]]},
        {"id": "0b", "type": "function", **plain, "func": code, "outputs": 1, "wires": [[]]},
        {"id": "0c", "type": "link out", **plain, "mode": "link", "links": [into["id"]], "wires": []},
    ]
    out["links"], into["links"] = ["0a"], ["0c"]
    for number, (path, value) in enumerate(commands.items()):
        kind = "bool" if isinstance(value, bool) else "str" if isinstance(value, str) else "num"
        said: Json = {"topic": path, "payload": json.dumps(value).strip('"'), "payloadType": kind}
        said |= {"props": [{"p": "payload"}, {"p": "topic", "vt": "str"}], "once": True, "onceDelay": 3 + number / 2}
        nodes.append({"id": f"f{number:x}", "type": "inject", **plain, **said, "repeat": "", "wires": [["0c"]]})
    return nodes


@pytest.fixture(name="run")
def run_fixture(tmp_path: Path) -> Iterator[Any]:
    """Start Node-RED with a flow; it is ended behind the test."""
    begun: list[subprocess.Popen[str]] = []

    def run(nodes: list[Json]) -> NodeRed:
        modules = consumer("node-red").folder / "node_modules"
        (tmp_path / "flows.json").write_text(json.dumps(nodes), encoding="utf-8")
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        settings = {"flowFile": "flows.json", "uiHost": "127.0.0.1", "uiPort": port, "httpAdminRoot": False}
        settings |= {"httpNodeRoot": False, "nodesDir": str(modules / "node-red-contrib-modbus" / "modbus")}
        settings |= {"credentialSecret": False, "userDir": str(tmp_path)}
        (tmp_path / "settings.js").write_text(f"module.exports = {json.dumps(settings)}", encoding="utf-8")
        log = tmp_path / "log"
        command = [
            "node",
            str(modules / "node-red" / "red.js"),
            "-u",
            str(tmp_path),
            "-s",
            str(tmp_path / "settings.js"),
        ]
        with log.open("w", encoding="utf-8") as file:
            process = subprocess.Popen(command, stdout=file, stderr=subprocess.STDOUT, text=True)  # noqa: S603 (fixed)
        begun.append(process)
        return NodeRed(process, log)

    yield run
    for process in begun:
        process.terminate()
        process.wait(timeout=PATIENCE)


def test_node_red_reads_what_the_driver_reads(stage: Stage, run: Any) -> None:
    wanted = set(stage.held) - LEFT_OUT
    told = run(flow_of(stage, {})).until(lambda one: set(one.merged("payload")) >= wanted)
    found, notes = told.merged("payload"), told.merged("notes")
    assert set(found) == wanted
    wrong = {
        path: (found[path], notes.get(path), stage.driver[path])
        for path in wanted
        if not agree(found[path], notes.get(path, ""), stage.held[path], stage.driver[path])
    }
    assert wrong == {}
    assert told.merged("units")["tenth"] == "°C"


def agree(value: Json, note: str, held: Held, read: Any) -> bool:
    """Whether a value of the flow is that of the driver, and the one by hand."""
    if held.fault:
        return value is None and note.replace(" ", "_") == held.fault and isinstance(read, SensorFault)
    if held.special or held.member:
        return (note or value) == (held.special or held.member) == read.name.lower()
    if held.flags or held.fields:
        flags = {name: name in held.flags for name in value} if held.flags else {**(held.fields or {}), "stage": "busy"}
        return bool(value == flags)
    if isinstance(held.value, Fraction) and not isinstance(value, str):
        return value == float(held.number) == float(read)
    return value in {held.value, str(held.value), f"unknown ({held.value})"}


def test_node_red_writes_what_the_driver_then_reads(run: Any) -> None:
    with staged() as stage:
        node_red = run(flow_of(stage, WRITTEN))
        expected = {**WRITTEN, "delay": 0, "counter": -999999999999}
        node_red.until(lambda one: expected.items() <= one.merged("payload").items())
        found = readings(stage.running)
    assert [found["setpoint"], found["limit"], found["gain"], found["counter"]] == [
        123.4,
        3999999999,
        0.1,
        -999999999999,
    ]
    assert [found["delay"].name, found["choice"].name, found["valve"].name] == ["OFF", "SLOW", "CLOSED"]
    assert found["pump"] is False


def test_node_red_writes_nothing_that_the_map_does_not_allow(run: Any) -> None:
    with staged() as stage:
        before = readings(stage.running)
        commands = {path: value for path, (value, _) in REFUSED.items()}
        reasons = [why for _, why in REFUSED.values()]
        run(flow_of(stage, commands)).until(lambda one: all(any(why in line for line in one.lines) for why in reasons))
        after = readings(stage.running)
    assert {path: str(after[path]) for path in REFUSED} == {path: str(before[path]) for path in REFUSED}


def test_a_hostile_label_is_nothing_but_a_text(stage: Stage, run: Any) -> None:
    nodes = flow_of(stage, {})
    (table,) = [
        one["env"][0] for one in nodes if one.get("env") and '"mode"' in str(one["env"]) and one["type"] != "subflow"
    ]
    label = "${HOME} `${x}` {{x}} */ \" '"
    table["value"] = table["value"].replace('"cool"', json.dumps(label))
    told = run(nodes).until(lambda one: "mode" in one.merged("payload"))
    assert told.merged("payload")["mode"] == label
