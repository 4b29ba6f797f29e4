"""The library behind the generated tests: whatever differs must be noticed, and said with where and what."""

import copy
import json
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from regscribe.testing import DriverUnderTest, Vectors, load, number
from regscribe.testing import properties as hold
from regscribe_devices.fdc import series_100
from regscribe_runtime.planning.plan import Block

PATH = Path(__file__).parents[3] / "generated" / "vectors" / "fdc" / "series-100.json"
Change = Callable[[dict[str, Any]], object]


@pytest.fixture(scope="module")
def entry() -> dict[str, Any]:
    """The vector set of set point 1."""
    data = json.loads(PATH.read_text(encoding="utf-8"))
    found: dict[str, Any] = next(one for one in data["sets"] if one["registers"][0]["path"] == "sp1")
    return found


def bench(entry: dict[str, Any], change: Change) -> DriverUnderTest:
    changed = copy.deepcopy(entry)
    change(changed)
    return DriverUnderTest(series_100.FdcC21, Vectors("fdc/series-100", ("C21",), (changed,), ()))


def first(entry: dict[str, Any], what: str) -> dict[str, Any]:
    found: dict[str, Any] = entry["cases"][0][what][0]
    return found


@pytest.mark.parametrize(
    ("change", "check", "said"),
    [
        (lambda one: first(one, "decode").update(value="1"), "check_decoding", "expected '1'"),
        (lambda one: first(one, "encode").update(words=[7]), "check_encoding", "expected [7]"),
        (lambda one: first(one, "refuse").update(value="25"), "check_refusals", "expected a refusal"),
        (lambda one: one["registers"][0]["addresses"].update(base=5), "check_registers", "{'base': {'address': 5}}"),
        (lambda one: one["registers"][0].update(aliases=[99]), "check_registers", "[99]"),
        (lambda one: one.update(access="r"), "check_registers", "expected 'r'"),
    ],
)
def test_a_vector_that_does_not_hold_fails_its_check(
    entry: dict[str, Any], change: Change, check: str, said: str
) -> None:
    with pytest.raises(AssertionError) as failure:
        getattr(bench(entry, change), check)()
    assert said in str(failure.value)


def test_a_register_that_no_vector_knows_is_noticed(entry: dict[str, Any]) -> None:
    with pytest.raises(AssertionError, match="has no such register"):
        bench(entry, lambda _: None).check_registers()


def test_a_number_is_written_as_a_program_would_write_it() -> None:
    assert (number("25"), number("-0.1")) == (25, -0.1)
    assert isinstance(number("25"), int)
    assert number("1/3") * 3 == 1


def test_a_driver_that_decodes_wrongly_does_not_come_back(
    entry: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    tried = bench(entry, lambda _: None)
    register = series_100.FdcC21.registers["sp1"]
    monkeypatch.setattr(type(register), "decode", lambda *_, **__: 12345.0)

    @settings(hold.each_run, max_examples=5)
    @given(data=st.data())
    def property_holds(data: st.DataObject) -> None:
        hold.round_trip(tried, data)

    with pytest.raises(AssertionError, match="became 12345"):
        property_holds()


def test_a_request_over_the_limit_or_asked_twice_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    tried = DriverUnderTest(series_100.FdcC21, load(PATH))

    def one_block(items: Any, _: object) -> tuple[Block, ...]:
        held = tuple(items)
        return (Block(3, 0, 80, held),) if held else ()

    monkeypatch.setattr("regscribe_runtime.planning.read_order.blocks", one_block)

    @settings(hold.each_run, max_examples=5)
    @given(data=st.data())
    def property_holds(data: st.DataObject) -> None:
        hold.covering_reads(tried, data)

    with pytest.raises(AssertionError, match="80 addresses from 0 in one request, where 79 are allowed"):
        property_holds()


def test_no_value_of_parts_needs_bits_that_a_number_of_24_does_not_have() -> None:
    entry = {"kind": "fields", "views": [{"name": "base", "type": "uint24", "words": 2}]}
    register = SimpleNamespace(partial=(), value_type=None)
    trial: Any = SimpleNamespace(entry=entry, view="base", register=register, state={}, givens={})

    @settings(database=None, derandomize=True)
    @given(hold.values(trial))
    def drawn(value: int) -> None:
        assert value < 1 << 24

    drawn()
