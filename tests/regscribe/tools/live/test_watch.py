from collections.abc import Iterator
from typing import Any

import pytest

from regscribe.tools.live import catalogue, names
from regscribe.tools.live.reading import RegisterReading
from regscribe.tools.live.watch import GaveUp, watch
from regscribe_runtime import NoAnswer, RegscribeError

REGISTERS = [names.register_named(catalogue.find("16C").driver, "process_value")]
SILENCE = NoAnswer(unit=1, function=3, address=0, seconds=1)


class Answers:
    """In place of a driver: what each round brings; an error is raised."""

    def __init__(self, *found: float | RegscribeError) -> None:
        self._found = iter(found)

    def run(self, _: object) -> tuple[RegisterReading, ...]:
        found = next(self._found)
        if isinstance(found, RegscribeError):
            raise found
        return (RegisterReading("process_value", found, str(found), "°F", None),)


class Naps:
    """In place of sleeping: how long."""

    def __init__(self) -> None:
        self.taken: list[float] = []

    def __call__(self, seconds: float) -> None:
        self.taken.append(seconds)


def watched(*found: float | RegscribeError, **more: Any) -> Iterator[Any]:
    device: Any = Answers(*found)
    return watch(device, REGISTERS, **{"every": 0, "count": len(found), "sleep": Naps(), **more})


def test_what_differs_from_the_last_good_round_is_marked() -> None:
    marked = [bool(one.changed) for one in watched(1.0, 1.0, 2.0, SILENCE, 2.0, 3.0)]
    assert marked == [False, False, True, False, False, True]


def test_the_first_round_marks_nothing() -> None:
    assert [one.changed for one in watched(1.0)] == [frozenset()]


def test_rounds_are_as_far_apart_as_was_asked_for() -> None:
    naps = Naps()
    list(watched(1.0, 1.0, 1.0, every=5, sleep=naps))
    assert len(naps.taken) == 2
    assert all(4 < seconds <= 5 for seconds in naps.taken)


def test_the_line_is_left_to_others_for_a_tenth_of_what_a_round_takes(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = iter(range(0, 1000, 10))  # each look at the clock is 10 s later: a round takes 10 s
    monkeypatch.setattr("regscribe.tools.live.watch.time.monotonic", lambda: next(clock))
    naps = Naps()
    rounds = list(watched(1.0, 1.0, sleep=naps, every=1))
    assert naps.taken == [1.0]
    assert all(one.late for one in rounds)


def test_a_device_that_is_silent_is_asked_again_until_patience_ends() -> None:
    rounds = watched(1.0, SILENCE, SILENCE, 1.0, SILENCE, SILENCE, SILENCE, 1.0, give_up=3)
    seen: list[RegscribeError | None] = []
    with pytest.raises(GaveUp, match="3 rounds in a row"):
        seen.extend(one.error for one in rounds)
    assert len(seen) == 7


def test_without_an_end_to_patience_it_goes_on() -> None:
    assert len(list(watched(*[SILENCE] * 20))) == 20
