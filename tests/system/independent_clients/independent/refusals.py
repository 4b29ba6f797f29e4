"""What the manuals say that the devices refuse or ignore, written down by hand and not taken from the maps."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from independent.answers import Answer, Partly, Payload, Question, Raw, Read, Refused, Silent, Values, Write, Written
from regscribe.model import Access, Model, Register, Space


@dataclass(frozen=True)
class Case:
    """A request and what the manual says comes of it; `first` are values that come before garbage.

    `before` is set in the device first; `after` is what it holds then. `source` is the section of the manual.
    """

    what: str
    source: str
    question: Question
    answer: Answer
    first: int = 0
    before: Mapping[str, int | str] = field(default_factory=dict)
    after: Mapping[str, int] = field(default_factory=dict)


SERIES_C = (
    Case("a function that it does not have", "1.2.4", Read(1, 0, 2), Silent()),
    Case("another function that it does not have", "1.2.4", Raw(65, b"\0\1"), Silent()),
    Case("a loopback", "2.5", Raw(8, b"\0\0\xaa\xbb"), Payload(b"\0\0\xaa\xbb")),
    Case("a loopback with another subfunction", "2.5.5", Raw(8, b"\0\1\xaa\xbb"), Silent()),
    Case("a read of an address without a register", "2.2.6", Read(3, 2000), Refused(2)),
    Case("a read of 25 words", "2.2.7", Read(3, 0, 25), Silent()),
    Case("a read of the most words", "2.2.3", Read(3, 0, 24), Values(()), first=24),
    Case("a read that runs past the last register", "6.6", Read(3, 60, 6), Values(()), first=3),
    Case("a read of an odd number of words of IEEE numbers", "2.2.7", Read(3, 8000, 3), Silent()),
    Case("a read from an odd address of IEEE numbers", "2.2.6", Read(3, 8001, 2), Refused(2)),
    Case("a single write to an IEEE number", "2.3.5", Write(6, 8004, (1,)), Refused(2)),
    Case("a write to an odd address of IEEE numbers", "3.9.1.7", Write(16, 8005, (0, 17274)), Refused(2)),
    Case("a write of an odd number of words of IEEE numbers", "2.4.8", Write(16, 8004, (0, 17274, 0)), Silent()),
    Case("a write to an address without a register", "2.3.5", Write(6, 2000, (1,)), Refused(2)),
    Case("a write of several to an address without a register", "2.4.6", Write(16, 2000, (1, 2)), Refused(2)),
    Case("a write of an invalid code", "2.3.6", Write(6, 4049, (23,)), Refused(3)),
    Case("a write to a read-only register", "2.3.6", Write(6, 0, (1,)), Refused(3)),
    Case("a write of several, the first invalid", "2.4.7", Write(16, 4072, (99, 1)), Refused(3)),
    Case(
        "a write of several, the second invalid",
        "2.4.5",
        Write(16, 4072, (2, 99)),
        Partly(1),
        before={"alarm_1_action": 1, "alarm_1_operation": 1},
        after={"alarm_1_action": 2, "alarm_1_operation": 1},
    ),
    Case("a write of 25 words", "2.4.8", Write(16, 4049, (3,) * 25), Silent(), after={"input_type": 3}),
)
"""Series C and the CN8200 of the same maker; sections of the former's manual."""

SERIES_100 = (
    Case("a function that it does not have", "7-2", Read(1, 0, 2), Refused(1)),
    Case("another function that it does not have", "7-2", Raw(65, b"\0\1"), Refused(1)),
    Case("a loopback, which it does not have", "7-2", Raw(8, b"\0\0\xaa\xbb"), Refused(1)),
    Case("a read of a reserved address", "7-3", Read(3, 77, 3), Values((0, 0, 0))),
    Case("a read of the most words", "7-1", Read(3, 0, 79), Values(()), first=77),
    Case("a read of 80 words", "7-5", Read(3, 0, 80), Values(()), first=77),
    Case("a read of 81 words", "7-1", Read(3, 0, 81), Refused(3)),
    Case("a read of an address out of range", "7-2", Read(3, 80), Refused(2)),
    Case("a read that runs out of range", "7-2", Read(3, 79, 2), Refused(2)),
    Case("a write to an address out of range", "7-2", Write(6, 200, (1,)), Refused(2)),
    Case("a write to a read-only register", "7-2", Write(6, 64, (1,)), Refused(3)),
    Case("a write of 80 words", "7-1", Write(16, 0, (1,) * 80), Refused(3)),
    Case(
        "a write of several, the second read-only",
        "7-2",
        Write(16, 60, (7, 7)),
        Refused(3),
        before={"hour": 5},
        after={"hour": 5},
    ),
    Case("an output in automatic control", "7-3", Write(6, 66, (100,)), Refused(3), before={"mode.operation": 0}),
    Case(
        "an output in manual control",
        "7-3",
        Write(6, 66, (100,)),
        Written(),
        before={"mode.operation": 3},
        after={"mv1": 1},
    ),
    Case("a calibration that is locked", "7-5", Write(6, 52, (100,)), Refused(3)),
    Case("the command that unlocks it", "7-5", Write(6, 72, (26669,)), Written()),
    Case("a calibration that is unlocked", "7-5", Write(6, 52, (19999,)), Written(), after={"adlo": 0}),
)
"""FDC Series 100."""


def platinum(model: Model) -> Iterator[Case]:
    """Yield the cases of a Platinum controller; only the addresses are of its map."""
    words, coils = (tuple(_unused(model, space)) for space in (Space.HOLDING, Space.COIL))
    fixed = _first(model, Space.HOLDING, Access.READ)
    free = _first(model, Space.HOLDING, Access.READ_WRITE)
    yield Case("a function that it does not have", "4.1", Raw(8, b"\0\0\xaa\xbb"), Refused(1))
    yield Case("another function that it does not have", "4.1", Raw(65, b"\0\1"), Refused(1))
    yield Case("the bit of the manual's example", "4", Read(1, 1185), Refused(2))
    yield Case("a read of a word beyond the zone", "4.1", Read(3, 5000), Refused(2))
    yield Case("the same by the other function", "3.4", Read(4, 5000), Refused(2))
    yield Case("a read of 126 words", "3.3", Read(3, 0, 126), Refused(3))
    yield Case("a write of 9 words", "3.9", Write(16, 0, (1,) * 9), Refused(3))
    yield Case("a write to a bit beyond the zone", "4.1", Write(5, 1185, (1,)), Refused(2))
    yield Case("a write to a read-only word", "4.1", Write(6, fixed, (1,)), Refused(7))
    yield Case("a write of several to a read-only word", "4.1", Write(16, fixed, (1, 1)), Refused(7))
    for address in words[:2]:
        yield Case("a read of an unused word", "5.5", Read(3, address), Values((0,)))
        yield Case("a write to an unused word", "5.5", Write(6, address, (1,)), Refused(7))
        yield Case("a write of several to an unused word", "5.5", Write(16, address, (1, 1)), Refused(7))
    for address in coils[:2]:
        yield Case("a read of an unused bit", "5.4", Read(1, address), Values((0,)))
        yield Case("a read of an unused bit by the other function", "5.4", Read(2, address), Values((0,)))
        yield Case("a write to an unused bit", "5.4", Write(5, address, (1,)), Refused(7))
        yield Case("a write of several to an unused bit", "5.4", Write(15, address, (1, 1)), Refused(7))
    choice = next(each for each in model.registers if each.enum and _is_free(each) and each.base.space is Space.HOLDING)
    yield Case("a write of a code that is none", "5.5", Write(6, choice.address, (99,)), Refused(3))
    yield Case("a read of a word that can be written", "3.3", Read(3, free), Values(()), first=1)
    if any(command.id == "apply_configuration" for command in model.commands):
        apply = next(command for command in model.commands if command.id == "apply_configuration").steps[0].address
        yield Case("any other word to the factory code", "7.4, note", Write(6, apply, (1,)), Refused(7))
        yield Case("55AAh to the factory code", "7.4, note", Write(6, apply, (0x55AA,)), Written())


def broadcasts(model: Model) -> Iterator[tuple[Write, str, int]]:
    """Yield writes to all units, with a register that one of them sets if it obeys, and to what (0 before)."""
    plain = [each for each in model.registers if _is_plain(each)]
    beside = {each.address: each for each in plain}
    first = next(each for each in plain if each.address + 1 in beside)
    yield Write(6, first.address, (1,)), first.path, 1
    yield Write(16, first.address, (1, 1)), first.path, 1
    coils = [each for each in model.registers if each.base.space is Space.COIL and _is_free(each)]
    if coils:
        yield Write(5, coils[0].address, (1,)), coils[0].path, 1
        yield Write(15, coils[0].address, (1,)), coils[0].path, 1


def _is_plain(register: Register) -> bool:
    """Tell whether small whole numbers can be written, without any consequence."""
    one_word = register.base.space is Space.HOLDING and len(register.views) == 1 and register.base.words == 1
    return one_word and _is_free(register) and register.enum is None and not register.danger and not register.apply


def _is_free(register: Register) -> bool:
    return register.access is Access.READ_WRITE and register.writable is None and not register.unlock


def _first(model: Model, space: Space, access: Access) -> int:
    found = (each for each in model.registers if each.base.space is space and each.access is access)
    return next(each.address for each in found if each.base.words == 1)


def _unused(model: Model, space: Space) -> Iterator[int]:
    for kind, low, high in model.unused:
        if kind is space:
            yield from range(low, high + 1)
