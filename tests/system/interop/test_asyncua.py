"""asyncua loads the nodeset, makes a device of its type, and a client finds every register once, with all it needs."""

import json
import struct
import subprocess
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from regscribe import plugins
from regscribe.model import Kind, Register
from regscribe.simulate import find_map

from .install import consumer
from .stage import Stage

pytestmark = pytest.mark.interop("asyncua")

HERE = Path(__file__).parent
CEFACT = "http://www.opcfoundation.org/UA/units/un/cefact"
CODES = {"int16": "h", "uint16": "H", "int32": "i", "uint32": "I", "int64": "q", "uint64": "Q"}
CODES |= {"float16": "e", "float32": "f", "float64": "d"}
PARTS = {"meanings/parts/zone", "meanings/parts/level", "meanings/parts/stage"}


def browsed(nodeset: str, kind: str, folder: Path) -> dict[str, Any]:
    """Return what asyncua found in a nodeset."""
    (folder / "nodeset.xml").write_text(nodeset, encoding="utf-8")
    command = [consumer("asyncua").python, HERE / "browse.py", folder / "nodeset.xml", kind]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)  # noqa: S603 - our own
    assert done.returncode == 0, done.stderr[-2000:]
    found: dict[str, Any] = json.loads(done.stdout)
    return found


@pytest.fixture(scope="module")
def loaded(stage: Stage, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What a client finds of the device."""
    return browsed(stage.text("opcua-nodeset"), "InteropOne", tmp_path_factory.mktemp("nodeset"))


@pytest.fixture(scope="module")
def found(loaded: dict[str, Any]) -> dict[str, Any]:
    """The variables by path."""
    variables: dict[str, Any] = loaded["found"]
    return variables


def test_every_register_is_there_once_and_takes_a_value_of_its_type(
    stage: Stage, loaded: dict[str, Any], found: dict[str, Any]
) -> None:
    registers = stage.running.device.model.registers
    assert set(found) - PARTS == {f"{one.group}/{one.path}" for one in registers}
    assert set(found) >= PARTS
    assert loaded["read"] == len(registers)


def test_what_its_properties_say_decodes_what_our_driver_reads(stage: Stage, found: dict[str, Any]) -> None:
    memory = {
        (one.base.space.value, one.address + place): word
        for one in stage.running.device.model.registers
        for place, word in enumerate(stage.held[one.path].words)
    }
    wrong = {}
    for one in stage.running.device.model.registers:
        told = found[f"{one.group}/{one.path}"]["properties"]
        place = range(told["ModbusAddress"], told["ModbusAddress"] + told["ModbusWords"])
        words = [memory[told["ModbusSpace"], at] for at in place]
        if not agrees(stage, one, told, words):
            wrong[one.path] = told
    assert wrong == {}


def agrees(stage: Stage, one: Register, told: dict[str, Any], words: list[int]) -> bool:
    """Whether the words, decoded by the properties alone, are the value by hand and of our driver."""
    expected, read = stage.held[one.path], stage.driver[one.path]
    if told["ModbusSpace"] in {"coil", "discrete"}:
        return words == [int(expected.number)]
    data = arranged(words, told["ModbusOrder"])
    if told["ModbusType"] not in CODES:
        return data == arranged(list(expected.words), told["ModbusOrder"])
    raw = struct.unpack(f">{CODES[told['ModbusType']]}", data)[0]
    if expected.fault:
        return [f"{raw:g} = {expected.fault.replace('_', ' ')}"] == told["ModbusFaults"]
    if one.kind is Kind.VERSION:
        return bool(raw == 123)
    scale, offset = (
        Fraction(told.get("ModbusScale", "1").replace("not stated", "1")),
        Fraction(told.get("ModbusOffset", "0")),
    )
    value = Fraction(raw) * scale + offset
    return value == expected.number and (expected.special != "" or float(read) == float(value))


def arranged(words: list[int], order: str) -> bytes:
    """The bytes of words, the most significant first."""
    turned = words[:: -1 if order in {"CDAB", "DCBA"} else 1]
    return b"".join(word.to_bytes(2, "little" if order in {"BADC", "DCBA"} else "big") for word in turned)


@pytest.mark.parametrize(
    ("path", "kind", "data", "access", "properties"),
    [
        ("orders/i64_dcba", "BaseDataVariableType", "Int64", 1, {"ModbusOrder": "DCBA", "ModbusWords": 4}),
        ("orders/f32_abcd", "BaseDataVariableType", "Float", 1, {"ModbusType": "float32"}),
        (
            "scales/tenth",
            "BaseAnalogType",
            "Double",
            1,
            {"EngineeringUnits": {"unit": "°C", "id": 4408652, "namespace": CEFACT}, "ModbusScale": "0.1"},
        ),
        ("scales/third", "BaseAnalogType", "Double", 1, {"ModbusScale": "1/3", "ModbusOffset": "0"}),
        ("settings/setpoint", "BaseAnalogType", "Double", 3, {"EURange": [-50.0, 400.0]}),
        ("settings/limit", "BaseAnalogType", "UInt32", 3, {"EURange": [0.0, 4000000000.0]}),
        ("settings/delay", "BaseAnalogType", "UInt16", 3, {"ModbusSpecialValues": ["0 = off"]}),
        (
            "meanings/trend",
            "MultiStateValueDiscreteType",
            "Int16",
            1,
            {"EnumValues": [[-1, "falling"], [0, "steady"], [1, "rising"]]},
        ),
        (
            "meanings/status",
            "OptionSetType",
            "UInt16",
            1,
            {"OptionSetValues": ["heating", *[None] * 2, "alarm", *[None] * 11, "fault"]},
        ),
        ("meanings/parts/level", "BaseDataVariableType", "UInt16", 1, {"ModbusBits": "4..11"}),
        (
            "meanings/parts/stage",
            "MultiStateValueDiscreteType",
            "UInt16",
            1,
            {"EnumValues": [[9, "idle"], [10, "busy"]]},
        ),
        ("meanings/cooling", "BaseAnalogType", "Double", 1, {"ModbusExists": ["mode is 2"]}),
        ("meanings/enabled", "BaseDataVariableType", "Boolean", 1, {"ModbusAddress": 141}),
        ("coils/valve", "TwoStateDiscreteType", "Boolean", 3, {"FalseState": "closed", "TrueState": "opened"}),
        ("texts/key", "BaseDataVariableType", "ByteString", 1, {"ModbusType": "bytes"}),
        ("texts/clock", "BaseDataVariableType", "String", 1, {"ModbusLayout": ["Y M D h m s"]}),
        ("inputs/inside", "BaseAnalogType", "Double", 1, {"ModbusSpace": "input", "ModbusAddress": 0}),
    ],
)
def test_a_variable_has_the_type_unit_range_and_codes_of_the_map(
    found: dict[str, Any], path: str, kind: str, data: str, access: int, properties: dict[str, Any]
) -> None:
    one = found[path]
    assert (one["type"], one["data"], one["access"]) == (kind, data, access)
    assert {name: one["properties"].get(name) for name in properties} == properties


@pytest.mark.parametrize(("map_id", "model"), [("athena/series-c", "16C"), ("fdc/series-100", "BTC-9100")])
def test_shipped_models_load_whole(map_id: str, model: str, tmp_path: Path) -> None:
    register_map = find_map(map_id)
    options = {one.name: one.default for one in plugins.exporter("opcua-nodeset").options} | {"model": model}
    made = plugins.export("opcua-nodeset", [register_map], options)
    told = browsed(str(made.texts[""]), register_map.model(model).class_name, tmp_path)
    gone = {loss.register for loss in made.losses if loss.fact == "register"}
    paths = {one.path for one in register_map.model(model).registers} - gone
    assert {path.split("/")[1] for path in told["found"]} == paths
    assert told["read"] == len(paths)
