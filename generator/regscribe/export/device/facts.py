"""The facts that a register of a map can have, of which a form of another program carries some.

An exporter declares what it carries (`Carries`); of every other fact that a register has, the loss follows from here.
So a fact that nobody thought of is told and not dropped: a test holds the table against the fields of a register.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from enum import StrEnum
from fractions import Fraction
from typing import NamedTuple

from regscribe.emit.words import (
    condition_words,
    conversion_words,
    one_line,
    order_words,
    range_words,
    sentinel_words,
    step_words,
)
from regscribe.losses import Grade, Loss
from regscribe.model import IDENTITY, Cases, Kind, Model, Number, OrderCases, Range, Register, RegisterMap, View, show
from regscribe_runtime.values.kinds import MOMENTS
from regscribe_runtime.values.terms import givens_in, registers_in
from regscribe_runtime.values.views import scale_needs


class Carry(StrEnum):
    """How much of a fact a form carries; `FIXED`: worked out for one state of the device."""

    WHOLE = "yes"
    FIXED = "fixed"
    PARTLY = "partly"
    NO = "no"


Carries = Mapping[str, Carry]
"""What a form carries, by the id of the fact; what is not in it is lost. The losses of PARTLY the exporter tells."""


class Fact(NamedTuple):
    """A fact: its id, what it is in a few words, how grave its loss is, and what a register has of it (or nothing).

    `fields` are those of `Register` that say it. A fact `of` another one means nothing where that one is lost.
    """

    id: str
    title: str
    grade: Grade
    fields: tuple[str, ...]
    words: Callable[[Register], str]
    of: str = ""


def _when(register: Register) -> str:
    return "" if register.when.always else f"it exists only while {one_line(condition_words(register.when))}"


def _scale_register(register: Register) -> str:
    views = [view.times for view in register.views if view.times is not None]
    terms = [term for case in register.scale for term in (case.then.multiply, case.then.add)]
    needed = dict.fromkeys([*scale_needs(register), *registers_in(*views), *givens_in(*terms, *views)])
    return f"its scale depends on {', '.join(needed)}" if needed else ""


def _scale(register: Register) -> str:
    plain = [one for one in register.scale if one.then != IDENTITY]
    return f"its scale is {conversion_words(plain[0].then)}" if plain else ""


def _offset(register: Register) -> str:
    return "its scale adds a number" if any(case.then.add for case in register.scale) else ""


def _order_register(register: Register) -> str:
    orders = [order for view in register.views for order in (view.order, view.byte_order)]
    return next((f"its order is {order_words(one)}" for one in orders if isinstance(one, OrderCases)), "")


def _units(register: Register) -> tuple[str, ...]:
    return tuple(dict.fromkeys(case.then for case in register.unit if case.then))


def _unit_register(register: Register) -> str:
    conditional = any(not case.when.always for case in register.unit)
    return f"its unit is {' or '.join(_units(register))} by condition" if conditional and _units(register) else ""


def _is_plain(cases: Cases[Range]) -> bool:
    return all(
        case.when.always
        and case.then.decimals is None
        and all(isinstance(end, Number | str) for interval in case.then.intervals for end in interval)
        for case in cases
    )


def _range(register: Register) -> str:
    return f"its range is {range_words(register.range[0].then)}" if register.range else ""


def _range_register(register: Register) -> str:
    return "" if _is_plain(register.range) else "its range depends on other registers"


def _range_union(register: Register) -> str:
    return "its range has gaps" if any(len(case.then.intervals) > 1 for case in register.range) else ""


def _step(register: Register) -> str:
    """A step that is coarser than the number on the wire of each view."""
    stepped = [case.then for case in register.scale if case.then.step is not None]
    coarse = any(
        not view.type.is_integer or one.places is not None or (one.step or 0) * Fraction(view.factor) != 1
        for one in stepped
        for view in register.views
    )
    return f"it can be set in steps only{step_words(stepped[0])}" if coarse else ""


def _valid(register: Register) -> str:
    return f"a reading is valid within {range_words(register.valid[0].then)}" if register.valid else ""


def _saturates(register: Register) -> str:
    clipped = any(view.saturates for view in register.views)
    return "the lowest and the highest number on the wire stand for values beyond them" if clipped else ""


def _padding(register: Register) -> str:
    if register.kind is not Kind.STRING:
        return ""
    return f"what fills it up (0x{register.text.padding:02X}) and what follows its end are part of the text"


def _sentinels(register: Register) -> str:
    return f"fault words: {', '.join(one_line(sentinel_words(one)) for one in register.sentinels)}"


def _sentinels_by_case(register: Register) -> str:
    by_case = any(not one.when.always for one in register.sentinels)
    return f"by condition, {_sentinels(register)}" if by_case else ""


def _standing(register: Register) -> str:
    found = [one for one in register.specials if one.means is not None and one.means != one.code]
    return ", ".join(f"{show(one.code)} stands for {show(one.value)}" for one in found)


def _fields(register: Register) -> str:
    wide = [one for one in register.fields if not one.is_flag]
    return f"parts of the word: {', '.join(one.id for one in wide)}" if wide else ""


def _flags(register: Register) -> str:
    flags = [one for one in register.fields if one.is_flag]
    return f"{len(flags)} named bits" if flags else ""


def _write_condition(register: Register) -> str:
    return f"writes are accepted only while {condition_words(register.writable.when)}" if register.writable else ""


def _commands(register: Register) -> str:
    named = [f"{word} {one}" for word, one in (("unlock", register.unlock), ("apply", register.apply)) if one]
    return f"a write needs the command {' and '.join(named)}" if named else ""


def _memory(register: Register) -> str:
    most = f", {register.endurance} writes at most" if register.endurance else ""
    return f"kept in {register.persistence}{most}" if register.persistence or most else ""


def _poll(register: Register) -> str:
    reading = register.reading
    said = [
        f"poll {reading.poll}" if reading.poll else "",
        f"good for {reading.good_for} s" if reading.good_for else "",
    ]
    return ", ".join(filter(None, [*said, "static" if register.static else ""]))


def _functions(register: Register) -> str:
    named = {function for view in register.views for function in view.functions}
    return f"only the functions {', '.join(map(str, sorted(named)))} may address it" if named else ""


def _relations(register: Register) -> str:
    named = (("shadows", register.shadows), ("rereads", register.rereads), ("rescales", register.rescales))
    said = [f"{word} {other}" for word, other in named if other]
    said += ["follows another register"] if register.follows else []
    return ", ".join(said + (["counts a distance"] if register.difference else []))


def _default(register: Register) -> str:
    return "default" if register.beginnings else ""


def _said(field: str, words: str) -> Callable[[Register], str]:
    """The words of a fact that a field says as soon as it is not empty."""
    return lambda register: words if getattr(register, field) else ""


def _of_kind(*kinds: Kind) -> Callable[[Register], str]:
    return lambda register: f"it is a {register.kind}" if register.kind in kinds else ""


WRONG, LOST, COSMETIC = Grade

FACTS = (
    Fact("condition", "existence under a condition", WRONG, ("when",), _when),
    Fact(
        "parts-condition",
        "codes, flags, parts that exist under a condition",
        WRONG,
        ("enum", "fields"),
        lambda register: "some of its codes or parts exist under a condition" if register.partial else "",
    ),
    Fact("scale", "scale", LOST, ("scale", "views"), _scale),
    Fact("offset", "offset", LOST, ("scale",), _offset, "scale"),
    Fact(
        "scale-register",
        "scale by other registers",
        WRONG,
        ("scale", "special_scale", "views"),
        _scale_register,
        "scale",
    ),
    Fact("word-order-register", "order by other registers", WRONG, ("views",), _order_register),
    Fact("scale-not-stated", "that the scale is not stated", COSMETIC, ("kind",), _of_kind(Kind.RAW)),
    Fact("unit", "unit", LOST, ("unit",), lambda register: " or ".join(_units(register))),
    Fact("unit-register", "unit by condition", WRONG, ("unit",), _unit_register, "unit"),
    Fact("range", "range of writes", LOST, ("range",), lambda one: _range(one) if one.access.writable else "", "write"),
    Fact("range-register", "range by other registers", WRONG, ("range",), _range_register, "range"),
    Fact("range-union", "range with gaps", LOST, ("range",), _range_union, "range"),
    Fact("step", "steps of writes", LOST, ("scale",), lambda one: _step(one) if one.access.writable else "", "write"),
    Fact("valid", "limits of a valid reading", LOST, ("valid",), _valid),
    Fact("saturates", "that a reading may be clipped", WRONG, ("views",), _saturates),
    Fact("sentinel", "fault words", WRONG, ("sentinels",), lambda one: _sentinels(one) if one.sentinels else ""),
    Fact("sentinel-condition", "fault words by condition", WRONG, ("sentinels",), _sentinels_by_case, "sentinel"),
    Fact("special-value", "special values beside the range", LOST, ("specials",), _said("specials", "special values")),
    Fact("special-number", "special values that stand for another number", WRONG, ("specials",), _standing),
    Fact("enum", "codes with labels", LOST, ("enum",), _said("enum", "its codes have labels")),
    Fact("flags", "named bits", LOST, ("fields", "none"), _flags),
    Fact("fields", "parts of a word", LOST, ("fields",), _fields),
    Fact("boolean", "truth values in words", LOST, ("kind",), _of_kind(Kind.BOOLEAN)),
    Fact("string", "texts", LOST, ("kind", "text"), _of_kind(Kind.STRING)),
    Fact("padding", "what fills a text up", LOST, ("kind", "text"), _padding, "string"),
    Fact("version", "versions", LOST, ("kind", "version_digits", "version_group"), _of_kind(Kind.VERSION)),
    Fact("bytes", "bytes, IP and MAC addresses", LOST, ("kind",), _of_kind(Kind.BYTES, Kind.IPV4, Kind.IPV6, Kind.MAC)),
    Fact("date", "dates and times", LOST, ("kind", "layout"), _of_kind(*MOMENTS)),
    Fact("write", "writes", LOST, ("access",), lambda one: "it can be written" if one.access.writable else ""),
    Fact("write-only", "write only", LOST, ("access",), lambda one: "" if one.access.readable else "it is write only"),
    Fact("write-condition", "when a write is accepted", LOST, ("writable",), _write_condition, "write"),
    Fact("unlock-apply", "commands around a write", LOST, ("unlock", "apply"), _commands, "write"),
    Fact(
        "settle",
        "time to settle after a write",
        COSMETIC,
        ("settle",),
        _said("settle", "it needs time to settle"),
        "write",
    ),
    Fact(
        "line-setting",
        "that a write changes the line",
        LOST,
        ("governs",),
        _said("governs", "it sets the line"),
        "write",
    ),
    Fact("danger", "danger of a write", LOST, ("danger",), lambda one: one_line(one.danger), "write"),
    Fact("memory-wear", "kind and endurance of memory", LOST, ("persistence", "endurance"), _memory, "write"),
    Fact("default", "default", COSMETIC, ("default", "delivered", "default_cases", "delivered_cases"), _default),
    Fact("poll", "how often to read", COSMETIC, ("reading", "static"), _poll),
    Fact("view", "further views", COSMETIC, ("views",), lambda one: "further views" if len(one.views) > 1 else ""),
    Fact("alias", "further addresses", COSMETIC, ("aliases",), _said("aliases", "further addresses")),
    Fact("functions", "functions that may address it", LOST, ("views",), _functions),
    Fact("page", "pages and other unit ids", LOST, ("page", "unit_id"), _said("page", "it stands on a page")),
    Fact("block", "blocks that the device tells", WRONG, ("block",), _said("block", "its block moves")),
    Fact("array", "arrays", COSMETIC, ("array", "index"), _said("array", "an element of an array")),
    Fact("group", "groups", COSMETIC, ("group",), _said("group", "its group")),
    Fact("name", "the manual's name", COSMETIC, ("name",), _said("name", "its name")),
    Fact("symbol", "the manual's short code", COSMETIC, ("symbol", "printed"), _said("symbol", "its short code")),
    Fact("description", "description", COSMETIC, ("description",), _said("description", "its description")),
    Fact("source", "where the manual says it", COSMETIC, ("section", "inferred"), _said("section", "its source")),
    Fact(
        "relations",
        "relations of registers",
        COSMETIC,
        ("shadows", "rereads", "rescales", "follows", "difference"),
        _relations,
    ),
    Fact(
        "identity",
        "what is each device's own, or on some only",
        COSMETIC,
        ("stays", "mandatory"),
        lambda one: one.stays or ("not each device has it" if one.mandatory is False else ""),
    ),
)
"""Every fact of a register, the gravest loss of a family first."""

NEUTRAL = frozenset({"id", "path", "at", "rules", "span"})
"""Fields of a register that are no facts of their own: its place and its names in programs."""

KINDS = {
    Kind.BOOLEAN: "boolean",
    Kind.STRING: "string",
    Kind.VERSION: "version",
    **dict.fromkeys((Kind.BYTES, Kind.IPV4, Kind.IPV6, Kind.MAC), "bytes"),
    **dict.fromkeys(MOMENTS, "date"),
}
"""The fact without which a register of that kind cannot be said at all; other kinds are numbers at least."""


class DeviceFact(NamedTuple):
    """A fact of a whole model: its id, what it is, how grave its loss is, and what the model has of it (or nothing)."""

    id: str
    title: str
    grade: Grade
    words: Callable[[RegisterMap, Model], str]


def _named(what: str, field: str) -> Callable[[RegisterMap, Model], str]:
    def words(_: RegisterMap, model: Model) -> str:
        some: tuple[object, ...] = getattr(model, field)
        return f"{len(some)} {what}" if some else ""

    return words


DEVICE_FACTS = (
    DeviceFact("commands", "commands", LOST, _named("commands", "commands")),
    DeviceFact("computed", "computed values", LOST, _named("computed values", "computed")),
    DeviceFact("programs", "setpoint programs", LOST, _named("programs", "programs")),
    DeviceFact(
        "givens", "facts that the user states", WRONG, lambda one, _: ", ".join(given.id for given in one.givens)
    ),
    DeviceFact(
        "limits",
        "most registers in a request",
        LOST,
        lambda one, _: f"{one.protocol.read_words} words in a request" if one.protocol.read_words < MOST_WORDS else "",
    ),
    DeviceFact(
        "pause",
        "pause between an answer and the next request",
        LOST,
        lambda one, _: f"{show(one.protocol.pause)} ms after each answer" if one.protocol.pause else "",
    ),
    DeviceFact(
        "errata", "errors of the manual", COSMETIC, lambda one, _: f"{len(one.errata)} errata" * bool(one.errata)
    ),
)
"""Every fact of a model beside its registers."""

MOST_WORDS = 125
"""Words in a request that programs of the field take for granted."""

RESOLVED: dict[str, Carry] = dict.fromkeys(
    (
        *("condition", "parts-condition", "scale-register", "word-order-register", "unit-register", "range-register"),
        *("block", "givens", "sentinel-condition"),
    ),
    Carry.FIXED,
)
"""What a `Point` has worked out for one state of the device; a form that says `condition` itself has all registers."""


BY_ID = {fact.id: fact for fact in FACTS}

TOLD = {
    "register": "the whole register",
    "scale-rounded": "a scale without a finite decimal",
    "precision-float32": "digits of numbers beyond what a float of 32 bits tells apart",
    "label-cut": "the end of a label that is too long",
    "precision-float64": "digits of numbers beyond what a float of 64 bits tells apart",
    "decimals-cut": "decimals of a number that may have any",
    "several-sentinels": "one of several fault words",
    "sentinel-label": "what a fault word means",
    "write-echo": "whether a write was refused",
    "truth-of-words": "words that are neither 0 nor 1",
    "label-changed": "characters of a label that the form does not have",
    "type-unread": "a type that the form has, and the usual program for it does not read",
    "unit-unmapped": "a unit that the form does not know",
    "unit-base": "a unit whose values are exported in another one",
    "serial-line": "speed and character format of the serial line",
}
"""What exporters tell by themselves, by code: what a form makes of a fact, which no fact alone decides."""

CODES = frozenset({*BY_ID, *TOLD, *(fact.id for fact in DEVICE_FACTS)})
"""The codes that a loss may have."""


def losses_of(register: Register, carries: Carries, model: str = "", view: View | None = None) -> Iterator[Loss]:
    """Yield what of a register is lost by a form that carries so much of each fact, and reads it in this view alone."""
    seen = register if view is None else replace(register, views=(view,))
    for fact in FACTS:
        carry = carries.get(fact.id, Carry.NO)
        if carry in {Carry.WHOLE, Carry.PARTLY} or _is_moot(fact, carries):
            continue
        words = fact.words(register if fact.id == "view" else seen)
        if words:
            fixed = carry is Carry.FIXED
            done = f"fixed for the device as stated: {words}" if fixed else f"left out: {words}"
            yield Loss(register.path, fact.id, Grade.WRONG if fixed else fact.grade, done, model)


def _is_moot(fact: Fact, carries: Carries) -> bool:
    """Whether a fact means nothing, as the one that it belongs to is lost."""
    if not fact.of:
        return False
    return carries.get(fact.of, Carry.NO) is Carry.NO or _is_moot(BY_ID[fact.of], carries)


def device_losses(register_map: RegisterMap, model: Model, carries: Carries) -> Iterator[Loss]:
    """Yield what of a model beside its registers is lost."""
    for fact in DEVICE_FACTS:
        carry = carries.get(fact.id, Carry.NO)
        words = fact.words(register_map, model)
        if words and carry in {Carry.NO, Carry.FIXED}:
            fixed = carry is Carry.FIXED
            done = f"fixed as stated: {words}" if fixed else f"left out: {words}"
            yield Loss("", fact.id, Grade.WRONG if fixed else fact.grade, done, model.name)
