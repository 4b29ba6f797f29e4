"""The facts of one register that fit on a line each, as a table of two columns."""

from collections.abc import Iterator, Sequence
from fractions import Fraction

from regscribe.emit.markdown.context import PageContext, fact_table
from regscribe.emit.markdown.escape import Md, code, escape, join, lines, link, md, prose
from regscribe.emit.markdown.page_values import PageTable
from regscribe.emit.markdown.process import follows
from regscribe.emit.octet_words import octets_words
from regscribe.emit.outline import Leaf, aliases, formula
from regscribe.emit.words import (
    ACCESS,
    LETTERS,
    ROUNDING,
    Wording,
    cases_words,
    conversion_words,
    default_words,
    map_cases,
    one_line,
    order_words,
    range_words,
    sentinel_words,
    special_words,
    term_words,
)
from regscribe.model import IDENTITY, Array, Kind, Model, Order, OrderCases, Register, Setting, View, show
from regscribe_runtime.values.kinds import OCTETS

KINDS = {
    Kind.NUMBER: "number",
    Kind.INTEGER: "whole number",
    Kind.RAW: "raw whole number; the manual does not state its scale",
    Kind.ENUM: "one of a list of codes",
    Kind.FLAGS: "bits, see below",
    Kind.FIELDS: "bit fields, see below",
    Kind.STRING: "text",
    Kind.BYTES: "raw bytes",
    Kind.IPV4: "address of a network (IPv4)",
    Kind.IPV6: "address of a network (IPv6)",
    Kind.MAC: "hardware address",
    Kind.DATETIME: "date and time",
    Kind.DATE: "date",
    Kind.TIME: "time",
    Kind.VERSION: "version, packed decimal digits",
    Kind.BOOLEAN: "yes (1) or no (0)",
}
SETTINGS = {
    Setting.ADDRESS: "unit id",
    Setting.BAUD: "speed",
    Setting.PARITY: "parity",
    Setting.DATA_BITS: "data bits",
    Setting.STOP_BITS: "stop bits",
    Setting.FORMAT: "character format",
    Setting.ADDRESSING: "first address",
}
SINCE = {
    "": "from when it holds is not stated",
    "at_once": "at once, so that the answer to the write is lost",
    "after_answer": "after the answer to the write",
    "apply": "when it is applied",
    "restart": "when the device is powered up next",
}
STAYS = {
    "address": "the address of the device",
    "line": "belongs to the line of the device",
    "calibration": "calibrates the device",
    "identity": "identifies the device",
    "counter": "what the device counted or measured",
    "operation": "what the device does at the moment, no setting",
    "momentary": "falls back by itself",
}
POLLS = {
    "fast": "as fast as the line allows",
    "normal": "every second",
    "slow": "every ten seconds",
    "once": "not: reading it once will do",
    "never": "not, unless it is asked for by name",
}
MANDATORY = {None: "", True: "yes", False: "no, on some only"}
DIFFERENCE = "a difference: its unit is converted without the zero point"
PERSISTENCE = {"ram": "RAM", "eeprom": "EEPROM", "both": "RAM and EEPROM"}


def facts(context: PageContext, leaf: Leaf) -> PageTable:
    """Return the facts of a register that are known, each once or by model."""
    headers = ("Property", "Value")
    return fact_table(headers, leaf.register, lambda model, register: _facts(context, leaf, model, register))


def _facts(context: PageContext, leaf: Leaf, model: Model, register: Register) -> Iterator[tuple[str, Md]]:
    yield "Wire address", _address(context, leaf, register)
    yield "Exists", md() if register.when.always else md("while ", context.condition(register.when, model))
    yield from _value_facts(context, model, register)
    yield "Kept in", _persistence(register)
    shadowed = md("takes the value of ", context.register(register.shadows)) if register.shadows else Md()
    yield "When power comes", shadowed
    yield "Reads again", md("the words of ", context.register(register.rereads)) if register.rereads else Md()
    yield "Follows", follows(context, model, register)
    unit = link(register.rescales, context.anchor("unit", register.rescales)) if register.rescales else Md()
    yield "Changing it", md("the device converts every value whose unit is ", unit) if unit else unit
    yield "Before a write", md("run ", context.command(register.unlock), " first") if register.unlock else Md()
    yield "After a write", md("takes effect with ", context.command(register.apply)) if register.apply else Md()
    yield "Governs", _governs(register)
    yield "Read back", md(f"{register.settle} ms after the write at the earliest" if register.settle else "")
    yield "Not for another device", md(STAYS.get(register.stays, ""))
    yield from _reading(register)


def _reading(register: Register) -> Iterator[tuple[str, Md]]:
    """Yield what to know of a register before one reads it, and how often."""
    clears, poll, good_for = register.reading
    yield "Reading", md("clears it; a driver reads it only where it is asked for by name" if clears else "")
    yield "Changes", md("never by itself" if register.static else "")
    seconds = "" if isinstance(poll, str) else f"every {show(poll)} s"
    yield "To be followed", md(POLLS.get(str(poll), seconds) if poll else "")
    yield "A value holds", md(f"{show(good_for)} s" if good_for else "")
    yield "On each device", md(MANDATORY[register.mandatory])


def _value_facts(context: PageContext, model: Model, register: Register) -> Iterator[tuple[str, Md]]:
    """Yield transmission, range and form of the value; facts by condition have a table of their own."""
    wording, limits = context.wording(model), register.range
    single = len(register.views) == 1
    sent = (md(view_type(register.base)), transmission(context, register.base)) if single else ()
    yield "Transmitted as", join("; ", sent)
    yield "Access", _access(context, model, register)
    yield "Value", _kind(register)
    plain = len(limits) == 1 and limits[0].when.always
    yield "Range", Md(range_words(limits[0].then, wording) if plain else "")
    valid = cases_words(map_cases(register.valid, lambda limits: range_words(limits, wording)), wording)
    yield "Valid readings", Md(f"{valid}; anything else is a fault" if valid else "")
    yield "Special values", specials(register, wording)
    faults = [Md(sentinel_words(sentinel, wording)) for sentinel in register.sentinels]
    yield "Faults instead of a value", lines(*faults)
    yield "Default", Md(default_words(register, register.default, register.default_cases, wording))
    yield "As delivered", Md(default_words(register, register.delivered, register.delivered_cases, wording))
    yield "Unit", _unit(context, register, wording)
    yield "Scale", scale(register)
    yield "Counts", md(DIFFERENCE if register.difference else "")


def scale(register: Register) -> Md:
    """Return how the value follows from the stored number, if there are no cases of it."""
    cases = register.scale
    scaled = len(cases) == 1 and cases[0].then != IDENTITY
    return md(code(conversion_words(cases[0].then)), ", x being the stored number") if scaled else Md()


def _address(context: PageContext, leaf: Leaf, register: Register) -> Md:
    """Return the address of the only view (several have a table of their own), with aliases."""
    base = register.base
    if leaf.arrays:
        first = md(code(formula(base, register.at, leaf.arrays)), ", ", indices(leaf.arrays))
        others = [code(formula(alias, register.at, leaf.arrays)) for alias in aliases(register)]
    else:
        first = context.address(base.space, register.address, register.block)
        others = [context.address(base.space, each.address(register.at), register.block) for each in aliases(register)]
    if register.block:
        first = md(first, " from the base of block ", code(register.block))
    return lines(first if len(register.views) == 1 else Md(), md("also at ", join(", ", others)) if others else Md())


def indices(arrays: Sequence[Array]) -> Md:
    """Return the letters of the indices with their ranges: `i = 1 to 8`."""
    parts = (
        f"{letter} = {array.first} to {array.first + array.count - 1}"
        for letter, array in zip(LETTERS, arrays, strict=False)
    )
    return escape(", ".join(parts))


def transmission(context: PageContext, view: View) -> Md:
    """Return the transmission of a view: factor, rounding, saturation, orders, functions, alignment."""
    order, factor = view.order, Fraction(view.factor, 1 << view.type.fraction)
    words = Md()  # for the usual order, and for a single word in a fixed order
    wording = context.wording(context.map.models[0])
    if order is not Order.BIG and (view.words > 1 or not isinstance(order, Order)):
        words = md("word order: ", Md(order_words(order, wording)))
    parts = (
        f"stored value times {show(factor)}" if factor != 1 else "",
        f"stored value times {term_words(view.times)}" if view.times is not None else "",
        ROUNDING[view.rounding],
        f"stops at {view.type.minimum} and {view.type.maximum}" if view.saturates else "",
        words,
        _low_first(view) if view.byte_order is Order.LITTLE else "",
        md("byte order: ", Md(order_words(view.byte_order, wording)))
        if isinstance(view.byte_order, OrderCases)
        else "",
        view.type.note if view.space.is_words else "",
        f"functions {', '.join(map(str, view.functions))} only" if view.functions else "",
        f"address and count multiples of {view.align}" if view.align > 1 else "",
        _portions(context, view),
    )
    return join("; ", map(md, parts))


def _portions(context: PageContext, view: View) -> str:
    most = context.map.protocol.most_read(view.space)
    return f"in requests of up to {most} words, not of one moment" if view.words > most else ""


def _low_first(view: View) -> str:
    return "the high byte of the word" if view.is_byte else "least significant byte first"


def view_type(view: View) -> str:
    """Return the type of a view, with its words where they are several."""
    if view.is_apart:
        offsets = ", ".join(f"+{offset}" for offset in view.offsets)
        return f"{view.type.value}, {len(view.offsets)} words at {offsets}"
    return f"{view.type.value}, {view.words} words" if view.words > 1 else view.type.value


def _access(context: PageContext, model: Model, register: Register) -> Md:
    words = md(ACCESS[register.access])
    if register.writable is None:
        return words
    when = context.condition(register.writable.when, model)
    reason = md(" (", prose(register.writable.reason), ")") if register.writable.reason else Md()
    return md(words, "; writable when ", when, reason)


def _kind(register: Register) -> Md:
    if register.kind in OCTETS:
        return md(octets_words(register))
    if register.kind is Kind.VERSION and register.version_group:
        groups = register.version_digits // register.version_group
        return md("version, packed decimal digits: ", ".".join(["n" * register.version_group] * groups))
    other = f"; any other is {one_line(register.enum.other)}" if register.enum and register.enum.other else ""
    return md(KINDS[register.kind], other)


def specials(register: Register, wording: Wording) -> Md:
    """Return the special values, one a line."""
    divided = any(case.then.decimals for case in register.special_scale)
    remark = md("these codes are divided as the limits of the range are" if divided else "")
    return lines(*(Md(special_words(special, wording)) for special in register.specials), remark)


def _unit(context: PageContext, register: Register, wording: Wording) -> Md:
    anchor = context.anchor("unit", register.unit_id) if len(register.unit) > 1 else ""
    if anchor:
        return md(symbols(register), " (", link(register.unit_id, anchor), ")")
    return Md(cases_words(map_cases(register.unit, escape), wording))


def symbols(register: Register) -> str:
    """Return the units that a register may have: `°F / °C / K`."""
    return " / ".join(dict.fromkeys(one_line(case.then) for case in register.unit if case.then))


def _persistence(register: Register) -> Md:
    where = PERSISTENCE.get(register.persistence, one_line(register.persistence))
    writes = f"good for {register.endurance:,} writes" if register.endurance is not None else ""
    return join("; ", (md(where), md(writes)))


def _governs(register: Register) -> Md:
    found = register.governs
    if found is None:
        return Md()
    codes = ", ".join(f"{code} = {value}" for code, value in found.codes)
    if not codes and found.setting is not Setting.ADDRESS:
        codes = "the codes are not in this manual"
    return join("; ", (md(SETTINGS[found.setting], " of the line"), escape(codes), md(SINCE[found.since])))
