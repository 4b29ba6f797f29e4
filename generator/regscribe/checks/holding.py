"""Whether a register can hold what a map says it does: the default, what it is delivered with, what an effect sets."""

from fractions import Fraction

from regscribe.checks.carrying import Fit, best_fit, is_meant
from regscribe.model import Kind, Register, show
from regscribe.model.reference import RefusedError, number_of, version_number

TEXTS = frozenset({Kind.STRING, Kind.VERSION})
PATTERNS = frozenset({Kind.FLAGS, Kind.FIELDS})


def shown(value: Fraction | str) -> str:
    """A value for a message."""
    return repr(value) if isinstance(value, str) else show(value)


def wrong_sort(register: Register, value: Fraction | str) -> str:
    """Why a value is none of the register's kind, as `which is ...`; empty where it is one."""
    if isinstance(value, str) != (register.kind in TEXTS):
        return f"which is {'a text' if isinstance(value, str) else 'no text'}"
    if register.kind is Kind.BOOLEAN and value not in {0, 1}:
        return "which is neither 0 nor 1"
    if not isinstance(value, str):
        return ""
    return _no_version(register, value) if register.kind is Kind.VERSION else _no_text(register, value)


def _no_version(register: Register, text: str) -> str:
    try:
        version_number(register, text)
    except RefusedError:
        size = register.version_group or register.version_digits
        pattern = ".".join(["n" * size] * (register.version_digits // (size or 1)))
        return f"which is not written as {pattern}" if register.version_digits else ""
    return ""


def _no_text(register: Register, text: str) -> str:
    room = 2 * register.base.words
    if not text.isascii():
        return "which is no ASCII text"
    if text.endswith(" "):
        return "whose blanks at the end are never read"
    return f"which is {len(text)} characters with room for {room}" if len(text) > room else ""


def outside_type(register: Register, value: Fraction | str) -> bool:
    """Whether no view can carry a value under any scale; never so of a text."""
    number = number_of(register, value)
    if number is None or is_meant(register, number):
        return False
    if register.kind in PATTERNS:
        return not 0 <= number < 1 << register.bits
    return best_fit(register, (number,)) is Fit.TOO_LARGE
