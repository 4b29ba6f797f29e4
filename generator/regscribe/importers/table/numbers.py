"""The number of a register: its type, the order of its words, its scale, its unit, its limits."""

from fractions import Fraction

from regscribe.draft.numbers import plain, unscaled
from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.doubts import against_type
from regscribe.importers.table.cells.orders import order_in
from regscribe.importers.table.cells.ranges import Limits, Settled, parse_number
from regscribe.importers.table.cells.scale_cells import scale_register
from regscribe.importers.table.cells.scale_words import scale_in, scale_in_name
from regscribe.importers.table.cells.scales import PLAIN, Scale, parse_offset
from regscribe.importers.table.cells.types import TypeCell, parse_order
from regscribe.importers.table.cells.units import UnitCell, may_scale, parse_unit
from regscribe.importers.table.choices import Choices
from regscribe.importers.table.making import LeftOutError, Making
from regscribe.importers.table.whole import Whole
from regscribe.model import WireType
from regscribe_runtime.values.octets import KINDS
from regscribe_runtime.values.wire_types import Order

UNCLEAR_TYPE = "type-unclear"

MOMENTS = frozenset({WireType.DATETIME, WireType.DATE, WireType.TIME})
ONE_OF_WORDS = frozenset({WireType.UINT8, WireType.INT8})


def add_type(making: Making, whole: Whole, index: int, choices: Choices, *, coded: bool) -> None:
    """Set type, length and orders; `coded`: the word holds codes or bits, whose sign does not matter.

    Raises LeftOutError where the type is not known.
    """
    if making.space.is_bits:
        _type_of_bit(making, whole.types[index])
        return
    found = whole.types[index]
    if isinstance(found, Unclear):
        raise LeftOutError(UNCLEAR_TYPE, found.message)
    making.type = found = found or TypeCell()
    if found.type is WireType.BIT:  # a word that is 0 or 1
        making.type = found = TypeCell(type=WireType.UINT16, words=1, kind="boolean")
    if found.type is None:
        _default_type(making, found, choices, coded=coded)
    if not coded and (doubt := against_type(making.item["description"], making.wire)):
        raise LeftOutError(UNCLEAR_TYPE, doubt.message)
    _check_type(making)
    _add_orders(making, whole, choices)


def _type_of_bit(making: Making, found: TypeCell | Unclear | None) -> None:
    """Say of a bit what its type is, which is lost where it is that of a word."""
    text = making.item["type"]
    if isinstance(found, Unclear) or (found is not None and found.type not in {None, WireType.BIT}):
        making.lose("type-of-bit", f"type `{text[:40]}` is not taken over: a {making.space} is one bit")
    elif text and not any(word in text.lower() for word in ("bit", "bool", "coil", "discrete", "switch", "bin")):
        making.tell("type-of-bit", f"type `{text[:40]}`: a {making.space} is one bit")


def _default_type(making: Making, found: TypeCell, choices: Choices, *, coded: bool) -> None:
    if choices.type is not None:
        making.type = TypeCell(
            type=choices.type, words=choices.type.words, word_order=found.word_order, byte_order=found.byte_order
        )
    elif not (coded and found.words <= 1):
        said = f"`{making.item['type'][:40]}` does not say it" if making.item["type"] else "no cell says it"
        message = f"the type is not known: {said}; --type gives one to such rows"
        msg = "type-missing"
        raise LeftOutError(msg, message)


def _check_type(making: Making) -> None:
    wire = making.wire
    if making.type.stated:
        making.tell("type-read", making.type.stated)
    if wire in MOMENTS and making.type.layout:
        making.set({"layout": making.type.layout})
    elif wire in MOMENTS:
        message = f"type `{making.item['type'][:40]}`: how its words tell a {wire} is not stated (key `layout`)"
        msg = "layout-missing"
        raise LeftOutError(msg, message)
    if wire is not WireType.UINT16:
        making.set({"type": str(wire)})
    if wire in KINDS:
        if not making.type.words:
            message = f"type `{making.item['type'][:40]}`: how many registers it takes is not known"
            msg = "length-missing"
            raise LeftOutError(msg, message)
        if wire in {WireType.STRING, WireType.BYTES} or making.type.words != wire.words:
            making.set({"length": making.type.words})
    if making.type.encoding:
        making.set({"text": making.type.encoding})


def _add_orders(making: Making, whole: Whole, choices: Choices) -> None:
    """Orders by the type, else by a column of their own, else as the user says; the rest is stated for the table."""
    words, octets = making.type.word_order, making.type.byte_order
    item, little = making.item, whole.dialect.little_bytes
    said = parse_order(item["word_order"], little_bytes=little)
    if said is None and words is None and making.words > 1:
        said = order_in(item["description"], little_bytes=little)
    if isinstance(said, Unclear):
        if making.words > 1:
            msg = "order-unclear"
            raise LeftOutError(msg, said.message)
        making.ask("order-unclear", said)
        said = None
    if said is not None:
        if (words and said[0] and words is not said[0]) or (octets and said[1] and octets is not said[1]):
            message = f"`{making.item['type'][:40]}` and `{making.item['word_order'][:40]}` say different orders"
            msg = "order-unclear"
            raise LeftOutError(msg, message)
        words, octets = words or said[0], octets or said[1]
    if making.words < 2:  # noqa: PLR2004 - words have an order
        words = None
    elif words is None and making.wire not in KINDS:
        words = choices.word_order
        if words is None:
            making.order_assumed = True
    making.set({"word_order": str(words)} if words is Order.LITTLE else {})
    making.set({"byte_order": str(octets)} if octets is Order.LITTLE else {})


def add_scale(making: Making, whole: Whole, index: int) -> None:
    """Set the scale that the row says; where it is unclear, programs get the raw number."""
    exponent = whole.exponents.get(scale_register(making.item["scale"]).casefold())
    if exponent and not making.item["offset"] and not making.item["decimals"]:
        making.scale = None  # it is not known here, so ranges cannot be read
        making.set({"exponent": exponent})
        making.tell("scale-register", f"its scale is ten to the power of `{exponent}`")
        return
    found = _scale(making, whole, index)
    if isinstance(found, Unclear):
        making.scale = None
        making.keys = unscaled(making.keys)
        making.ask("scale-unclear", f"the scale is unclear, so the number is raw: {found.message}")
        return
    making.scale = found
    making.set(found.keys)


def _scale(making: Making, whole: Whole, index: int) -> Scale | Unclear:
    """The one scale of what the cells of a row say; Unclear where two of them differ."""
    item = making.item
    said = _scales(making, whole, index)
    if unclear := next((one for one in said if isinstance(one, Unclear)), None):
        return unclear
    known = [one for one in said if isinstance(one, Scale)]
    if len({(one.multiply, one.add) for one in known}) > 1:
        texts = ", ".join(f"`{item[role][:30]}`" for role in ("scale", "decimals", "unit", "name") if item[role])
        return Unclear(f"{texts} say different scales")
    scale = known[0] if known else PLAIN
    offset = parse_offset(item["offset"], comma=whole.comma)
    if isinstance(offset, Unclear):
        return offset
    if offset and scale.add and scale.add != offset:
        return Unclear(f"offset `{item['offset'][:30]}` and scale `{item['scale'][:30]}` differ")
    return Scale(scale.multiply, scale.add or offset or Fraction(0), scale.unit)


def _scales(making: Making, whole: Whole, index: int) -> list[Scale | Unclear]:
    """What columns of scales, decimals and units and the name say; if none does, what the description says."""
    text = making.item["unit"]
    unit = parse_unit(text)
    in_unit = Scale(unit.factor) if isinstance(unit, UnitCell) and unit.factor is not None else None
    said = [whole.scales.cells[index], whole.decimals.cells[index], in_unit]
    if isinstance(unit, Unclear) and may_scale(text):
        said.append(unit)
    told = None if making.wire.is_float else scale_in_name(making.item["name"])
    if all(one is None for one in said) and not making.wire.is_float:
        said += [scale_in(making.item["description"]), told]
    elif isinstance(told, Scale):
        said.append(told)
    return [one for one in said if one is not None]


def add_unit(making: Making) -> None:
    """Set the unit, by its symbol in the language, or declare it."""
    text = making.item["unit"]
    found = parse_unit(text)
    if isinstance(found, Unclear):
        if not may_scale(text):  # the scale is unclear then, which is told
            making.ask("unit-unclear", found)
        return
    symbol = found.symbol if found is not None else ""
    beside = making.scale.unit if making.scale is not None else ""
    if symbol and beside and symbol != beside:
        making.ask("unit-unclear", f"unit `{text[:30]}`, but the scale says `{beside[:30]}`")
        return
    if not (symbol or beside):
        return
    making.set({"unit": symbol or beside})
    if found is not None and not found.known and symbol:
        making.declared[symbol] = {"description": f"as the source has it: {' '.join(text.split())[:60]}"}


def add_limits(making: Making, settled: Settled | Unclear | None) -> Limits | None:
    """Set the range and return it, in the unit of the value."""
    if settled is None:
        return None
    if isinstance(settled, Unclear):
        making.ask("range-unclear", settled)
        return None
    text = _range_text(settled.limits)
    if not text:
        item = making.item
        printed = item["range"] or "..".join(filter(None, (item["min"], item["max"])))
        making.lose("range-open", f"a limit alone is no range: `{printed[:60]}`")
        return settled.limits
    making.set({"range": text})
    if settled.stated:
        making.tell("range-read", settled.stated)
    return settled.limits


def _range_text(limits: Limits) -> str:
    if limits.low is None or limits.high is None:
        return ""
    text = f"{plain(limits.low)}..{plain(limits.high)}"
    return "" if "/" in text else text


NOTHING = frozenset({"", "-", "--", "n/a", "na", "none", "?"})


def printed_default(making: Making, whole: Whole, index: int) -> Fraction | Unclear | None:
    """The default as printed; of a text or of codes it is set at once."""
    item, text = making.item, making.item["default"]
    unstated = whole.limits[index] is None and item["min"] == item["max"] == text  # three times 0
    if text.casefold() in NOTHING or unstated:
        return None
    if making.wire is WireType.STRING:
        making.set({"default": text})
        return None
    number = parse_number(text, comma=whole.comma)
    if isinstance(making.keys.get("enum"), dict):
        _default_code(making, text, number)
        return None
    if isinstance(number, Unclear):
        making.ask("default-unclear", f"default {number.message}")
        return None
    return number


def add_default(making: Making, settled: Settled | Unclear | None) -> Fraction | None:
    """Set the default and return it, in the unit of the value."""
    if isinstance(settled, Unclear):
        making.ask("default-unclear", f"default `{making.item['default'][:60]}`: {settled.message}")
        return None
    low = settled.limits.low if settled is not None else None
    if low is not None:
        making.set({"default": plain(low)})
    return low


def _default_code(making: Making, text: str, number: Fraction | Unclear | None) -> None:
    labels = making.keys["enum"]
    if isinstance(number, Fraction) and number.denominator == 1 and number.numerator in labels:
        making.set({"default": number.numerator})
        return
    codes = [code for code, label in labels.items() if _label(label).casefold() == text.casefold()]
    if len(codes) == 1:
        making.set({"default": codes[0]})
        return
    making.ask("default-unclear", f"default `{text[:60]}` is none of its codes")


def _label(label: object) -> str:
    return str(label["label"]) if isinstance(label, dict) else str(label)
