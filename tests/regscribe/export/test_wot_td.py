"""The Thing Description has what TD 1.1 and the Modbus binding can say, and raw numbers with the rest in own terms."""

import json
from collections.abc import Callable
from typing import Any

import pytest

from regscribe.losses import Exported
from regscribe.plugins import OptionError

Export = Callable[..., Exported]
Small = Callable[..., str]
Lost = Callable[[Exported], set[tuple[str, str, str]]]
Json = Any

AT = "10.0.0.7:1502"


@pytest.fixture
def thing(export: Export, small: Small) -> Callable[..., Json]:
    """The description of a small map."""

    def made(*registers: str, top: str = "", **options: str) -> Json:
        return json.loads(export("wot-td", small(*registers, top=top), at=AT, **options).texts[""])

    return made


@pytest.fixture
def said(thing: Callable[..., Json]) -> Callable[..., Json]:
    """The property `x` of a map of one register."""
    return lambda register, **more: thing(f"at: 7, name: X, {register}", **more)["properties"]["x"]


def content(said: Json, form: int = 0) -> str:
    return said["forms"][form]["contentType"].removeprefix("application/octet-stream;")


def test_a_register_is_a_property_at_its_wire_address(said: Callable[..., Json]) -> None:
    found = said("access: r, unit: V, description: Of the supply", unit="9", every="5")
    assert (found["title"], found["description"], found["type"], found["unit"]) == (
        "X",
        "Of the supply",
        "integer",
        "V",
    )
    assert found["readOnly"]
    (form,) = found["forms"]
    assert form["href"] == "modbus+tcp://10.0.0.7:1502/9/7?quantity=1"
    assert (form["modv:entity"], form["modv:zeroBasedAddressing"], form["modv:pollingTime"]) == (
        "HoldingRegister",
        True,
        5000,
    )


@pytest.mark.parametrize(
    ("order", "sequence"),
    [
        ("", "BIG_ENDIAN"),
        (", word_order: little", "LITTLE_ENDIAN_BYTE_SWAP"),
        (", byte_order: little", "BIG_ENDIAN_BYTE_SWAP"),
        (", word_order: little, byte_order: little", "LITTLE_ENDIAN"),
    ],
)
def test_the_content_type_has_the_order_since_nothing_else_counts(
    said: Callable[..., Json], order: str, sequence: str
) -> None:
    assert content(said(f"access: r, type: float32{order}")) == f"length=4;signed=true;byteSeq={sequence}"


def test_the_swapped_bytes_of_one_word_are_swapped_and_not_turned_around(said: Callable[..., Json]) -> None:
    # node-wot writes one register of LITTLE_ENDIAN turned around twice
    assert content(said("type: uint16, byte_order: little")) == "length=2;signed=false;byteSeq=BIG_ENDIAN_BYTE_SWAP"


def test_the_content_type_says_length_and_sign_without_which_node_wot_writes_nothing(said: Callable[..., Json]) -> None:
    found = said("type: int16")
    assert content(found) == "length=2;signed=true;byteSeq=BIG_ENDIAN"
    assert found["forms"][0]["op"] == ["readproperty", "observeproperty", "unobserveproperty", "writeproperty"]
    assert "readOnly" not in found


@pytest.mark.parametrize(
    ("register", "entity", "kind"),
    [
        ("space: input, access: r", "InputRegister", "integer"),
        ("space: coil, type: bit", "Coil", "boolean"),
        ("space: discrete, type: bit, access: r", "DiscreteInput", "boolean"),
    ],
)
def test_each_space_has_its_entity(said: Callable[..., Json], register: str, entity: str, kind: str) -> None:
    found = said(register, top='protocol: {source: "1", functions: [1, 2, 3, 4, 5, 6]}')
    assert (found["forms"][0]["modv:entity"], found["type"]) == (entity, kind)


def test_a_number_with_a_scale_is_raw_and_its_unit_is_not_that_of_the_raw_number(said: Callable[..., Json]) -> None:
    found = said("access: r, multiply: 0.1, add: -40, unit: °C")
    assert found["x-scale"] == {"multiply": "0.1", "add": "-40"}
    assert (found["x-unit"], found.get("unit")) == ("°C", None)


def test_a_scale_without_a_finite_decimal_is_a_ratio(said: Callable[..., Json]) -> None:
    assert said("access: r, divide: 3")["x-scale"]["multiply"] == "1/3"


def test_limits_are_those_of_the_raw_number(said: Callable[..., Json]) -> None:
    found = said("decimals: 1, range: -50..400")
    assert (found["minimum"], found["maximum"]) == (-500, 4000)


def test_limits_of_a_falling_scale_change_places(said: Callable[..., Json]) -> None:
    found = said("multiply: -2, add: 10, range: 0..8")
    assert (found["minimum"], found["maximum"]) == (1, 5)


def test_a_special_value_widens_the_limits(said: Callable[..., Json]) -> None:
    found = said('range: 10..50, special: {0: "off"}')
    assert (found["minimum"], found["maximum"]) == (0, 50)
    assert found["x-special"] == [{"raw": 0, "label": "off"}]


def test_a_special_value_that_stands_for_another_number_says_which(said: Callable[..., Json]) -> None:
    found = said("range: 1..80, special: {0: {label: shortest, means: 0.2}}")
    assert found["x-special"] == [{"raw": 0, "label": "shortest", "value": "0.2"}]


def test_what_is_only_read_has_no_limits_of_writes(said: Callable[..., Json]) -> None:
    assert not {"minimum", "maximum"} & said("access: r, range: 0..8").keys()


def test_codes_are_constants_with_titles(said: Callable[..., Json]) -> None:
    found = said("enum: {-1: falling, 0: steady}")
    assert found["oneOf"] == [{"const": -1, "title": "falling"}, {"const": 0, "title": "steady"}]


def test_codes_of_a_fixed_point_are_behind_its_scale(said: Callable[..., Json]) -> None:
    # 1 in units of 1/256 is 256 on the wire, and the constants are codes: so they say nothing of raw numbers
    found = said("access: r, type: q8.8, enum: {0: off, 1: on}")
    assert found["x-scale"]["multiply"] == "0.00390625"
    assert [one["const"] for one in found["oneOf"]] == [0, 256]


def test_fault_words_stand_in_a_term_of_our_own(said: Callable[..., Json]) -> None:
    found = said("access: r, decimals: 1, sentinels: {-32768: broken, 32760..32767: short}")
    assert found["x-faults"] == [
        {"from": -32768, "to": -32768, "label": "broken"},
        {"from": 32760, "to": 32767, "label": "short"},
    ]


def test_a_truth_value_in_a_word_is_0_or_1_since_node_wot_writes_all_bits_of_a_true(said: Callable[..., Json]) -> None:
    found = said("type: uint16, kind: boolean")
    assert (found["type"], [one["const"] for one in found["oneOf"]]) == ("integer", [0, 1])


def test_named_bits_are_counted_from_the_first_bit_on_the_wire(said: Callable[..., Json]) -> None:
    found = said("access: r, type: uint16, flags: {0: run, 15: trip}")
    bits = {name: (one["type"], one["ex:bitOffset"], one["ex:bitLength"]) for name, one in found["properties"].items()}
    assert (found["type"], bits) == ("object", {"run": ("boolean", 15, 1), "trip": ("boolean", 0, 1)})


def test_named_bits_of_swapped_words_are_where_they_stand_on_the_wire(said: Callable[..., Json]) -> None:
    # CDAB: the lower word comes first, so bit 0 is the last of the first word and bit 31 the first of the second
    found = said("access: r, type: uint32, word_order: little, flags: {0: run, 31: trip}")
    assert {name: one["ex:bitOffset"] for name, one in found["properties"].items()} == {"run": 15, "trip": 16}
    assert content(found) == "length=4;signed=false;byteSeq=BIG_ENDIAN"


def test_parts_that_lie_apart_on_the_wire_are_a_whole_number(export: Export, small: Small) -> None:
    text = small("at: 7, name: X, access: r, type: uint16, byte_order: little, fields: {wide: {bits: 4..11}}")
    made = export("wot-td", text, at=AT)
    found = json.loads(made.texts[""])["properties"]["x"]
    assert (found["type"], content(found)) == ("integer", "length=2;signed=false;byteSeq=BIG_ENDIAN_BYTE_SWAP")
    assert [one.done for one in made.losses if one.fact == "fields"] == [
        "exported as a whole number: the bits of wide are not side by side"
    ]


def test_a_version_is_the_number_that_packs_it(said: Callable[..., Json]) -> None:
    found = said("type: uint16, version: nn.nn")
    assert (found["type"], found["x-version"], found["readOnly"]) == ("integer", {"digits": 4, "group": 2}, True)


def test_a_text_has_a_charset_of_node(said: Callable[..., Json]) -> None:
    assert content(said("access: r, type: string, length: 4")) == "length=8;charset=utf-8;byteSeq=BIG_ENDIAN"
    assert "charset=latin1" in content(said("access: r, type: string, length: 4, text: latin-1"))


def test_a_write_elsewhere_has_a_form_of_its_own(said: Callable[..., Json]) -> None:
    found = said("write: {at: 107}")
    assert [one["href"].partition("/1/")[2] for one in found["forms"]] == ["7?quantity=1", "107?quantity=1"]
    assert [one["op"] for one in found["forms"]][1] == ["writeproperty"]


def test_a_device_without_function_6_is_written_by_function_16(said: Callable[..., Json]) -> None:
    found = said("type: int16", top='protocol: {source: "1", functions: [3, 16]}')
    assert found["forms"][1]["modv:function"] == "writeMultipleHoldingRegisters"
    assert "modv:entity" not in found["forms"][1]


def test_what_is_only_written_has_no_form_to_read(said: Callable[..., Json]) -> None:
    found = said("access: w")
    assert (found["writeOnly"], found["observable"]) == (True, False)
    assert [one["op"] for one in found["forms"]] == [["writeproperty"]]


def test_names_that_collide_are_told_apart(thing: Callable[..., Json]) -> None:
    array = "id: a, name: A, repeat: 1..1, stride: 1, registers: [{at: 0, name: B}]"
    found = thing(array, "at: 9, id: a_1_b, name: C")
    assert {name: one["title"] for name, one in found["properties"].items()} == {"a_1_b": "B 1", "a_1_b_2": "C"}


def test_the_description_says_what_it_was_made_of(thing: Callable[..., Json]) -> None:
    found = thing("at: 0, name: X")
    assert "model A1, map example/controller; for one state of the device" in found["description"]
    assert found["id"] == "urn:regscribe:example/controller:ExampleA1-1"


def test_texts_are_texts_of_json(said: Callable[..., Json]) -> None:
    hostile = '\\" } ${x} <script> {{x}} */'
    found = said(f"id: x, access: r, enum: {{0: {json.dumps(hostile)}}}")
    assert found["oneOf"][0]["title"] == hostile


def test_a_serial_line_is_refused(export: Export, small: Small) -> None:
    with pytest.raises(OptionError, match="has no serial lines; write HOST:PORT"):
        export("wot-td", small("at: 0, name: X"), at="/dev/ttyUSB0")


@pytest.mark.parametrize(
    ("register", "loss"),
    [
        ("access: r, decimals: 1", ("x", "scale", "LOST")),
        ("access: r, decimals: 1, unit: V", ("x", "unit", "LOST")),
        ("access: r, sentinels: {-1: broken}", ("x", "sentinel", "WRONG")),
        ('range: 1..5, special: {0: "off"}', ("x", "special-value", "LOST")),
        ("range: [1..5, 7..9]", ("x", "range-union", "LOST")),
        ("type: uint16, kind: boolean", ("x", "boolean", "COSMETIC")),
        ("type: uint16, version: n.n", ("x", "version", "LOST")),
        ("step: 5", ("x", "step", "LOST")),
        ("access: r, type: string, length: 2, sentinels: {0: not there}", ("x", "sentinel", "WRONG")),
        ("type: uint32, word_order: little", ("x", "write", "LOST")),
        ("type: string, length: 2", ("x", "write", "LOST")),
        ("type: int64, access: r", ("x", "type-unread", "LOST")),
        ("type: string, length: 2, access: r", ("x", "padding", "LOST")),
    ],
)
def test_what_is_lost_is_told(
    export: Export, small: Small, lost: Lost, register: str, loss: tuple[str, str, str]
) -> None:
    assert loss in lost(export("wot-td", small(f"at: 7, name: X, {register}"), at=AT))


@pytest.mark.parametrize(
    ("register", "why"),
    [
        ("type: uint8", "left out: the format does not read uint8 in the holding space"),
        ("type: string, length: 2, text: gbk", "left out: the form does not have texts in gbk"),
        (
            "type: string, length: 2, text: {one_per_register: low}",
            "left out: the form does not have texts in ascii with one character a register",
        ),
        ("type: ipv4", "left out: it is a ipv4, which the format does not have"),
    ],
)
def test_what_the_form_does_not_have_is_left_out(export: Export, small: Small, register: str, why: str) -> None:
    losses = export("wot-td", small("at: 0, name: A", f"at: 7, name: X, {register}"), at=AT).losses
    assert [one.done for one in losses if one.fact == "register"] == [why]
