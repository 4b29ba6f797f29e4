"""What can go wrong when a driver talks to a device: one small tree.

RegscribeError
├── LinkLost            the link is closed, or broke
├── NoAnswer            nothing came within the response timeout
├── ExceptionAnswer     the device refused, with a code and its own meaning of it
├── WrongAnswer         an answer that does not fit the request
│   └── PartialWrite    fewer words were written than were sent
├── ValueRefused        refused here, before anything was sent
└── ValueNotDecodable   words that are no value of the register
    ├── SensorFault     a sentinel: the device reports a fault instead of a number
    ├── Saturated       the view was clipped: the true value lies at or beyond its end
    └── NotDecodable    anything else (no scale holds, not a number, a version with too many digits)
"""


class RegscribeError(Exception):
    """Base of all errors of a driver."""


class LinkLost(RegscribeError, ConnectionError):  # noqa: N818 (the field's word; the tree says it is an error)
    """The link is closed or broke; whether a request under way was carried out is unknown."""


class NoAnswer(RegscribeError, TimeoutError):  # noqa: N818 (as above)
    """No answer from `unit` to `function` at `address` within the response timeout.

    A write may have been carried out nevertheless; it is never sent a second time.
    """

    def __init__(self, *, unit: int, function: int, address: int, seconds: float) -> None:
        self.unit, self.function, self.address, self.seconds = unit, function, address, seconds
        super().__init__(f"unit {unit} gave no answer to function {function:02d} at address {address} in {seconds:g} s")


class ExceptionAnswer(RegscribeError):  # noqa: N818 (as above)
    """The device answered with exception `code`; `name` and `meaning` are the device's own."""

    def __init__(self, *, unit: int, function: int, address: int, code: int, name: str, meaning: str) -> None:
        self.unit, self.function, self.address = unit, function, address
        self.code, self.name, self.meaning = code, name, meaning
        said = f" ({name}: {meaning})" if meaning else f" ({name})" if name else ""
        super().__init__(
            f"unit {unit} refused function {function:02d} at address {address} with exception {code:02d}{said}"
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


class ValueRefused(RegscribeError, ValueError):  # noqa: N818 (as above)
    """A write that was refused before anything was sent: access, range, resolution, type or condition."""

    def __init__(self, register: str, reason: str) -> None:
        self.register, self.reason = register, reason
        super().__init__(f"{register}: {reason}")


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
    """The view stands at the end of its range: the value is this or beyond, so it is not decoded."""


class NotDecodable(ValueNotDecodable):
    """Words that mean nothing under the present state of the device."""
