"""What values depend on is read behind them, or in the same request."""

from hypothesis import given
from hypothesis import strategies as st

from regscribe_runtime import View, WireType
from regscribe_runtime.planning.address_ranges import AddressRanges, RegisterSpan
from regscribe_runtime.planning.cost import Cost
from regscribe_runtime.planning.plan import RequestLimits, Terms
from regscribe_runtime.planning.read_order import ReadOrder, lay_out
from regscribe_runtime.planning.read_places import ReadPlace
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.values.wire_types import Space

VIEW = View("base", WireType.INT16)
TERMS = Terms(RequestLimits(), AddressRanges({Space.HOLDING: [(0, 10), (100, 110), (200, 210)]}), Cost(SerialLine()))


def at(**places: int) -> dict[str, ReadPlace]:
    return {path: ReadPlace(VIEW, RegisterSpan(Space.HOLDING, address, 1)) for path, address in places.items()}


def witnessed(layout: ReadOrder, needs: dict[str, set[str]]) -> bool:
    """Whether every dependency is checked at the end: not before what depends on it."""
    return all(
        layout.checks[need].block >= layout.places[path].block
        for path, found in needs.items()
        for need in found
        if path in layout.places and need in layout.places
    )


def test_the_request_with_the_scale_is_sent_last() -> None:
    needs = {"value": {"places"}}

    layout = lay_out(at(places=0, value=100), needs, TERMS)

    assert [block.address for block in layout.blocks] == [100, 0]
    assert not layout.atomic
    assert witnessed(layout, needs)


def test_values_beside_their_scale_are_of_one_piece() -> None:
    layout = lay_out(at(places=100, value=101, other=0), {"value": {"places"}}, TERMS)

    assert layout.atomic
    assert len(layout.blocks) == 2


def test_what_goes_round_in_a_circle_is_read_once_more_at_the_end() -> None:
    needs = {"low": {"high_scale"}, "high": {"low_scale"}}

    layout = lay_out(at(low=0, low_scale=1, high=100, high_scale=101), needs, TERMS)

    assert [(block.address, block.quantity) for block in layout.blocks] == [(0, 2), (100, 2), (1, 1)]
    assert witnessed(layout, needs)
    assert not layout.atomic


NAMES = "abcdefgh"
addresses = st.fixed_dictionaries({name: st.sampled_from([0, 1, 5, 100, 101, 200, 201]) for name in NAMES})
relations = st.sets(st.tuples(st.sampled_from(NAMES), st.sampled_from(NAMES)).filter(lambda one: one[0] < one[1]))


@given(addresses, relations)
def test_every_dependency_is_checked_behind_what_depends_on_it(
    places: dict[str, int], pairs: set[tuple[str, str]]
) -> None:
    needs: dict[str, set[str]] = {}
    for path, need in sorted(pairs, reverse=True):  # what a dependency depends on, its dependents depend on too
        needs.setdefault(path, set()).update({need, *needs.get(need, ())})

    layout = lay_out(at(**places), needs, TERMS)

    assert witnessed(layout, needs)
    for path, place in layout.places.items():
        assert layout.blocks[place.block].address + place.start == places[path]
    for path, place in layout.checks.items():
        assert layout.blocks[place.block].address + place.start == places[path]
