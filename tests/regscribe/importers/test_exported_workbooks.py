"""A workbook that our exporter wrote is read as any other list: what its columns hold comes back as it was."""

from collections.abc import Callable
from typing import Any

from regscribe import plugins
from regscribe.draft import Outcome
from regscribe.model import RegisterMap

Small = Callable[..., str]
ModelOf = Callable[[str], RegisterMap]


def test_a_list_is_imported_again_as_it_was(imported: Callable[..., Any], small: Small, model_of: ModelOf) -> None:
    registers = (
        "at: 0, name: Level, type: int16, decimals: 1, range: -50..400, unit: °C, default: 20.5",
        "at: 1, name: Moved, type: uint16, multiply: 0.1, add: -40, access: r",
        "at: 2, name: Third, type: uint16, divide: 3, access: r",
        "at: 10, name: Energy, type: uint32, word_order: little, decimals: 2, unit: kWh, access: r",
        "at: 12, name: Total, type: float64, byte_order: little, access: r",
        "at: 16, name: Mode, enum: {0: off, 7: on}",
        "at: 17, name: Status, flags: {0: heating, 15: alarm}, access: r",
        "at: 18, name: Label, type: string, length: 4, access: r",
        "at: 0, name: Inside, space: input, access: r",
        "at: 3, name: Pump, space: coil, type: bit",
    )
    before = model_of(small(*registers))
    options = {one.name: one.default for one in plugins.exporter("xlsx").options}
    found = imported("table", plugins.export("xlsx", [before], options).texts[""], ranges="value")
    assert {entry.outcome for entry in found.draft.each} == {Outcome.WHOLE}
    after = found.map
    for one, other in zip(before.models[0].registers, after.models[0].registers, strict=True):
        assert (one.name, one.access, one.kind, one.views, one.at) == (
            other.name,
            other.access,
            other.kind,
            other.views,
            other.at,
        )
        assert (one.scale, one.range, one.unit) == (other.scale, other.range, other.unit)
        assert one.default == other.default
        assert (one.enum and one.enum.labels) == (other.enum and other.enum.labels)
        assert [(bit.low, bit.label) for bit in one.fields] == [(bit.low, bit.label) for bit in other.fields]
