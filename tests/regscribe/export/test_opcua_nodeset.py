"""OPC UA nodesets: nodes with their types and values; what a real server finds there is in tests/system/interop."""

import re
from collections.abc import Callable
from xml.etree import ElementTree as ET

import pytest

from regscribe.export.opcua_nodeset.nodes import NODES, TYPES
from regscribe.export.opcua_nodeset.units import CODES, unit_id
from regscribe.losses import Exported
from regscribe.model.units import KNOWN_UNITS

Text = Callable[..., str]
Small = Callable[..., str]
Export = Callable[..., Exported]
Lost = Callable[[Exported], set[tuple[str, str, str]]]
ROOT = "ExampleA1Type"


@pytest.fixture
def nodes(exported_text: Text, small: Small) -> Callable[..., dict[str, ET.Element]]:
    """The nodes of a map of these registers, by id without that of the group."""

    def found(*registers: str, **more: str) -> dict[str, ET.Element]:
        root = ET.fromstring(exported_text("opcua-nodeset", small(*registers, **more)))  # noqa: S314 - our own text
        every = [node for node in root if "NodeId" in node.attrib]
        assert len(every) == len({node.attrib["NodeId"] for node in every})
        return {node.attrib["NodeId"].removeprefix(f"ns=1;s={ROOT}.control."): node for node in every}

    return found


def value(node: ET.Element) -> list[str]:
    """The texts of a value, in their order."""
    return [each.text for each in node.iter() if each.tag.startswith(f"{{{TYPES}}}") and (each.text or "").strip()]  # type: ignore[misc]  # not empty


def test_a_model_is_an_object_type_with_an_object_for_each_group(nodes: Callable[..., dict[str, ET.Element]]) -> None:
    found = nodes("at: 0, name: Level")
    assert found[f"ns=1;s={ROOT}"].tag == f"{{{NODES}}}UAObjectType"
    assert found[f"ns=1;s={ROOT}.control"].tag == f"{{{NODES}}}UAObject"
    assert found["level"].attrib["ParentNodeId"] == f"ns=1;s={ROOT}.control"


@pytest.mark.parametrize(
    ("register", "data"),
    [
        ("type: int16", "i=4"),
        ("type: uint16", "i=5"),
        ("type: uint24", "i=7"),
        ("type: int64", "i=8"),
        ("type: uint64", "i=9"),
        ("type: float32", "i=10"),
        ("type: float64", "i=11"),
        ("type: int16, decimals: 1", "i=11"),
        ("type: int16, multiply: 10", "i=11"),
        ("type: q15", "i=11"),
        ("type: string, length: 2", "i=12"),
        ("type: uint16, version: n.n", "i=12"),
        ("type: bytes, length: 2", "i=15"),
        ("type: uint16, kind: boolean", "i=1"),
        ("space: coil, type: bit", "i=1"),
    ],
)
def test_the_data_type_is_that_of_the_value_of_use(
    nodes: Callable[..., dict[str, ET.Element]], register: str, data: str
) -> None:
    assert nodes(f"at: 0, name: Level, {register}")["level"].attrib["DataType"] == data


def test_a_unit_has_its_common_code(nodes: Callable[..., dict[str, ET.Element]]) -> None:
    found = nodes("at: 0, name: Level, unit: °C")
    assert value(found["level.EngineeringUnits"]) == [
        "i=888",
        "http://www.opcfoundation.org/UA/units/un/cefact",
        "4408652",  # CEL: 0x43, 0x45, 0x4C
        "°C",
        "°C",
    ]


def test_a_unit_without_a_code_has_its_symbol_and_is_told(export: Export, small: Small, lost: Lost) -> None:
    made = export("opcua-nodeset", small("at: 0, name: Level, unit: gal/min"))
    assert "<UnitId>-1</UnitId>" in made.texts[""]
    assert ("level", "unit", "COSMETIC") in lost(made)


def test_codes_are_of_units_that_the_language_knows() -> None:
    assert set(CODES) <= set(KNOWN_UNITS)
    assert len(set(CODES.values())) == len(CODES)
    assert unit_id("kWh") == 0x4B5748


def test_the_range_of_writes_is_exact_decimal_text(nodes: Callable[..., dict[str, ET.Element]]) -> None:
    found = nodes("at: 0, name: Level, decimals: 1, range: -0.1..400")
    assert value(found["level.EURange"]) == ["i=885", "-0.1", "400"]


def test_limits_of_a_valid_reading_are_the_range_of_what_is_only_read(
    nodes: Callable[..., dict[str, ET.Element]],
) -> None:
    found = nodes("at: 0, name: Level, access: r, valid: 0..100")
    assert value(found["level.EURange"]) == ["i=885", "0", "100"]


def test_a_range_and_a_valid_reading_lose_the_latter(export: Export, small: Small, lost: Lost) -> None:
    made = export("opcua-nodeset", small("at: 0, name: Level, range: 0..10, valid: 0..100"))
    assert ("level", "valid", "LOST") in lost(made)


def test_an_open_limit_is_told(export: Export, small: Small, lost: Lost) -> None:
    made = export("opcua-nodeset", small("at: 0, name: Level, range: {from: {open: sensor limit}, to: 10}"))
    assert "EURange" not in made.texts[""]
    assert ("level", "range", "LOST") in lost(made)


def test_a_code_has_its_label_whatever_the_gaps(nodes: Callable[..., dict[str, ET.Element]]) -> None:
    found = nodes("at: 0, name: Mode, enum: {-1: falling, 7: rising}")
    assert value(found["mode.EnumValues"]) == ["i=7616", "-1", "falling", "i=7616", "7", "rising"]


def test_a_scaled_number_of_64_bits_is_told_to_lose_digits(export: Export, small: Small, lost: Lost) -> None:
    made = export("opcua-nodeset", small("at: 0, name: Energy, type: uint64, decimals: 2"))
    assert ("energy", "precision-float64", "LOST") in lost(made)


def test_what_exists_under_a_condition_is_optional(export: Export, small: Small, lost: Lost) -> None:
    made = export("opcua-nodeset", small("at: 0, name: Mode, default: 0", "at: 1, name: Extra, when: {mode: 1}"))
    assert re.search(r'control\.extra".*?ReferenceType="HasModellingRule">i=80<', str(made.texts[""]), re.DOTALL)
    assert ("extra", "condition", "LOST") in lost(made)


@pytest.mark.parametrize("hostile", ['"><x/>', "]]>", "a -- b", "&amp; <b>", "--->", "--"])
def test_texts_of_a_map_stay_texts(exported_text: Text, small: Small, hostile: str) -> None:
    name = hostile.replace('"', '\\"')
    text = small(f'id: level, at: 0, name: "Level {name}", symbol: "{name}", description: "{name}"')
    made = exported_text("opcua-nodeset", text.replace("title: Controller,", f'title: "{name}",'))
    root = ET.fromstring(made)  # noqa: S314 - our own text
    titles = [
        node.findtext(f"{{{NODES}}}DisplayName") for node in root if node.attrib.get("NodeId", "").endswith(".level")
    ]
    assert titles == [f"Level {hostile}"]
    (comment,) = re.findall(r"<!--(.*)-->", made)
    assert "--" not in comment


def test_the_nodeset_says_of_which_map_it_is_and_is_the_same_every_time(exported_text: Text, small: Small) -> None:
    one, other = (exported_text("opcua-nodeset", small("at: 0, name: A")) for _ in range(2))
    assert one == other
    assert "Controller, model A1, map example/controller" in one.splitlines()[2]
