"""node-wot reads the device by its Thing Description: raw number times scale is what the driver reads."""

import json
import subprocess
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from regscribe import plugins
from regscribe.export.wot_td.forms import BYTE_SEQUENCES
from regscribe.losses import Exported
from regscribe.model import Order
from regscribe.simulate import find_map, simulate

from .install import consumer
from .stage import UNIT, Held, Stage, readings, staged

pytestmark = pytest.mark.interop("node-wot")

Json = Any

SCRIPT = """
const { Servient } = require('@node-wot/core')
const { ModbusClientFactory } = require('@node-wot/binding-modbus')
const { td, reads, writes } = JSON.parse(require('fs').readFileSync(0))
async function main () {
  const servient = new Servient()
  servient.addClientFactory(new ModbusClientFactory())
  const thing = await (await servient.start()).consume(td)
  const found = { read: {}, errors: {} }
  for (const [name, value] of writes) {
    await thing.writeProperty(name, value).catch((error) => (found.errors[name] = error.message))
  }
  for (const name of reads) {
    try {
      const value = await (await thing.readProperty(name)).value()
      found.read[name] = Number.isNaN(value) ? 'nan' : value
    } catch (error) {
      found.errors[name] = error.message
    }
  }
  console.log(JSON.stringify(found))
  process.exit(0)
}
main()
"""

ORDERED = """\
format: 1
map: {id: test/orders, title: Orders, maker: Nobody, class_prefix: Orders}
manual: {title: None, number: "1", date: "2026"}
models: {One: {}}
protocol: {source: "1", functions: [3, 6, 16], unit_ids: 1..247}
groups:
  - id: orders
    name: Orders
    source: "2"
    each: {access: rw}
    registers:
      - {at: 0, name: Word AB, type: uint16}
      - {at: 1, name: Word BA, type: uint16, byte_order: little}
      - {at: 10, name: Whole ABCD, type: uint32}
      - {at: 12, name: Whole CDAB, type: uint32, word_order: little}
      - {at: 14, name: Whole BADC, type: uint32, byte_order: little}
      - {at: 16, name: Whole DCBA, type: uint32, word_order: little, byte_order: little}
      - {at: 20, name: Float ABCD, type: float32}
      - {at: 22, name: Float CDAB, type: float32, word_order: little}
      - {at: 24, name: Float BADC, type: float32, byte_order: little}
      - {at: 26, name: Float DCBA, type: float32, word_order: little, byte_order: little}
      - {at: 30, name: Double, type: float64}
"""


def node_wot(td: Json, reads: list[str], writes: dict[str, Json] | None = None) -> Json:
    """What node-wot reads, after it has written: values and errors by property."""
    given = json.dumps({"td": td, "reads": reads, "writes": [*(writes or {}).items()]})
    done = subprocess.run(  # noqa: S603 (a fixed program)
        ["node", "-e", SCRIPT],  # noqa: S607 (as it is installed)
        cwd=consumer("node-wot").folder,
        input=given,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        timeout=120,
        check=True,
    )
    return json.loads(done.stdout.splitlines()[-1])


def told(made: Exported, fact: str) -> set[str]:
    return {one.register for one in made.losses if one.fact == fact}


def name_of(path: str) -> str:
    return path.replace("[", "_").replace("]", "").replace(".", "_")


def test_node_wot_reads_what_the_driver_reads(stage: Stage) -> None:
    made = stage.export("wot-td")
    td = json.loads(made.texts[""])  # type: ignore[arg-type]  # a text
    found = node_wot(td, list(td["properties"]))
    paths = {path: name_of(path) for path in stage.held if path not in told(made, "register")}
    assert set(paths.values()) == set(td["properties"])
    # what it cannot read it refuses: long whole numbers, as the report says, and a code that the map does not have
    assert set(found["errors"]) == {name_of(path) for path in told(made, "type-unread")} | {"odd_mode"}
    wrong = {
        path: (found["read"][name], stage.driver[path])
        for path, name in paths.items()
        if name in found["read"] and not agree(found["read"][name], td["properties"][name], stage.held[path])
    }
    assert wrong == {}


def agree(value: Json, said: Json, held: Held) -> bool:
    """Whether a value, with what the description says of it, is the one by hand."""
    if held.fault:
        (fault,) = said["x-faults"]
        return value in (fault.get("from"), fault.get("raw")) and fault["label"].replace(" ", "_") == held.fault
    if isinstance(value, dict):
        return value == (held.fields or {name: name in held.flags for name in value})
    if isinstance(value, str):
        return value.rstrip("\0") == held.value
    if "x-version" in said:
        return ".".join(str(value)) == held.value
    scale = said.get("x-scale", {"multiply": "1", "add": "0"})
    return Fraction(value) * Fraction(scale["multiply"]) + Fraction(scale["add"]) == held.number


def test_node_wot_writes_what_the_driver_then_reads() -> None:
    with staged() as stage:
        td = json.loads(stage.text("wot-td"))
        writes = {
            "setpoint": 1234,
            "delay": 0,
            "limit": 3999999999,
            "gain": 0.5,
            "choice": 3,
            "pump": False,
            "valve": 0,
        }
        assert node_wot(td, [], writes)["errors"] == {}
        found = readings(stage.running)
    assert [found["setpoint"], found["limit"], found["gain"], found["pump"]] == [123.4, 3999999999, 0.5, False]
    assert [found["delay"].name, found["choice"].name, found["valve"].name] == ["OFF", "SLOW", "CLOSED"]


def test_what_node_wot_would_write_in_another_order_is_read_only(tmp_path: Path) -> None:
    # it moves bytes when it reads and not when it writes several registers: what is forced upon it comes out wrong
    path = tmp_path / "orders.yaml"
    path.write_text(ORDERED, encoding="utf-8")
    with simulate(path, unit=UNIT) as running:
        at = f"{running.host}:{running.port}"
        known = {one.name: one.default for one in plugins.exporter("wot-td").options}
        made = plugins.export("wot-td", [find_map(path)], known | {"at": at, "unit": str(UNIT)})
        td = json.loads(made.texts[""])  # type: ignore[arg-type]  # a text
        read_only = {name for name, said in td["properties"].items() if said.get("readOnly")}
        writes = {name: 0x12345678 if name.startswith("whole") else 0x1234 for name in td["properties"]}
        for said in td["properties"].values():
            said.pop("readOnly", None)
            (form,) = said["forms"]
            form["op"] = ["readproperty", "writeproperty"]
        node_wot(td, [], writes)
        wrong = {one.path for one in find_map(path).models[0].registers if running.peek(one.path) != writes[one.path]}
    assert read_only == wrong == told(made, "write") == {"whole_cdab", "whole_badc", "float_cdab", "float_badc"}


def test_only_the_byte_sequence_counts(stage: Stage) -> None:
    # trap: node-wot 0.8.16 ignores modv:mostSignificantWord and modv:zeroBasedAddressing
    td = json.loads(stage.text("wot-td"))
    for said in td["properties"].values():
        for form in said["forms"]:
            for key in ("modv:mostSignificantWord", "modv:mostSignificantByte", "modv:zeroBasedAddressing"):
                form[key] = not form.get(key, True)
    names = [f"f32_{letters}" for letters in ("abcd", "cdab", "badc", "dcba")]
    assert node_wot(td, names)["read"] == dict.fromkeys(names, -1234.5)
    assert BYTE_SEQUENCES[Order.LITTLE, Order.BIG] in td["properties"]["f32_cdab"]["forms"][0]["contentType"]
