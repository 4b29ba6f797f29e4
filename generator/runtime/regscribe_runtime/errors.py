"""Errors of drivers, one tree.

RegscribeError
├── LinkLost            the link is closed, or broke (NotOpen: it never was open, nothing was sent)
├── NoAnswer            nothing came within the response timeout
├── ExceptionAnswer     the device refused, with a code and its own meaning of it
├── WrongAnswer         an answer that does not fit the request
│   └── PartialWrite    fewer words were written than were sent
├── Absent              this unit does not have the register: a batch goes round it for a while
├── NotPresent          the register does not exist in the present state of the device
├── BrokenChain         the chain of blocks that a register stands in cannot be walked
├── Unsteady            dependencies of the values changed during every read of them
├── ValueRefused        refused here, before anything was sent
│   ├── ConditionNotMet the register cannot be written in the present state of the device
│   └── ValuesRefused   several values of one `configure`
├── WriteFailed         a write was sent and did not come to its good end
│   ├── NotWritten      certainly not carried out
│   ├── WriteUnknown    whether it was carried out cannot be told
│   ├── ReadBackDiffers the device took the write and holds another value
│   ├── NotApplied      carried out, but the command that makes it take effect was not
│   ├── NotConfigured   `configure` broke off: its report says what was written, undone, unknown
│   └── LeftAt          the device talks otherwise now than this link does
└── ValueNotDecodable   words that are no value of the register
    ├── SensorFault     a sentinel: the device reports a fault instead of a number
    ├── Saturated       the view was clipped: the true value lies at or beyond its end
    ├── OutOfRange      a number that the register never has while all is well
    └── NotDecodable    anything else (no scale holds, not a number, a version with too many digits)

A lost answer to a write is never answered by sending it again: the register is read back. If that shows the value, the
write was good. Otherwise NotWritten or WriteUnknown say so, and they are NoAnswer, LinkLost or WrongAnswer as well,
whichever it was, so that code which handles these handles the lost write as well.
"""

from collections.abc import Mapping, Sequence
from datetime import datetime
from typing import Any

from regscribe_runtime.report import WriteReport
from regscribe_runtime.values.wire_types import spelled_address


class RegscribeError(Exception):
    """Base of all errors of a driver."""


class LinkLost(RegscribeError, ConnectionError):  # noqa: N818 (the field's word; the tree says it is an error)
    """The link is closed or broke; whether a request under way was carried out is unknown."""


class NotOpen(LinkLost):
    """The link was not open, so nothing was sent."""


class NoAnswer(RegscribeError, TimeoutError):  # noqa: N818 (as above)
    """No answer from `unit` to `function` at `address` within the response timeout.

    A write may have been carried out nevertheless; it is never sent a second time.
    """

    def __init__(self, *, unit: int, function: int, address: int, seconds: float) -> None:
        self.unit, self.function, self.address, self.seconds = unit, function, address, seconds
        where = spelled_address(function, address)
        super().__init__(f"unit {unit} gave no answer to function {function:02d} at address {where} in {seconds:g} s")


STANDARD = {
    1: "illegal function",
    2: "illegal data address",
    3: "illegal data value",
    4: "server device failure",
    5: "acknowledge",
    6: "server device busy",
    8: "memory parity error",
    10: "gateway path unavailable",
    11: "gateway target device failed to respond",
}
"""The names of exception codes where the device's manual gives none (Modbus Application Protocol V1.1b3, section 7)."""
GATEWAY = frozenset({10, 11})
"""Exceptions of a gateway instead of a device: no unit answered behind it."""


class ExceptionAnswer(RegscribeError):  # noqa: N818 (as above)
    """The device answered with exception `code`; `name` and `meaning` are the device's own, "" where it has none."""

    def __init__(self, *, unit: int, function: int, address: int, code: int, name: str, meaning: str) -> None:
        self.unit, self.function, self.address = unit, function, address
        self.code, self.name, self.meaning = code, name, meaning
        usual = name or STANDARD.get(code, "")
        said = f" ({name}: {meaning})" if meaning else f" ({usual})" if usual else ""
        where = spelled_address(function, address)
        super().__init__(
            f"unit {unit} refused function {function:02d} at address {where} with exception {code:02d}{said}"
        )


class WrongAnswer(RegscribeError):  # noqa: N818 (as above)
    """An answer whose function, address, length or echo does not fit the request: nothing of it is used."""


class PartialWrite(WrongAnswer):
    """The device wrote `written` of `sent` words; the first word not written is at `first_unwritten`."""

    def __init__(self, *, unit: int, address: int, sent: int, written: int) -> None:
        self.unit, self.address, self.sent, self.written = unit, address, sent, written
        self.first_unwritten = address + written
        super().__init__(
            f"unit {unit} wrote {written} of {sent} words from address {address}: "
            f"it stopped at address {self.first_unwritten}"
        )


class Absent(RegscribeError):  # noqa: N818 (as above)
    """Unit `unit` refused the address of `register` at the time `when` (UTC); `answer` is its exception (or silence).

    Reads of several registers leave it out until `minutes` later (0: until the next read); reading it alone asks the
    device at once.
    """

    def __init__(
        self, register: str, *, unit: int, address: int, answer: RegscribeError, when: datetime, minutes: float
    ) -> None:
        self.register, self.unit, self.address, self.answer, self.when = register, unit, address, answer, when
        asked = f"{register}: unit {unit} does not have it at address {address}: {answer}; asked at {when:%H:%M:%S} UTC"
        left_out = f"left out of reads of several registers for {minutes:g} minutes (reading it alone asks again)"
        super().__init__(f"{asked}, {left_out if minutes else 'though it was read before; the next read asks again'}")
        self.__cause__ = answer


class NotPresent(RegscribeError, LookupError):  # noqa: N818 (as above)
    """The thing `register` exists only while `condition` (in words) holds; `present` is what was seen, by path."""

    def __init__(self, register: str, condition: str, present: Mapping[str, str]) -> None:
        self.register, self.condition, self.present = register, condition, dict(present)
        now = ", ".join(f"{path} is {value}" for path, value in self.present.items())
        super().__init__(f"{register}: it exists only while {condition}{f'; {now}' if now else ''}")


class BrokenChain(RegscribeError):  # noqa: N818 (as above)
    """The chain `chain` of blocks has no marker, no end mark, or leads out of the addresses: nothing of it is read."""

    def __init__(self, chain: str, reason: str) -> None:
        self.chain, self.reason = chain, reason
        super().__init__(f"chain {chain}: {reason}")


class Unsteady(RegscribeError):  # noqa: N818 (as above)
    """The registers `changed`, which values depend on, changed during each of `tries` reads: no value is certain."""

    def __init__(self, *, unit: int, changed: Sequence[str], tries: int) -> None:
        self.unit, self.changed, self.tries = unit, tuple(changed), tries
        super().__init__(
            f"unit {unit}: {', '.join(self.changed)} changed while the values that depend on it were read, {tries} "
            "times in a row: read again when nobody configures the device"
        )


class ValueRefused(RegscribeError, ValueError):  # noqa: N818 (as above)
    """A write that was refused before anything was sent: access, range, resolution, type or condition."""

    def __init__(self, register: str, reason: str) -> None:
        self.register, self.reason = register, reason
        super().__init__(f"{register}: {reason}")


class ConditionNotMet(ValueRefused):
    """The register cannot be written in the present state of the device: `present` is that state by path."""

    def __init__(self, register: str, reason: str, present: Mapping[str, str]) -> None:
        self.present = dict(present)
        now = ", ".join(f"{path} is {value}" for path, value in self.present.items())
        super().__init__(register, f"{reason}; {now}")
        self.reason = reason


class ValuesRefused(ValueRefused):
    """Several values were refused before anything was sent: `refusals` has one error for each register."""

    def __init__(self, refusals: Sequence[ValueRefused]) -> None:
        self.refusals = tuple(refusals)
        super().__init__(", ".join(one.register for one in self.refusals), "; ".join(map(str, self.refusals)))
        self.args = (f"{len(self.refusals)} values refused, nothing was written: {self.reason}",)


class WriteFailed(RegscribeError):  # noqa: N818 (as above)
    """A write to `register` (a path, or the id of a command) was sent and did not succeed."""

    def __init__(self, register: str, reason: str) -> None:
        self.register, self.reason = register, reason
        Exception.__init__(self, f"{register}: {reason}")


class NotWritten(WriteFailed):
    """The write was certainly not carried out; `__cause__` is what happened on the line."""


class WriteUnknown(WriteFailed):
    """Whether the write was carried out cannot be told; it was not sent again. `__cause__` is what happened."""


class ReadBackDiffers(WriteFailed):
    """The device took the write and holds something else: it rounded, clipped or ignored the value.

    `sent` and `read` are words, `value` and `held` what they mean (None for words that mean nothing).
    """

    def __init__(self, register: str, *, sent: tuple[int, ...], read: tuple[int, ...], value: Any, held: Any) -> None:
        self.sent, self.read, self.value, self.held = sent, read, value, held
        shown = f"{value} was sent (words {list(sent)}), the device holds {held} (words {list(read)})"
        super().__init__(register, f"{shown}: it changed the value or did not take it")


class NotApplied(WriteFailed):
    """The register was written, but the command that makes it take effect was not carried out, or may not have been."""


class NotConfigured(WriteFailed):
    """`configure` broke off (`why`); `report` has the fate of each register: written, undone, unknown."""

    def __init__(self, reason: str, report: WriteReport) -> None:
        self.why, self.report = reason, report
        super().__init__("configure", f"{reason}. {report.told}")


class LeftAt(WriteFailed):
    """After `register` was written the device answers neither under its former settings nor under the new ones.

    `before` and `asked` are the two settings in words.
    """

    def __init__(self, register: str, *, before: str, asked: str, reason: str) -> None:
        self.before, self.asked = before, asked
        super().__init__(register, f"{reason}. Before: {before}. Asked for: {asked}")


class ValueNotDecodable(RegscribeError, ValueError):  # noqa: N818 (as above)
    """Words that are no value of the register; `words` are as read."""

    def __init__(self, register: str, reason: str, words: tuple[int, ...] = ()) -> None:
        self.register, self.reason, self.words = register, reason, words
        super().__init__(f"{register}: {reason}")


class SensorFault(ValueNotDecodable):
    """The device reports fault `fault` (an id of the map) in place of a value; `label` is the manual's name."""

    def __init__(self, register: str, fault: str, label: str, words: tuple[int, ...] = ()) -> None:
        self.fault, self.label = fault, label
        super().__init__(register, f"fault {label} ({fault}) instead of a value", words)


class Saturated(ValueNotDecodable):
    """The view stands at the end of its range: the true value lies there or beyond, so it is not decoded."""


class OutOfRange(ValueNotDecodable):
    """The number lies outside what the manual calls valid: whatever is wrong, it is no value."""


class NotDecodable(ValueNotDecodable):
    """Words without meaning in the present state: no scale holds, not a number, too many digits of a version."""


LOST = (NoAnswer, LinkLost, WrongAnswer)
"""Errors after which a write may have been carried out nevertheless."""

UNDECIDED = frozenset({4, 5, 11})
"""Exceptions after which a write may have been carried out: failed midway, taken but not done, and a gateway's."""


def is_lost(error: Exception) -> bool:
    """Whether a write may have been carried out although it ended in this error."""
    if isinstance(error, ExceptionAnswer):
        return error.code in UNDECIDED and not error.name
    return isinstance(error, LOST) and not isinstance(error, PartialWrite | NotOpen)


_BOTH: dict[tuple[type[WriteFailed], type[RegscribeError]], type[WriteFailed]] = {}


def _both(kind: type[WriteFailed], base: type[RegscribeError]) -> type[WriteFailed]:
    """One class for each pair, so that errors can be told apart by their class."""
    if (kind, base) not in _BOTH:
        _BOTH[kind, base] = type(f"{kind.__name__}{base.__name__}", (kind, base), {"__doc__": kind.__doc__})
    return _BOTH[kind, base]


def lost(kind: type[WriteFailed], register: str, reason: str, cause: Exception) -> WriteFailed:
    """An error of `kind` that is of the class of its cause as well: NoAnswer, LinkLost or WrongAnswer."""
    base = next((one for one in LOST if isinstance(cause, one)), None)
    if base is not None:
        kind = _both(kind, base)
    error = kind.__new__(kind)
    error.__dict__.update(vars(cause))
    WriteFailed.__init__(error, register, reason)
    error.__cause__ = cause
    return error
