"""Plans cover what is wanted, once, within the limits."""

from hypothesis import given
from hypothesis import strategies as st

from regscribe.runtime.plan import BRIDGE, Item, Limits, plan

items = st.lists(st.builds(Item, st.sampled_from(["holding", "input"]), st.integers(0, 300), st.integers(1, 4)))
limits = st.builds(Limits, words=st.integers(4, 40), holes=st.booleans())


@given(items, limits)
def test_every_item_lies_in_exactly_one_block_and_no_block_is_over_the_limit(
    wanted: list[Item], within: Limits
) -> None:
    blocks = plan(wanted, within)

    assert sorted(item for block in blocks for item in block.items) == sorted(set(wanted))
    for block in blocks:
        assert block.quantity <= within.words
        for item in block.items:
            assert block.address <= item.address
            assert item.end <= block.address + block.quantity


@given(items, st.integers(4, 40))
def test_holes_are_not_read_where_the_device_forbids_it(wanted: list[Item], words: int) -> None:
    covered = {(item.space, address) for item in wanted for address in range(item.address, item.end)}

    for block in plan(wanted, Limits(words=words)):
        space = block.items[0].space
        assert {(space, address) for address in range(block.address, block.address + block.quantity)} <= covered


def test_what_touches_is_one_request_and_a_short_gap_is_bridged_where_it_may_be() -> None:
    near, far = Item("holding", 0, 2), Item("holding", 2 + BRIDGE, 1)

    assert [block.quantity for block in plan([near, far], Limits())] == [2, 1]
    assert [block.quantity for block in plan([near, far], Limits(holes=True))] == [3 + BRIDGE]
    assert [block.quantity for block in plan([near, Item("holding", 2, 1)], Limits())] == [3]


def test_spaces_are_not_mixed() -> None:
    blocks = plan([Item("holding", 0, 1), Item("input", 1, 1)], Limits())

    assert [(block.function, block.address) for block in blocks] == [(3, 0), (4, 1)]
