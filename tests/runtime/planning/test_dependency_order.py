"""What waits for others comes behind them, by rank where nothing else decides."""

from regscribe_runtime.planning.dependency_order import dependency_order

RANK = "abcdef".index


def test_what_is_needed_comes_first_and_the_lowest_rank_of_what_is_ready() -> None:
    assert dependency_order({"a": {"c"}, "b": set(), "c": {"d"}, "d": set()}, RANK) == ["b", "d", "c", "a"]


def test_a_circle_is_cut_at_its_lowest_rank() -> None:
    assert dependency_order({"c": {"b"}, "b": {"c"}, "d": {"c"}, "a": {"d"}}, RANK) == ["a", "b", "c", "d"]
    assert dependency_order({"c": {"b"}, "b": {"c"}, "d": set()}, RANK) == ["d", "b", "c"]
