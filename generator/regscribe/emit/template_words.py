"""Facts in words for users' templates, under the names of docs/templates.md.

Each is plain text on one line; nothing is escaped for the language that the template writes.
"""

from fractions import Fraction
from inspect import isfunction
from types import SimpleNamespace

from regscribe.emit import words as text
from regscribe.model import BitField, Conversion, Enum, Member, Register, Sentinel, Special, View, show
from regscribe.model.identifiers import snake


def identifier(name: str) -> str:
    """Lower-case letters, digits and `_`: `segments[1].ramp_time` is `segments_1_ramp_time`."""
    return snake(name)


def line(words: str) -> str:
    """The text with every run of white space as one blank."""
    return text.one_line(words)


def number(value: Fraction) -> str:
    """The exact decimal text (`0.1`), or `1/3` where there is none."""
    return show(value)


def access(register: Register) -> str:
    """`read only`, `read and write` or `write only`."""
    return text.ACCESS[register.access]


def unit(register: Register) -> str:
    """The symbol, by condition where there are several; empty without a unit."""
    return text.cases_words(text.map_cases(register.unit, text.one_line))


def scale(register: Register) -> str:
    """The value of use from the stored number x, `x/10`, by condition where there are several."""
    return text.cases_words(text.map_cases(register.scale, conversion))


def conversion(one: Conversion) -> str:
    """One case of a scale: `0.1*x - 1999.9`."""
    return text.one_line(text.conversion_words(one))


def limits(register: Register) -> str:
    """The range, `0 to 400`, by condition where there are several; empty where the manual gives none."""
    return text.cases_words(text.map_cases(register.range, text.range_words))


def default(register: Register) -> str:
    """The default with its label, `1 = run`; empty where the manual gives none."""
    return text.default_words(register, register.default, register.default_cases)


def order(view: View) -> str:
    """The word order of a view, or the register that sets it."""
    return text.one_line(text.order_words(view.order))


def bits(field: BitField) -> str:
    """`3` or `8..11`."""
    return text.bits_words(field)


def special(one: Special) -> str:
    """`0 = off`."""
    return text.special_words(one)


def sentinel(one: Sentinel) -> str:
    """`-32768 = sensor low`."""
    return text.sentinel_words(one)


def member(one: Member, enum: Enum) -> str:
    """What the manual says of a member beside its label; often empty."""
    return text.member_words(one, enum)


WORDS = SimpleNamespace(
    **{name: word for name, word in globals().items() if isfunction(word) and word.__module__ == __name__}
)
"""The functions of this module, and nothing else of it: a template has them as `words`."""
