"""EdgeX: resources that its device service Modbus reads right by its source, and what they cannot say."""

from collections.abc import Callable
from decimal import Decimal
from typing import Any

import pytest

from regscribe import source
from regscribe.losses import Exported

Text = Callable[..., str]
Small = Callable[..., str]
Export = Callable[..., Exported]
Lost = Callable[[Exported], set[tuple[str, str, str]]]
Profile = Callable[..., dict[str, Any]]
Resources = Callable[..., list[dict[str, Any]]]


@pytest.fixture
def profile(exported_text: Text, small: Small) -> Profile:
    """The profile made of these registers, as a reader of YAML takes it."""

    def made(*registers: str, **more: str) -> dict[str, Any]:
        document, found = source.parse(
            exported_text("edgex", small(*registers, **more)).encode(), name="p", escapes=True
        )
        assert document is not None, found
        return dict(document.data)

    return made


@pytest.fixture
def resources(profile: Profile) -> Resources:
    """Its resources."""
    return lambda *registers, **more: list(profile(*registers, **more)["deviceResources"])


def test_a_register_is_a_resource_with_its_wire_address(resources: Resources) -> None:
    (found,) = resources("at: 9, name: Level, type: uint16, range: 1..9, unit: V")
    assert found == {
        "name": "level",
        "isHidden": False,
        "description": "Level",
        "attributes": {"primaryTable": "HOLDING_REGISTERS", "startingAddress": 9},
        "properties": {"valueType": "Uint16", "readWrite": "RW", "minimum": 1, "maximum": 9, "units": "V"},
    }


def test_trap_2_a_scaled_whole_number_is_a_float_with_a_raw_type(resources: Resources) -> None:
    signed, unsigned, wide = resources(
        "at: 0, name: A, decimals: 1, access: r",
        "at: 1, name: B, type: uint16, multiply: 0.5, add: -40, access: r",
        "at: 2, name: C, type: int32, decimals: 2, word_order: little, access: r",
    )
    assert (signed["attributes"]["rawType"], signed["properties"]["valueType"]) == ("Int16", "Float64")
    assert signed["properties"]["scale"] == Decimal("0.1")
    assert (unsigned["attributes"]["rawType"], unsigned["properties"]["offset"]) == ("Uint16", -40)
    assert wide["attributes"] == {
        "primaryTable": "HOLDING_REGISTERS",
        "startingAddress": 2,
        "isWordSwap": True,
        "rawType": "Int32",
    }


def test_trap_2_a_scaled_number_is_cut_when_it_is_written_so_it_is_read_only(
    export: Export, small: Small, lost: Lost, resources: Resources
) -> None:
    register = "at: 0, name: A, decimals: 1"
    assert resources(register)[0]["properties"]["readWrite"] == "R"
    assert ("a", "write", "LOST") in lost(export("edgex", small(register)))


def test_what_is_write_only_and_not_written_is_left_out(export: Export, small: Small, lost: Lost) -> None:
    made = export("edgex", small("at: 0, name: A, access: w, decimals: 1", "at: 1, name: B"))
    assert {("a", "write", "LOST"), ("a", "register", "LOST")} <= lost(made)
    assert "name: a\n" not in str(made.texts[""])


def test_scaled_types_without_a_raw_type_are_left_out(export: Export, small: Small) -> None:
    text = small(
        "at: 0, name: A, type: uint32, decimals: 1",
        "at: 2, name: B, type: int64, decimals: 1",
        "at: 6, name: C, type: uint32, multiply: 10",
    )
    made = export("edgex", text)
    assert {one.register for one in made.losses if one.fact == "register"} == {"a", "b"}
    assert "scale: 10\n" in str(made.texts[""])


@pytest.mark.parametrize(
    ("order", "swaps"),
    [
        ("", {}),
        (", word_order: little", {"isWordSwap": True}),
        (", byte_order: little", {"isByteSwap": True}),
        (", word_order: little, byte_order: little", {"isByteSwap": True, "isWordSwap": True}),
    ],
)
def test_numbers_of_32_bits_are_swapped(resources: Resources, order: str, swaps: dict[str, bool]) -> None:
    (found,) = resources(f"at: 0, name: A, type: float32{order}")
    assert {key: value for key, value in found["attributes"].items() if key.endswith("Swap")} == swaps


@pytest.mark.parametrize(
    "said",
    [
        "type: uint16, byte_order: little",
        "type: int64, word_order: little",
        "type: float64, byte_order: little",
        "type: string, length: 2, access: r, byte_order: little",
        "type: float16",
    ],
)
def test_nothing_else_is_swapped_so_other_orders_are_left_out(export: Export, small: Small, said: str) -> None:
    made = export("edgex", small("at: 0, name: A", f"at: 4, name: B, {said}"))
    assert [one.register for one in made.losses if one.fact == "register"] == ["b"]


def test_a_flag_is_a_bit_whose_address_is_a_text_as_10_1_and_10_10_are_one_number(
    exported_text: Text, small: Small
) -> None:
    text = exported_text("edgex", small("at: 10, name: S, type: uint16, access: r, flags: {1: low, 10: high}"))
    assert 'startingAddress: "10.1"}' in text
    assert 'startingAddress: "10.10"}' in text
    assert text.count("valueType: Bool") == 2


@pytest.mark.parametrize(
    ("order", "address"), [("", "5.1"), (", word_order: little", "6.1"), (", byte_order: little", "5.9")]
)
def test_a_flag_of_a_second_word_is_a_bit_of_that_word(resources: Resources, order: str, address: str) -> None:
    (found,) = resources(f"at: 5, name: S, type: uint32{order}, access: r, flags: {{17: bad}}")
    assert found["attributes"]["startingAddress"] == address


def test_a_part_is_masked_and_then_shifted(resources: Resources) -> None:
    (found,) = resources("at: 5, name: S, type: uint16, access: r, fields: {zone: {bits: 4..7, enum: {1: north}}}")
    assert found["properties"] == {"valueType": "Uint16", "readWrite": "R", "mask": 0xF0, "shift": 4}
    assert found["description"] == "S: zone; 1 = north"


def test_a_part_with_a_scale_of_its_own_is_left_out(export: Export, small: Small, lost: Lost) -> None:
    text = small("at: 5, name: S, type: uint16, access: r, fields: {a: {bits: 0..3}, b: {bits: 4..7, multiply: 0.5}}")
    made = export("edgex", text)
    assert ("s", "fields", "LOST") in lost(made)
    assert "name: s_b" not in str(made.texts[""])


def test_a_word_that_can_be_written_is_there_as_a_whole(resources: Resources) -> None:
    found = resources("at: 5, name: S, type: uint16, flags: {0: on}")
    assert [(one["name"], one["properties"]["readWrite"]) for one in found] == [("s", "RW"), ("s_on", "R")]


def test_coils_are_written_by_function_15_and_one_word_by_6(export: Export, small: Small, lost: Lost) -> None:
    top = "protocol: {functions: [1, 3, 5, 16]}"
    text = small("at: 0, name: A", "at: 1, name: B, type: int32", "at: 0, name: C, space: coil", top=top)
    found = {one for one in lost(export("edgex", text)) if one[1] == "write"}
    assert found == {("a", "write", "LOST"), ("c", "write", "LOST")}


def test_what_is_written_elsewhere_is_a_resource_of_its_own(resources: Resources) -> None:
    found = resources("at: 0, name: A, write_at: 100")
    assert [(one["name"], one["attributes"]["startingAddress"], one["properties"]["readWrite"]) for one in found] == [
        ("a", 0, "R"),
        ("a_write", 100, "W"),
    ]


def test_a_special_value_outside_of_the_range_widens_it_which_is_told(
    export: Export, small: Small, lost: Lost, resources: Resources
) -> None:
    register = "at: 0, name: A, range: 5..9, special: {0: off}"
    properties = resources(register)[0]["properties"]
    assert (properties["minimum"], properties["maximum"]) == (0, 9)
    assert ("a", "range", "LOST") in lost(export("edgex", small(register)))


def test_a_text_is_as_long_as_its_registers(export: Export, small: Small, resources: Resources) -> None:
    (found,) = resources("at: 8, name: Tag, type: string, length: 4, access: r")
    assert found["attributes"]["stringRegisterSize"] == 4
    text = small("at: 0, name: A", "at: 8, name: Tag, type: string, length: 124, access: r")
    (loss,) = [one for one in export("edgex", text).losses if one.fact == "register"]
    assert loss.done == "left out: it has 124 words, of which one request has 123 at most"


def test_a_truth_value_in_a_word_is_its_lowest_bit_or_a_number_where_it_is_written(resources: Resources) -> None:
    read, written = resources(
        "at: 0, name: A, type: uint16, kind: boolean, access: r", "at: 1, name: B, type: uint16, kind: boolean"
    )
    assert (read["attributes"]["startingAddress"], read["properties"]["valueType"]) == ("0.0", "Bool")
    assert (written["attributes"]["startingAddress"], written["properties"]["valueType"]) == (1, "Uint16")


def test_a_fault_word_is_told_as_wrong_and_not_a_number_is_an_error_already(
    export: Export, small: Small, lost: Lost
) -> None:
    text = small("at: 0, name: A, sentinels: {-32768: broken}", "at: 1, name: B, type: float32, sentinels: {nan: none}")
    found = {one for one in lost(export("edgex", text)) if one[1] == "sentinel"}
    assert found == {("a", "sentinel", "WRONG")}


def test_a_group_is_a_command_whose_name_no_resource_has(profile: Profile) -> None:
    made = profile("at: 0, name: Control", "at: 1, name: B")
    assert made["deviceCommands"] == [
        {
            "name": "control_2",
            "isHidden": False,
            "readWrite": "R",
            "resourceOperations": [{"deviceResource": "control"}, {"deviceResource": "b"}],
        }
    ]


def test_a_command_has_128_resources_at_most(profile: Profile) -> None:
    made = profile(*(f"at: {at}, name: R{at}" for at in range(130)))
    found = [(one["name"], len(one["resourceOperations"])) for one in made["deviceCommands"]]
    assert found == [("control", 128), ("control_2", 2)]


def test_texts_of_the_map_stay_texts(resources: Resources) -> None:
    (found,) = resources("""at: 0, name: 'A: {x}', description: '!secret "*" # & {{ y }}'""")
    assert found["description"] == 'A: {x}; !secret "*" # & {{ y }}'


def test_a_word_that_is_neither_0_nor_1_is_told_as_it_is(export: Export, small: Small, lost: Lost) -> None:
    made = export("edgex", small("at: 0, name: A, type: uint16, kind: boolean, access: r"))
    assert ("a", "truth-of-words", "WRONG") in lost(made)


def test_a_coil_with_a_scale_is_left_out(export: Export, small: Small) -> None:
    text = small("at: 0, name: A", "at: 3, name: C, space: coil, kind: number, multiply: 10")
    (loss,) = [one for one in export("edgex", text).losses if one.fact == "register"]
    assert (loss.register, loss.done) == ("c", "left out: a bit has no scale")


def test_labels_are_told_in_place_of_codes_by_mappings(profile: Profile) -> None:
    made = profile(
        "at: 0, name: Mode, enum: {-1: falling, 1: 'on'}",
        "at: 0, name: Valve, space: coil, enum: {0: closed, 1: opened}",
        "at: 1, name: S, type: uint16, access: r, fields: {zone: {bits: 4..7, enum: {1: north}}}",
    )
    assert made["deviceCommands"][0]["resourceOperations"] == [
        {"deviceResource": "mode", "mappings": {"-1": "falling", "1": "on"}},
        {"deviceResource": "valve", "mappings": {"false": "closed", "true": "opened"}},
        {"deviceResource": "s_zone", "mappings": {"1": "north"}},
    ]
