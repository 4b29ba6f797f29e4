"""The facts of a register: each field is in FACTS, or in ELSEWHERE with the module that compares it."""

from collections.abc import Callable
from fractions import Fraction
from typing import TypeVar

from regscribe.breaking.change import TEXT_ONLY, Effects
from regscribe.breaking.facts import EXACT, B, C, Fact, H, N, judged, shown, text
from regscribe.breaking.limits import valid_limits, write_limits
from regscribe.breaking.rules import (
    ACCESS_NARROWED,
    ACCESS_WIDENED,
    DEFAULT,
    EXISTENCE,
    FORM,
    KIND,
    PERSISTENCE,
    READING,
    RELATION,
    SCALE,
    TEXT,
    UNIT,
    WRITING,
)
from regscribe.emit.words import (
    ACCESS,
    cases_words,
    condition_words,
    conversion_words,
    default_words,
    map_cases,
    range_words,
)
from regscribe.model import Case, Cases, Conversion, Range, Register, Rule

T = TypeVar("T")


def _access(old: Register, new: Register) -> tuple[Rule, Effects]:
    """Reading and writing apart: what is gone breaks, what came is new."""
    lost = (old.access.readable and not new.access.readable) or (old.access.writable and not new.access.writable)
    return (ACCESS_NARROWED, Effects(B, B)) if lost else (ACCESS_WIDENED, Effects(C, C))


def _scale(old: Register, new: Register) -> tuple[Rule, Effects]:
    """Another scale breaks; steps alone refuse writes where they are coarser, and show values between where finer."""
    if [_unstepped(case) for case in old.scale] != [_unstepped(case) for case in new.scale]:
        return SCALE, Effects(N, B)
    pairs = [(one.then.step, other.then.step) for one, other in zip(old.scale, new.scale, strict=True)]
    finer = all(not after or (before and Fraction(before) % Fraction(after) == 0) for before, after in pairs)
    return SCALE, Effects(N, H if finer or not old.access.writable else B)


def _unstepped(case: Case[Conversion]) -> Case[Conversion]:
    return case._replace(then=case.then._replace(step=None))


def _existence(old: Register, new: Register) -> tuple[Rule, Effects]:
    """What always existed and may lack now breaks those who rely on it."""
    return EXISTENCE, Effects(H, B if old.when.always else C if new.when.always else H)


def _writing(old: Register, new: Register) -> tuple[Rule, Effects]:
    """A condition or a command before the write that is new refuses what was accepted."""
    more = (new.writable and not old.writable) or (new.unlock and not old.unlock) or (new.danger and not old.danger)
    return WRITING, Effects(H, B if more and old.access.writable else H)


def _dangerous(old: Register, new: Register) -> tuple[Rule, Effects]:
    """Whether a write must be confirmed; how the danger is described is for readers."""
    return (TEXT, TEXT_ONLY) if bool(old.danger) == bool(new.danger) else _writing(old, new)


def _reading(old: Register, new: Register) -> tuple[Rule, Effects]:
    """A register that reading clears is not read along any more."""
    return READING, Effects(H if old.reading.clears != new.reading.clears else N, H)


def _unit(old: Register, _: Register) -> tuple[Rule, Effects]:
    """A unit where none was stated, the number being the same, harms least."""
    return UNIT, Effects(N, H if not any(case.then for case in old.unit) else B)


def _presence(old: Register, new: Register) -> tuple[Rule, Effects]:
    """Whether each device has it."""
    return READING, Effects(N, H if old.mandatory else C if new.mandatory else H)


def _cases(cases: Cases[T], words: Callable[[T], str]) -> str:
    return cases_words(map_cases(cases, words), EXACT) or "none"


def _range(name: str) -> Callable[[Register], str]:
    def words(register: Register) -> str:
        cases: Cases[Range] = getattr(register, name)
        return _cases(cases, range_words)

    return words


def _danger(register: Register) -> str:
    return f"dangerous: {register.danger}" if register.danger else "not dangerous"


FACTS: tuple[Fact[Register], ...] = (
    Fact(("kind",), "kind of value", judged(KIND, N, B)),
    Fact(("access",), "access", _access, lambda one: ACCESS[one.access]),
    Fact(("scale",), "scale", _scale, lambda one: _cases(one.scale, conversion_words)),
    Fact(("special_scale",), "scale of special values", judged(SCALE, N, B)),
    Fact(("unit",), "unit", _unit, lambda one: _cases(one.unit, lambda unit: unit or "no unit")),
    Fact(("range",), "range", write_limits, _range("range")),
    Fact(("valid",), "valid readings", valid_limits, _range("valid")),
    Fact(
        ("default", "default_cases"),
        "default",
        judged(DEFAULT, H, H),
        lambda one: default_words(one, one.default, one.default_cases, EXACT) or "none",
    ),
    Fact(
        ("delivered", "delivered_cases"),
        "delivered value",
        judged(DEFAULT, H, H),
        lambda one: default_words(one, one.delivered, one.delivered_cases, EXACT) or "none",
    ),
    Fact(("when",), "condition of existence", _existence, lambda one: condition_words(one.when)),
    Fact(("writable",), "condition of writing", _writing, lambda one: shown(one.writable)),
    Fact(("unlock",), "command before a write", _writing),
    Fact(("apply",), "command after a write", judged(WRITING, H, H)),
    Fact(("settle",), "settling time in ms", judged(WRITING, H, H)),
    Fact(("danger",), "danger", _dangerous, _danger),
    Fact(("persistence",), "memory", judged(PERSISTENCE, H, H)),
    Fact(("endurance",), "endurance in writes", judged(PERSISTENCE, H, H)),
    Fact(("governs",), "line setting", judged(RELATION, H, H)),
    Fact(("stays",), "why it is not copied", judged(RELATION, N, H)),
    Fact(("shadows",), "register at power-up", judged(RELATION, H, H)),
    Fact(("rereads",), "register read again", judged(RELATION, H, H)),
    Fact(("follows",), "register followed", judged(RELATION, H, H), lambda one: _cases(one.follows, str)),
    Fact(("difference",), "a distance", judged(RELATION, H, H)),
    Fact(("reading",), "way of reading", _reading),
    Fact(("static",), "never changes", judged(READING, N, H)),
    Fact(("mandatory",), "on each device", _presence),
    Fact(("text",), "form of the text", judged(FORM, B, B)),
    Fact(("layout",), "layout of the date", judged(FORM, B, B)),
    Fact(("version_digits", "version_group"), "digits of the version", judged(FORM, N, B)),
    text("name"),
    text("symbol"),
    text("printed", "printed symbol"),
    text("description"),
    text("section"),
    text("none", "label of no bit"),
    text("inferred", "what was inferred"),
)
"""Facts that are compared as they stand."""

ELSEWHERE = {
    "id": "pairs",
    "path": "pairs",
    "array": "arrays",
    "index": "arrays",
    "group": "registers",
    "unit_id": "registers",
    "rescales": "registers",
    "at": "places",
    "views": "places",
    "aliases": "places",
    "page": "places",
    "block": "places",
    "enum": "codes",
    "specials": "codes",
    "sentinels": "codes",
    "fields": "parts",
}
"""Fields that are compared part by part, and the module that does so."""

UNCOMPARED = {
    "rules": "names of rules of the map; what the rules say is compared",
    "span": "a place in a file",
}
"""Fields that nobody but the map itself sees, and why."""
