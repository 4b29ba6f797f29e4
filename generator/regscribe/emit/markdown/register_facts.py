"""The facts of one register that fit on a line each, as a table of two columns."""

from collections.abc import Callable, Sequence
from functools import partial

from regscribe.emit.markdown.context import PageContext, by_model
from regscribe.emit.markdown.escape import Md, code, escape, join, lines, link, md, prose
from regscribe.emit.markdown.page_values import PageTable, table
from regscribe.emit.markdown.process import follows
from regscribe.emit.outline import Leaf, aliases, formula
from regscribe.emit.words import (
    ACCESS,
    LETTERS,
    ROUNDING,
    cases_words,
    conversion_words,
    map_cases,
    one_line,
    order_words,
    range_words,
    sentinel_words,
    special_words,
    value_words,
)
from regscribe.model import IDENTITY, Array, Kind, Model, Order, Register, Setting, View, show

KINDS = {
    Kind.NUMBER: "number",
    Kind.INTEGER: "whole number",
    Kind.RAW: "raw whole number; the manual does not state its scale",
    Kind.ENUM: "one of a list of codes",
    Kind.FLAGS: "bits, see below",
    Kind.FIELDS: "bit fields, see below",
    Kind.STRING: "text",
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
}
DIFFERENCE = "a difference: its unit is converted without the zero point"
PERSISTENCE = {"ram": "RAM", "eeprom": "EEPROM", "both": "RAM and EEPROM"}

Fact = Callable[[PageContext, Model, Register], Md]


def facts(context: PageContext, leaf: Leaf) -> PageTable:
    """Return the facts of a register that are known, each once or by model."""
    rows = [("Wire address", by_model(leaf.register, lambda _, register: address(context, leaf, register)))]
    rows += [(label, by_model(leaf.register, partial(fact, context))) for label, fact in FACTS.items()]
    return table(("Property", "Value"), [row for row in rows if row[1]])


def address(context: PageContext, leaf: Leaf, register: Register) -> Md:
    """Return where the only view stands (several have a table of their own), with aliases."""
    space, at = register.base.space, register.at
    if len(register.views) > 1:
        first = Md()
    elif leaf.arrays:
        first = md(code(formula(register.base, at, leaf.arrays)), ", ", indices(leaf.arrays))
    else:
        first = context.address(space, register.address)
    others = (
        code(formula(alias, register.at, leaf.arrays))
        if leaf.arrays
        else context.address(space, alias.address(register.at))
        for alias in aliases(register)
    )
    also = join(", ", others)
    return lines(first, md("also at ", also) if also else Md())


def indices(arrays: Sequence[Array]) -> Md:
    """Return the letters of the indices with their ranges: `i = 1 to 8`."""
    parts = (
        f"{letter} = {array.first} to {array.first + array.count - 1}"
        for letter, array in zip(LETTERS, arrays, strict=False)
    )
    return escape(", ".join(parts))


def transmission(context: PageContext, view: View) -> Md:
    """Return what a view does to the stored value: factor, rounding, saturation, order, functions, alignment."""
    parts = (
        f"stored value times {show(view.factor)}" if view.factor != 1 else "",
        ROUNDING[view.rounding],
        f"stops at {view.type.minimum} and {view.type.maximum}" if view.saturates else "",
        _word_order(context, view),
        "least significant byte first" if view.byte_order is Order.LITTLE else "",
        "read as the shortest decimal of its bits" if view.type.is_float else "",
        f"functions {', '.join(map(str, view.functions))} only" if view.functions else "",
        f"address and count multiples of {view.align}" if view.align > 1 else "",
    )
    return join("; ", map(md, parts))


def _word_order(context: PageContext, view: View) -> Md:
    """Return the order of the words; nothing for the usual one, and for a single word in a fixed order."""
    order = view.order
    if order is Order.BIG or (isinstance(order, Order) and view.words == 1):
        return Md()
    return md("word order: ", Md(order_words(order, context.wording(context.map.models[0]))))


def view_type(view: View) -> str:
    """Return the type of a view, with its words where they are several."""
    return f"{view.type.value}, {view.words} words" if view.words > 1 else view.type.value


def _transmitted(context: PageContext, _model: Model, register: Register) -> Md:
    return (
        Md()
        if len(register.views) > 1
        else join("; ", (md(view_type(register.base)), transmission(context, register.base)))
    )


def _access(context: PageContext, model: Model, register: Register) -> Md:
    words = md(ACCESS[register.access])
    if register.writable is None:
        return words
    when = context.condition(register.writable.when, model)
    reason = md(" (", prose(register.writable.reason), ")") if register.writable.reason else Md()
    return md(words, "; writable when ", when, reason)


def _kind(_context: PageContext, _model: Model, register: Register) -> Md:
    if register.kind is Kind.STRING:
        return md(f"text of {2 * register.base.words} characters")
    if register.kind is Kind.VERSION and register.version_group:
        groups = register.version_digits // register.version_group
        return md("version, packed decimal digits: ", ".".join(["n" * register.version_group] * groups))
    return md(KINDS[register.kind])


def _range(context: PageContext, model: Model, register: Register) -> Md:
    if len(register.range) != 1 or not register.range[0].when.always:
        return Md()
    return Md(range_words(register.range[0].then, context.wording(model)))


def _scale(_context: PageContext, _model: Model, register: Register) -> Md:
    if len(register.scale) != 1 or register.scale[0].then == IDENTITY:
        return Md()
    return md(code(conversion_words(register.scale[0].then)), ", x being the stored number")


def _specials(context: PageContext, model: Model, register: Register) -> Md:
    wording = context.wording(model)
    divided = any(case.then.decimals for case in register.special_scale)
    told = [md("these codes are divided as the limits of the range are")] if divided else []
    return lines(*(Md(special_words(special, wording)) for special in register.specials), *told)


def _unit(context: PageContext, model: Model, register: Register) -> Md:
    anchor = context.anchor("unit", register.unit_id) if len(register.unit) > 1 else ""
    if anchor:
        return md(symbols(register), " (", link(register.unit_id, anchor), ")")
    return Md(cases_words(map_cases(register.unit, escape), context.wording(model)))


def symbols(register: Register) -> str:
    """Return the units that a register may have: `°F / °C / K`."""
    return " / ".join(dict.fromkeys(one_line(case.then) for case in register.unit if case.then))


def _persistence(_context: PageContext, _model: Model, register: Register) -> Md:
    where = PERSISTENCE.get(register.persistence, one_line(register.persistence))
    writes = f"good for {register.endurance:,} writes" if register.endurance is not None else ""
    return join("; ", (md(where), md(writes)))


def _rescales(context: PageContext, _model: Model, register: Register) -> Md:
    if not register.rescales:
        return Md()
    return md(
        "the device converts every value whose unit is ",
        link(register.rescales, context.anchor("unit", register.rescales)),
    )


def _governs(_context: PageContext, _model: Model, register: Register) -> Md:
    found = register.governs
    if found is None:
        return Md()
    codes = ", ".join(f"{code} = {value}" for code, value in found.codes)
    if not codes and found.setting is not Setting.ADDRESS:
        codes = "the codes are not in this manual"
    return join("; ", (md(SETTINGS[found.setting], " of the line"), escape(codes), md(SINCE[found.since])))


FACTS: dict[str, Fact] = {
    "Transmitted as": _transmitted,
    "Access": _access,
    "Value": _kind,
    "Range": _range,
    "Special values": _specials,
    "Faults instead of a value": lambda context, model, one: lines(
        *(Md(sentinel_words(sentinel, context.wording(model))) for sentinel in one.sentinels)
    ),
    "Default": lambda context, model, one: Md(value_words(one, one.default, context.wording(model))),
    "As delivered": lambda context, model, one: Md(value_words(one, one.delivered, context.wording(model))),
    "Unit": _unit,
    "Scale": _scale,
    "Counts": lambda _, __, one: md(DIFFERENCE if one.difference else ""),
    "Kept in": _persistence,
    "When power comes": lambda context, _, one: (
        md("takes the value of ", context.register(one.shadows)) if one.shadows else Md()
    ),
    "Follows": follows,
    "Changing it": _rescales,
    "Before a write": lambda context, _, one: md("run ", context.command(one.unlock), " first") if one.unlock else Md(),
    "After a write": lambda context, _, one: (
        md("takes effect with ", context.command(one.apply)) if one.apply else Md()
    ),
    "Governs": _governs,
    "Read back": lambda _, __, one: md(f"{one.settle} ms after the write at the earliest") if one.settle else Md(),
    "Not for another device": lambda _, __, one: md(STAYS.get(one.stays, "")),
}
"""The properties in the order of the table; one that is empty for every model is left out."""
