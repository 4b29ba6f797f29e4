"""No name is given twice, whatever is wanted."""

from regscribe.export.device.names import Names


def test_what_is_wanted_again_gets_a_number() -> None:
    names = Names()
    assert [names.give("a") for _ in range(3)] == ["a", "a_2", "a_3"]


def test_a_name_that_looks_numbered_does_not_collide() -> None:
    names = Names(between="-")
    assert [names.give(one) for one in ("a-2", "a", "a", "a-2")] == ["a-2", "a", "a-3", "a-2-2"]
