"""EdgeX device profiles; expected values follow from the device SDK's order of mask, shift, base, scale and offset."""

from collections.abc import Callable
from fractions import Fraction

from regscribe.importers.edgex import likeness
from regscribe.plugins import Likeness

from .conftest import Import


def resource(name: str, attributes: str, properties: str, table: str = "HOLDING_REGISTERS") -> str:
    return (
        f"  - name: {name}\n    isHidden: false\n"
        f"    attributes: {{primaryTable: {table}, {attributes}}}\n    properties: {{{properties}}}\n"
    )


PROFILE = (
    "name: Heater\nmanufacturer: Acme\nmodel: H1\ndeviceResources:\n"
    + resource("Plain", "startingAddress: 1", "valueType: Int16, readWrite: RW, minimum: -5, maximum: 40, units: degC")
    + resource(
        "Scaled", "startingAddress: 2, rawType: INT16", "valueType: Float32, readWrite: R, scale: 0.1, offset: -4"
    )
    + resource("Trap", "startingAddress: 3", "valueType: Int16, readWrite: R, scale: 0.1")
    + resource("Tens", "startingAddress: 4", "valueType: Uint16, readWrite: R, scale: 10")
    + resource("Swapped", "startingAddress: 6, isWordSwap: true", "valueType: Float32, readWrite: R", "input_registers")
    + resource("Both", "startingAddress: 8, isWordSwap: true, isByteSwap: true", "valueType: Uint32, readWrite: R")
    + resource("Wide", "startingAddress: 10, isWordSwap: true", "valueType: Uint64, readWrite: R")
    + resource("Part", "startingAddress: 20", "valueType: Uint16, readWrite: R, mask: 240, shift: 4")
    + resource("Bit", 'startingAddress: "20.15"', "valueType: Bool, readWrite: R")
    + resource("Left", "startingAddress: 21", "valueType: Uint16, readWrite: R, mask: 240, shift: -4")
    + resource("Kept", "startingAddress: 23", "valueType: Uint16, readWrite: R, mask: 240")
    + resource("Power", "startingAddress: 22", "valueType: Uint16, readWrite: R, base: 2")
    + resource("Text", "startingAddress: 30, stringRegisterSize: 2", "valueType: String, readWrite: R, defaultValue: x")
    + resource("Coil", "startingAddress: 5", "valueType: Bool, readWrite: RW", "COILS")
    + resource("Odd", "startingAddress: 40", "valueType: Int16Array, readWrite: R")
    + "deviceCommands:\n  - name: All\n    readWrite: R\n"
)


def test_values_by_scale_and_raw_type(imported: Import) -> None:
    found = imported("edgex", PROFILE)
    assert found.value("scaled", 0xFFFF) == Fraction("-4.1")
    assert found.value("tens", 7) == 70
    assert found.register("plain").access == "rw"
    assert "range: -5..40" in found.text
    assert found.register("plain").unit[0].then == "°C"


def test_a_fraction_on_a_whole_type_is_not_believed(imported: Import) -> None:
    found = imported("edgex", PROFILE)
    assert found.register("trap").kind == "raw"
    assert found.codes("Trap") == ["scale-unclear"]
    assert found.codes("Power") == ["scale-unclear"]


def test_swaps_are_those_of_32_bits(imported: Import) -> None:
    found = imported("edgex", PROFILE)
    assert found.value("swapped", 0, 0x4148) == Fraction("12.5")
    assert found.value("both", 0x0200, 0x0100) == 65538
    assert "32 bits only" in found.left_out["Wide"]


def test_mask_and_shift_are_a_part_and_a_point_a_bit(imported: Import) -> None:
    found = imported("edgex", PROFILE)
    assert found.bits("word_holding_20") == {"Part": (4, 7), "Bit": (15, 15)}
    (kept,) = found.register("kept").fields
    assert (kept.low, kept.high, kept.multiply) == (4, 7, 16)  # masked and not shifted
    assert {*found.left_out} == {"Wide", "Left", "Odd"}


def test_texts_coils_and_commands(imported: Import) -> None:
    found = imported("edgex", PROFILE)
    assert found.value("text", 0x4142, 0) == "AB"
    assert found.codes("Text") == ["default-value-dropped"]
    assert found.register("coil").base.space == "coil"
    assert (found.draft.title, found.draft.maker) == ("H1", "Acme")
    assert any("deviceCommands" in one for one in found.draft.stated)


def test_what_is_no_profile_is_one_message(refusal: Callable[..., str]) -> None:
    assert "there are no deviceResources" in refusal("edgex", "name: a\n")


def test_it_is_recognised() -> None:
    assert likeness(PROFILE.encode(), "x.yaml") is Likeness.SURE
    assert likeness(b"deviceResources: []\n", "x.yaml") is Likeness.NO
