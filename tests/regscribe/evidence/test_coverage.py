"""What a map covers is counted as a reader of the manual would."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from regscribe.evidence.coverage import coverage
from regscribe.evidence.coverage_values import Addresses, Remark
from regscribe.model import FrameExample, RegisterMap, Space

Load = Callable[[str], RegisterMap]


def test_addresses_are_counted_by_space_and_use(kiln: RegisterMap) -> None:
    unused = replace(kiln, models=(replace(kiln.models[0], unused=((Space.HOLDING, 10, 19), (Space.INPUT, 0, 0))),))
    holding, inputs, coils = coverage(unused).models[0].addresses
    # 0..4, 5 (second word), 6, 20, 21 and 1000, 1001; aliases 64, 128; command 30 (6 is a register); reserved 8, 9
    assert holding == Addresses(space="holding", documented=26, mapped=11, aliases=2, commands=1, unused=10, reserved=2)
    assert inputs == Addresses(space="input", documented=1, mapped=0, aliases=0, commands=0, unused=1, reserved=0)
    assert coils == Addresses(space="coil", documented=1, mapped=1, aliases=0, commands=0, unused=0, reserved=0)


def test_facts_are_counted_by_model(kiln: RegisterMap) -> None:
    first, second = coverage(kiln).models
    assert (first.name, first.registers, second.registers) == ("K1", 9, 8)
    assert (first.ranged, first.coded, first.defaults, first.units, first.sections) == (3, 2, 2, 2, 9)
    assert (first.inferred, first.open_limits, first.raw) == (1, 1, 3)
    assert (second.inferred, second.open_limits, second.raw) == (0, 1, 2)


def test_what_is_inferred_and_open_is_listed_once_for_all_models_and_elements(kiln: RegisterMap) -> None:
    assert coverage(kiln).remarks == (
        Remark(kind="inferred", at=("gain",), text="a gain: its place", models=("K1",)),
        Remark(kind="open limit", at=("set_point_ram",), text="sensor span"),
        Remark(kind="decimals not stated", at=("gain",), text="", models=("K1",)),
        Remark(kind="decimals not stated", at=("steps[i].level",), text=""),
        Remark(kind="given", at=("linear",), text="linear codes: in another manual"),
    )


def test_an_example_counts_for_every_model_whose_register_is_transmitted_alike(load: Load, text: str) -> None:
    assert [model.examples for model in coverage(load(text)).models] == [1, 1]
    other = text.replace(
        "range: {from: 0, to", "variants: [{models: [K2], views: null, type: int16}], range: {from: 0, to"
    )
    assert [model.examples for model in coverage(load(other)).models] == [1, 0]


def frame(kiln: RegisterMap, **facts: object) -> RegisterMap:
    plain = {"source": "1", "model": "K1", "frame": b"", "crc": True, "answer": False, "unit": 1}
    return replace(kiln, examples=(FrameExample(**{**plain, **facts}),))  # type: ignore[arg-type]  # facts vary by test


@pytest.mark.parametrize(
    ("facts", "count"),
    [
        ({"function": 3, "address": 2, "count": 1}, 1),
        ({"function": 3, "address": 0, "count": 5}, 0),
        ({"function": 16, "address": 2, "words": (1, 2)}, 2),
        ({"function": 16, "address": 1001, "words": (250,)}, 1),
        ({"function": 3, "address": 4, "count": 1}, 0),
        ({"function": 3, "address": 4, "count": 2}, 1),
        ({"function": 5, "address": 0, "words": (0xFF00,)}, 1),
        ({"function": 4, "address": 2, "count": 1}, 0),
        ({"function": 8, "address": 2, "count": 1}, 0),
        ({"function": 3}, 0),
        ({"function": 16, "writes": (("sensor", 1),)}, 1),
    ],
    ids=str,
)
def test_a_frame_checks_the_registers_whose_words_it_carries(
    kiln: RegisterMap, facts: dict[str, object], count: int
) -> None:
    assert coverage(frame(kiln, **facts)).models[0].examples == count


def test_functions_that_do_the_same_read_the_same_registers(kiln: RegisterMap) -> None:
    alike = replace(kiln, alike=((3, 4),))
    assert coverage(frame(alike, function=4, address=2, count=1)).models[0].examples == 1
