"""Facts of a register that have no column of their own: an object with the keys of the map language.

What a plain value says is that value, as a map has it; what depends on conditions stands in words.
"""

from collections.abc import Iterator
from fractions import Fraction

from regscribe.emit.words import (
    ROUNDING,
    cases_words,
    condition_words,
    listed,
    map_cases,
    one_line,
    order_words,
    plain_interval,
    range_words,
    sentinel_words,
    term_words,
)
from regscribe.model import Cases, Model, Order, OrderCases, Range, Register, View, show
from regscribe_runtime.values.facts import Governs
from regscribe_runtime.values.octets import BLANK, FF, NUL, PLAIN_TEXT, TextForm
from regscribe_runtime.values.orders import orders_of

BYTES = {BLANK: "blank", NUL: "nul", FF: "ff"}
TEXTS = ("printed", "description", "danger", "unlock", "apply", "rescales", "shadows", "rereads", "stays")
NUMBERS = ("endurance", "settle", "static", "difference")

Fact = tuple[str, object]


def further(register: Register, model: Model) -> dict[str, object]:
    """Return the facts that are stated, by key."""
    facts = (*_transmission(register), *_form(register), *_conduct(register), *_reading(register))
    found = {key: value for key, value in facts if value}
    if register.writable:
        when, reason = register.writable
        found["writable"] = one_line(f"while {condition_words(when, model)}: {reason}")
    if partial := _partial(register, model):
        found["partial"] = partial
    return found | ({} if register.mandatory is None else {"mandatory": register.mandatory})


def _partial(register: Register, model: Model) -> str:
    """What of the value exists under conditions only, in words."""
    cases = register.enum.cases if register.enum else ()
    enums = [(listed(list(case.then.labels.values())), case.when) for case in cases]
    members = [(one.label, one.when) for one in register.enum.members] if register.enum and not cases else []
    parts = [*enums, *members, *((one.label, one.when) for one in register.fields)]
    words = (f"{label} while {condition_words(when, model)}" for label, when in parts if not when.always)
    return one_line("; ".join(words))


def _transmission(register: Register) -> Iterator[Fact]:
    view = register.base
    if view.is_byte:
        yield "byte", "high" if view.byte_order is Order.LITTLE else "low"
    elif view.byte_order is not Order.BIG:
        yield "byte_order", _order(view.byte_order)
    if view.is_apart:
        yield "at", _apart(register, view)
    elif view.order is not Order.BIG:
        yield "word_order", _order(view.order)
    yield "transmitted", _transmitted(view)
    if register.is_written_apart:
        yield _write(register, register.views[1])
    else:
        yield "functions", list(view.functions)


def _write(register: Register, other: View) -> Fact:
    """Where it is written: an address alone, or what is otherwise there."""
    base, at = register.base, other.space.inside(other.address(register.at))
    if _form_of(other) == _form_of(base) and set(other.functions) == set(other.space.write_functions):
        return "write_at", at
    functions = f" by functions {', '.join(map(str, other.functions))}" if other.functions else ""
    return "write", f"at {other.space} {at} as {other.type}{functions}"


def _form_of(view: View) -> tuple[object, ...]:
    return view.space, view.type, view.words, view.order, view.byte_order, view.factor


def _apart(register: Register, view: View) -> list[int]:
    """The address of each word, that of the most significant first."""
    first = view.space.inside(view.address(register.at))
    order = orders_of(view.order)[0]
    offsets = view.offsets if isinstance(order, Order) else [place - 1 for place in order]
    return [first + offset for offset in offsets]


def _transmitted(view: View) -> str:
    """What only a set of views says of the way in which a number is sent."""
    parts = (
        f"stored value times {show(view.factor)}" if view.factor != 1 else "",
        f"stored value times {term_words(view.times)}" if view.times is not None else "",
        ROUNDING[view.rounding],
        "clipped" if view.saturates else "",
        f"aligned to {view.align}" if view.align > 1 else "",
        f"in {view.region[0]}..{view.region[1]}" if view.region else "",
    )
    return ", ".join(filter(None, parts))


def _order(order: object) -> object:
    if isinstance(order, OrderCases):
        return one_line(order_words(order))
    return str(order) if isinstance(order, Order) else list(order)  # type: ignore[call-overload] # places of words


def _form(register: Register) -> Iterator[Fact]:
    yield "layout", register.layout
    if register.text != PLAIN_TEXT:
        yield "text", _text(register.text)
    if digits := register.version_digits:
        group = register.version_group or digits
        yield "version", ".".join("n" * min(group, digits - start) for start in range(0, digits, group))
    if register.sentinels:
        always = all(one.when.always for one in register.sentinels)
        labels = {one.spelled: one_line(one.label) for one in register.sentinels}
        yield "sentinels", labels if always else "; ".join(map(sentinel_words, register.sentinels))
    yield "stands_for", {show(one.code): show(one.means) for one in register.specials if one.means is not None}
    if register.valid:
        yield "valid", valid_words(register.valid)
    if register.delivered is not None:
        yield "delivered", beginning(register.delivered)
    elif register.delivered_cases:
        yield "delivered", cases_words(map_cases(register.delivered_cases, beginning))


def valid_words(cases: Cases[Range]) -> str:
    """Return what a reading must lie in: `0..100`, or cases in words; empty where anything is valid."""
    plain = plain_interval(cases)
    words = cases_words(map_cases(cases, range_words))
    return f"{show(plain[0])}..{show(plain[1])}" if plain else one_line(words)


def beginning(value: Fraction | str) -> str:
    """Return what a new device holds: a number (a code, the bits of a word) or a text."""
    return show(value) if isinstance(value, Fraction) else one_line(value)


def _text(form: TextForm) -> dict[str, object]:
    ends = [BYTES[one] for one in form.ends]
    return {
        "encoding": form.encoding,
        **({"one_per_register": form.per_register} if form.per_register else {}),
        **({"padding": BYTES[form.padding]} if form.padding != PLAIN_TEXT.padding else {}),
        **({"ends": ends or "length"} if form.ends != PLAIN_TEXT.ends else {}),
    }


def _conduct(register: Register) -> Iterator[Fact]:
    yield from ((name, one_line(getattr(register, name))) for name in TEXTS)
    yield from ((name, getattr(register, name)) for name in NUMBERS)
    yield "follows", one_line(cases_words(register.follows))
    yield "governs", register.governs and one_line(_governed(register.governs))
    yield "inferred", [one_line(f"{one.what}: {one.why}") for one in register.inferred]


def _governed(governs: Governs) -> str:
    codes = ", ".join(f"{code} = {text}" for code, text in governs.codes)
    return f"{governs.setting}{codes and f': {codes}'}{governs.since and f' ({governs.since})'}"


def _reading(register: Register) -> Iterator[Fact]:
    clears, poll, good_for = register.reading
    yield "reading", "clears" if clears else ""
    yield "poll", poll if isinstance(poll, str) else float(poll)
    yield "good_for", float(good_for)
