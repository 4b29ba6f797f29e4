"""A register that this unit lacks is found in few requests, named, and left out for a while; the rest is delivered."""

from collections.abc import Callable, Sequence
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe_runtime import NoAnswer, Protocol, ReadOnly, View, WireType, WriteOnly, integer, number, word
from regscribe_runtime.errors import Absent, ExceptionAnswer, RegscribeError
from regscribe_runtime.operations.read import read_many
from regscribe_runtime.operations.session import Session
from regscribe_runtime.operations.snapshot import Snapshot
from regscribe_runtime.registers.register import Register
from regscribe_runtime.wire.requests import Reply, Request


class Unit:
    """A device of input words by address that refuses what it does not have; it counts what it is asked."""

    def __init__(self, words: dict[int, int], *, refuse: Callable[[Request], Reply]) -> None:
        self.words, self.refuse = words, refuse
        self.asked: list[Request] = []

    def answer(self, request: Request) -> Reply:
        self.asked.append(request)
        addresses = range(request.address, request.address + request.quantity)
        if all(address in self.words for address in addresses):
            return Reply(request.function, tuple(self.words[address] for address in addresses))
        return self.refuse(request)

    def read(self, session: Session, registers: Sequence[Register[Any]]) -> Snapshot:
        """Run a read of registers against this unit; pauses pass at once."""
        self.asked.clear()
        operation = read_many(registers)(session)
        try:
            asked = next(operation)
            while True:
                if not isinstance(asked, Request):
                    asked = operation.send(None)
                    continue
                try:
                    reply = self.answer(asked)
                except RegscribeError as error:
                    asked = operation.throw(error)
                else:
                    asked = operation.send(reply)
        except StopIteration as done:
            return done.value


def code(number: int) -> Callable[[Request], Reply]:
    return lambda request: Reply(request.function, exception=number)


def silence(request: Request) -> Reply:
    raise NoAnswer(unit=1, function=request.function, address=request.address, seconds=1)


def registers(addresses: Sequence[int]) -> list[Register[Any]]:
    found: list[Register[Any]] = [ReadOnly(address, word(WireType.INT16), integer) for address in addresses]
    for register in found:
        register.path = f"r{register.at}"
    return found


def session_of(known: Sequence[Register[Any]], protocol: Protocol | None = None) -> Session:
    protocol = protocol or Protocol()
    return Session(unit=1, protocol=protocol, registers={one.path: one for one in known}, commands={}, givens={})


@pytest.fixture
def row() -> list[Register[Any]]:
    """Sixteen registers in a row."""
    return registers(range(16))


def test_an_absent_register_is_named_and_all_others_are_delivered(row: list[Register[Any]]) -> None:
    unit = Unit({address: 100 + address for address in range(16) if address != 11}, refuse=code(2))

    snapshot = unit.read(session_of(row), row)

    assert {path: snapshot[path] for path in snapshot if path != "r11"} == {
        f"r{address}": 100 + address for address in range(16) if address != 11
    }
    with pytest.raises(Absent, match="r11: unit 1 does not have it at address 11: unit 1 refused function 03"):
        snapshot["r11"]
    error = snapshot.errors["r11"]
    assert isinstance(error, Absent)
    assert isinstance(error.answer, ExceptionAnswer)
    assert (error.unit, error.address, error.answer.code) == (1, 11, 2)


def test_one_absent_register_among_sixteen_is_found_in_few_requests(row: list[Register[Any]]) -> None:
    for gone in range(16):
        unit = Unit(dict.fromkeys(set(range(16)) - {gone}, 0), refuse=code(2))
        unit.read(session_of(row), row)
        assert len(unit.asked) <= 1 + 2 * 4, gone  # all, then at most two a halving
    unit = Unit(dict.fromkeys(range(15), 0), refuse=code(2))
    unit.read(session_of(row), row)
    assert [(one.address, one.quantity) for one in unit.asked] == [(0, 16), (0, 8), (8, 4), (12, 2), (14, 1), (15, 1)]


def test_the_next_read_goes_round_it_until_that_expires(row: list[Register[Any]]) -> None:
    unit = Unit(dict.fromkeys(set(range(16)) - {5}, 7), refuse=code(2))
    session = session_of(row)
    now = [1_000_000.0]
    session.absences.clock = lambda: now[0]
    unit.read(session, row)

    now[0] += 599
    again = unit.read(session, row)
    assert [(one.address, one.quantity) for one in unit.asked] == [(0, 5), (6, 10)]
    assert isinstance(again.errors["r5"], Absent)
    assert again.errors["r5"].when.timestamp() == 1_000_000

    now[0] += 1
    unit.words[5] = 7
    assert not unit.read(session, row).errors
    assert [(one.address, one.quantity) for one in unit.asked] == [(0, 16)]


def test_a_link_that_was_opened_anew_may_have_another_unit(row: list[Register[Any]]) -> None:
    unit = Unit(dict.fromkeys(set(range(16)) - {5}, 7), refuse=code(2))
    session = session_of(row)
    unit.read(session, row)

    session.at_epoch(1)
    unit.words[5] = 8

    assert unit.read(session, row)["r5"] == 8


@pytest.mark.parametrize("number", [1, 3, 4, 6, 11])
def test_any_other_exception_concerns_the_whole_unit(row: list[Register[Any]], number: int) -> None:
    unit = Unit({}, refuse=code(number))
    session = session_of(row)

    with pytest.raises(ExceptionAnswer, match=f"exception {number:02d}"):
        unit.read(session, row)
    assert not session.absences


def test_the_code_for_a_bad_address_is_that_of_the_map(row: list[Register[Any]]) -> None:
    unit = Unit(dict.fromkeys(range(15), 0), refuse=code(3))

    assert set(unit.read(session_of(row, Protocol(absent=3)), row).errors) == {"r15"}


def test_silence_of_a_device_that_answers_bad_addresses_disables_nothing(row: list[Register[Any]]) -> None:
    unit = Unit({address: 0 for address in range(16) if address != 3}, refuse=silence)
    session = session_of(row)

    with pytest.raises(NoAnswer):
        unit.read(session, row)
    assert not session.absences


def test_where_a_bad_address_is_met_with_silence_it_must_be_silent_twice(row: list[Register[Any]]) -> None:
    unit = Unit({address: 0 for address in range(16) if address != 14}, refuse=silence)

    assert set(unit.read(session_of(row, Protocol(absent=0)), row).errors) == {"r14"}
    alone = [one for one in unit.asked if (one.address, one.quantity) == (14, 1)]
    assert len(alone) >= 2


def test_a_unit_that_says_nothing_at_all_is_soon_left_alone(row: list[Register[Any]]) -> None:
    unit = Unit({}, refuse=silence)
    session = session_of(row, Protocol(absent=0))

    with pytest.raises(NoAnswer):
        unit.read(session, row)
    assert len({(one.address, one.quantity) for one in unit.asked}) <= 3
    assert not session.absences


def test_a_refused_gap_between_good_registers_is_not_crossed_again() -> None:
    apart = registers([0, 1, 4, 5])
    unit = Unit(dict.fromkeys([0, 1, 4, 5], 3), refuse=code(2))
    session = session_of(apart, Protocol(read_holes=True))

    assert not unit.read(session, apart).errors
    assert unit.asked[0].quantity == 6
    assert not unit.read(session, apart).errors
    assert [(one.address, one.quantity) for one in unit.asked] == [(0, 2), (4, 2)]


def test_a_register_that_was_only_read_along_is_not_called_absent() -> None:
    row = registers(range(6))
    unit = Unit(dict.fromkeys([0, 1, 4, 5], 3), refuse=code(2))
    session = session_of(row)
    unit.read(session, [row[0], row[1], row[4], row[5]])

    unit.words |= {2: 7, 3: 8}

    assert dict(unit.read(session, row[2:4])) == {"r2": 7, "r3": 8}
    assert not unit.read(session, row).errors


def test_a_register_with_another_place_is_read_there() -> None:
    twice: list[Register[Any]] = [ReadOnly(3, word(WireType.INT16), integer, aliases=(40,))]
    twice[0].path = "twice"
    rest = registers([2])
    unit = Unit({2: 1, 40: 9}, refuse=code(2))
    session = session_of([*twice, *rest])

    assert dict(unit.read(session, [*rest, *twice])) == {"r2": 1, "twice": 9}
    assert dict(unit.read(session, [*rest, *twice])) == {"r2": 1, "twice": 9}
    assert [one.address for one in unit.asked] == [2, 40]


def test_a_register_that_can_only_be_written_cannot_be_read_along() -> None:
    secret: Register[Any] = WriteOnly(1, word(WireType.INT16), integer)
    secret.path = "secret"
    known = [*registers([0, 2]), secret]
    unit = Unit({0: 5, 2: 6}, refuse=code(2))

    assert dict(unit.read(session_of(known, Protocol(read_holes=True)), known[:2])) == {"r0": 5, "r2": 6}
    assert [(one.address, one.quantity) for one in unit.asked] == [(0, 1), (2, 1)]
    with pytest.raises(ValueError, match="secret cannot be read from this device"):
        unit.read(session_of(known), [secret])


@given(st.sets(st.integers(0, 40), min_size=1), st.sets(st.integers(0, 40)), st.booleans(), st.booleans())
def test_whatever_is_absent_exactly_that_has_no_value(
    wanted: set[int],
    gone: set[int],
    holes: bool,  # noqa: FBT001 (drawn)
    quiet: bool,  # noqa: FBT001 (as above)
) -> None:
    chosen = registers(sorted(wanted))
    known = registers(range(41))
    unit = Unit(
        {address: address for address in range(41) if address not in gone}, refuse=silence if quiet else code(2)
    )
    session = session_of(known, Protocol(read_holes=holes, absent=0 if quiet else 2))

    try:
        snapshot = unit.read(session, chosen)
    except NoAnswer:
        assert quiet
        return
    assert set(snapshot.errors) == {f"r{address}" for address in wanted & gone}
    assert all(snapshot[f"r{address}"] == address for address in wanted - gone)
    assert list(snapshot) == [one.path for one in chosen]

    before = len(unit.asked)
    assert set(unit.read(session, chosen).errors) == set(snapshot.errors)
    assert len(unit.asked) <= before


def test_an_absent_word_of_an_aligned_view_is_found_too() -> None:
    views = (View("base", WireType.FLOAT32, words=2, align=2),)
    floats: list[Register[Any]] = [ReadOnly(at, views, number) for at in (100, 102, 104)]
    for one in floats:
        one.path = f"f{one.at}"
    unit = Unit(dict.fromkeys([100, 101, 104, 105], 0), refuse=code(2))

    snapshot = unit.read(session_of(floats), floats)

    assert set(snapshot.errors) == {"f102"}
    assert all(one.address % 2 == one.quantity % 2 == 0 for one in unit.asked)
