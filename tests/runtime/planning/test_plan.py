"""Plans cover what is wanted at the least cost there is, and keep to what the device allows."""

from collections.abc import Iterator, Sequence

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from regscribe_runtime.planning.address_ranges import AddressRanges, AddressStretch, RegisterSpan
from regscribe_runtime.planning.cost import Cost
from regscribe_runtime.planning.plan import Block, RequestLimits, SplitReason, Terms, blocks, explain
from regscribe_runtime.values.protocol import Latency, SpaceLimits
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.values.wire_types import Space

SLOW = tuple(Latency(function, 5, 15, 2, 60, 3) for function in (1, 2, 3, 4))
LINES = [
    Cost(SerialLine()),
    Cost(SerialLine(baud=300)),
    Cost(SerialLine.of("", 19_200, "8E1"), latencies=SLOW),
    Cost(SerialLine(), framing="ascii"),
    Cost(round_trip=1),
    Cost(SerialLine(baud=1200), round_trip=1, latencies=SLOW),
]
SPACES = [Space.HOLDING, Space.COIL]

items = st.builds(RegisterSpan, st.sampled_from(SPACES), st.integers(0, 40), st.integers(1, 3))
wants = st.lists(items, max_size=6)
costs = st.sampled_from(LINES)
own = st.sampled_from(
    [(), (SpaceLimits(Space.COIL, 5), SpaceLimits(Space.INPUT, write=3)), (SpaceLimits(Space.INPUT, 4),)]
)
limits = st.builds(RequestLimits, words=st.integers(4, 40), bits=st.integers(4, 40), spaces=own)
holes = st.lists(st.tuples(st.integers(0, 44), st.integers(1, 4)), max_size=3)


def whole(space_refused: Sequence[tuple[int, int]] = (), *, align: int = 1) -> AddressRanges:
    """Ground where everything from 0 to 63 may be read but some holes; from 20 on in steps of `align`."""
    gone = {space: [(first, first + count) for first, count in space_refused] for space in SPACES}
    known = {space: [(0, 64)] for space in SPACES}
    aligned = {Space.HOLDING: [AddressStretch(20, 64, align)]} if align > 1 else {}
    return AddressRanges(known, refused=gone, aligned=aligned)


def partitions(these: Sequence[RegisterSpan]) -> Iterator[list[list[RegisterSpan]]]:
    """Every way to put items into groups."""
    if not these:
        yield []
        return
    first, *rest = these
    for groups in partitions(rest):
        yield [[first], *groups]
        for place in range(len(groups)):
            yield [*groups[:place], [first, *groups[place]], *groups[place + 1 :]]


def price(group: Sequence[RegisterSpan], terms: Terms) -> float:
    """What one request for a group costs; infinite if the device refuses it. Says anew what a request may be."""
    space = group[0].space
    low, high = min(item.address for item in group), max(item.end for item in group)
    refused = {place for first, end in terms.ground._refused.get(space, ()) for place in range(first, end)}
    region = [one for one in terms.ground._stretches[space] if one.align > 1]
    for one in region:
        inside = [one.first <= place < one.end for place in range(low, high)]
        if any(inside) and not all(inside):
            return float("inf")
        if all(inside):
            low, high = low - low % one.align, high + -high % one.align
    if len({item.space for item in group}) > 1 or refused & set(range(low, high)):
        return float("inf")
    widest = max(terms.ground.widened(item).words for item in group)
    if high - low > max(terms.limits.most(space), widest):
        return float("inf")
    return terms.cost.tariff(space).of(high - low)


def cheapest(wanted: Sequence[RegisterSpan], terms: Terms) -> float:
    """The least cost over all partitions of the items."""
    known: dict[tuple[RegisterSpan, ...], float] = {}

    def cost(group: list[RegisterSpan]) -> float:
        key = tuple(group)
        if key not in known:
            known[key] = price(group, terms)
        return known[key]

    return min(sum(map(cost, groups)) for groups in partitions(sorted(set(wanted))))


def readable(wanted: Sequence[RegisterSpan], ground: AddressRanges) -> list[RegisterSpan]:
    """The items that the ground allows."""
    return [item for item in wanted if ground.stretch(item)]


def total(made: Sequence[Block], terms: Terms) -> int:
    return sum(terms.cost.tariff(block.space).of(block.quantity) for block in made)


@settings(max_examples=150)
@given(wants, limits, costs, holes, st.sampled_from([1, 2]))
def test_no_partition_costs_less(
    wanted: list[RegisterSpan], within: RequestLimits, cost: Cost, gaps: list[tuple[int, int]], align: int
) -> None:
    terms = Terms(within, whole(gaps, align=align), cost)
    left = readable(wanted, terms.ground)

    assert total(blocks(left, terms), terms) == cheapest(left, terms)


@given(wants, limits, costs, holes, st.sampled_from([1, 2]))
def test_every_item_lies_in_one_request_that_the_device_takes(
    wanted: list[RegisterSpan], within: RequestLimits, cost: Cost, gaps: list[tuple[int, int]], align: int
) -> None:
    terms = Terms(within, whole(gaps, align=align), cost)
    left = readable(wanted, terms.ground)

    made = blocks(left, terms)

    assert sorted(item for block in made for item in block.items) == sorted(set(left))
    for block in made:
        assert price([RegisterSpan(block.space, block.address, block.quantity)], terms) < float("inf")
        assert all(block.address <= item.address and item.end <= block.end for item in block.items)


overlapping = st.lists(
    st.builds(RegisterSpan, st.sampled_from(SPACES), st.integers(0, 50), st.integers(1, 4)), max_size=7
)


@settings(max_examples=150)
@given(overlapping, limits, costs)
@example(
    [RegisterSpan(Space.COIL, 0, 1), RegisterSpan(Space.COIL, 8, 1), RegisterSpan(Space.COIL, 15, 1)],
    RequestLimits(),
    LINES[0],
)
@example(
    [RegisterSpan(Space.HOLDING, 0, 4), RegisterSpan(Space.HOLDING, 1, 1), RegisterSpan(Space.HOLDING, 3, 4)],
    RequestLimits(words=5),
    LINES[0],
)
def test_long_items_that_overlap_are_read_at_the_least_cost(
    wanted: list[RegisterSpan], within: RequestLimits, cost: Cost
) -> None:
    terms = Terms(within, whole(), cost)

    assert total(blocks(wanted, terms), terms) == cheapest(wanted, terms)


def test_ten_thousand_registers_are_planned() -> None:
    """A quadratic planner would need minutes, and be stopped."""
    terms = Terms(RequestLimits(), AddressRanges({}, holes=True, unreadable={Space.HOLDING: []}), LINES[0])
    wanted = [RegisterSpan(Space.HOLDING, 5 * place + place % 3, 1 + place % 2) for place in range(10_000)]

    made = blocks(wanted, terms)

    assert sum(len(block.items) for block in made) == 10_000


def test_the_reasons_of_a_plan_say_why_each_request_is_its_own() -> None:
    known = {Space.HOLDING: [(0, 30), (40, 60)], Space.COIL: [(0, 8)]}
    ground = AddressRanges(
        known,
        unreadable={Space.HOLDING: [(60, 61)]},
        refused={Space.HOLDING: [(8, 9)]},
        aligned={
            Space.HOLDING: [AddressStretch(50, 60, 2)],
        },
    )
    cost = Cost(SerialLine(), latencies=(Latency(3, 0, 0, 5, 100),))
    at = [
        (Space.COIL, 0, 1),
        (Space.HOLDING, 0, 2),
        (Space.HOLDING, 2, 6),
        (Space.HOLDING, 9, 1),
        (Space.HOLDING, 20, 1),
    ]
    more = [(Space.HOLDING, 40, 2), (Space.HOLDING, 47, 2), (Space.HOLDING, 50, 2)]

    terms = Terms(RequestLimits(words=6), ground, cost)
    found = explain(blocks([RegisterSpan(*one) for one in at + more], terms), terms)

    assert [(one.block.address, one.block.quantity, one.split.reason) for one in found.requests] == [
        (0, 1, SplitReason.FIRST),
        (0, 2, SplitReason.SPACE),
        (2, 6, SplitReason.LIMIT),
        (9, 1, SplitReason.REFUSED),
        (20, 1, SplitReason.LIMIT),
        (40, 2, SplitReason.HOLE),
        (47, 2, SplitReason.LIMIT),
        (50, 2, SplitReason.ALIGNMENT),
    ]
    terms = Terms(RequestLimits(), ground, cost)
    apart = explain(blocks([RegisterSpan(Space.HOLDING, 0, 1), RegisterSpan(Space.HOLDING, 3, 1)], terms), terms)
    assert apart.requests[1].split.reason is SplitReason.CHEAPER
    assert apart.requests[1].split.detail == "2 between, saves 88.3 ms"  # 2 words of 54.6 ms against 20 characters


def test_a_register_that_can_only_be_written_is_never_read_along() -> None:
    known = {Space.HOLDING: [(0, 3), (4, 6)]}
    terms = Terms(RequestLimits(), AddressRanges(known, unreadable={Space.HOLDING: [(3, 4)]}, holes=True), LINES[0])

    found = explain(blocks([RegisterSpan(Space.HOLDING, 0, 3), RegisterSpan(Space.HOLDING, 4, 2)], terms), terms)

    assert [(one.block.address, one.block.quantity) for one in found.requests] == [(0, 3), (4, 2)]
    assert found.requests[1].split.reason is SplitReason.UNREADABLE
    with pytest.raises(ValueError, match=r"holding 2\.\.4 cannot be read"):
        blocks([RegisterSpan(Space.HOLDING, 2, 3)], terms)


def test_registers_at_one_address_are_read_by_one_request() -> None:
    wanted = [RegisterSpan(Space.HOLDING, 3, 3), RegisterSpan(Space.HOLDING, 4, 1), RegisterSpan(Space.HOLDING, 4, 4)]
    terms = Terms(RequestLimits(words=4), whole(), LINES[0])
    carried = [(block.address, block.quantity, block.items) for block in blocks(wanted, terms)]
    assert carried == [(3, 3, (wanted[0],)), (4, 4, (wanted[1], wanted[2]))]


def test_a_register_that_reaches_into_another_aligned_view_is_still_read_whole() -> None:
    views = [AddressStretch(0, 20, 2), AddressStretch(6, 30, 2)]
    ground = AddressRanges({Space.HOLDING: [(0, 64)]}, aligned={Space.HOLDING: views})
    assert ground.stretch(RegisterSpan(Space.HOLDING, 4, 4)) == AddressStretch(0, 20, 2)
    assert ground.stretch(RegisterSpan(Space.HOLDING, 22, 2)) == AddressStretch(20, 30, 2)


def test_an_address_in_an_aligned_view_is_asked_for_with_its_neighbour() -> None:
    terms = Terms(RequestLimits(words=5), whole(align=2), LINES[0])

    made = blocks([RegisterSpan(Space.HOLDING, 23, 1), RegisterSpan(Space.HOLDING, 26, 1)], terms)

    assert [(block.address, block.quantity) for block in made] == [(22, 2), (26, 2)]


def test_a_gap_is_crossed_where_a_second_request_costs_more() -> None:
    wanted = [RegisterSpan(Space.HOLDING, 0, 1), RegisterSpan(Space.HOLDING, 10, 1)]

    def counts(cost: Cost) -> list[int]:
        return [block.quantity for block in blocks(wanted, Terms(RequestLimits(), whole(), cost))]

    assert counts(Cost(SerialLine())) == [11]  # 9 words: 18 characters; a request: 13, and 7 of silence
    assert counts(Cost(SerialLine(), gap=2)) == [1, 1]  # 13 and 4 of silence
    assert counts(Cost(SerialLine(), latencies=(Latency(3, 0, 0, 0, 1),))) == [1, 1]
    assert counts(Cost(round_trip=1)) == [11]
