"""The words of a constant value, for the steps of commands."""

import struct
from fractions import Fraction

from regscribe.lower.node import Node
from regscribe.lower.rules import NOT_CONSTANT, UNKNOWN_MEMBER
from regscribe.lower.values import named_value
from regscribe.model import Order, Register, Rounding, View, WireType, show

_WORD = 16
_FLOATS = {WireType.FLOAT32: ">f", WireType.FLOAT64: ">d"}
_INSTEAD = "give the `words` that the manual prints"


def words_of_value(node: Node, register: Register, view: View) -> tuple[int, ...]:
    """The words that transmit the value in a view; RS0326 where they are not constant or cannot carry it."""
    value = named_value(node, register.kind, register.enum, register.specials, UNKNOWN_MEMBER)
    reason = _hindrance(register, view)
    if reason or isinstance(value, str):
        node.report(NOT_CONSTANT, reason or "a text has no constant words", remedy=_INSTEAD)
        return ()
    conversion = register.scale[0].then
    stored = (value - conversion.add) / conversion.multiply
    bits = _bits(stored * view.factor, view)
    if bits is None:
        message = f"{show(value)} cannot be sent as {view.type} of `{register.path}`"
        node.report(NOT_CONSTANT, message, remedy=f"choose another value or view, or {_INSTEAD}")
        return ()
    words = tuple(bits >> _WORD * place & 0xFFFF for place in reversed(range(view.words)))
    return words if view.word_order is Order.BIG else words[::-1]


def _hindrance(register: Register, view: View) -> str:
    """Why the words of a value are not constant; empty where they are."""
    if len(register.scale) > 1 or not register.scale[0].when.always or register.scale[0].then.decimals:
        return f"the scale of `{register.path}` depends on other registers"
    if register.scale[0].then.multiply == 0:
        return f"the scale of `{register.path}` is zero"
    if not isinstance(view.word_order, Order) and view.words > 1:
        return f"the word order of `{register.path}` depends on the register `{view.word_order.register}`"
    return "a text has no constant words" if view.type is WireType.STRING else ""


def _bits(number: Fraction, view: View) -> int | None:
    if view.type in _FLOATS:
        try:
            return int.from_bytes(struct.pack(_FLOATS[view.type], float(number)), "big")
        except OverflowError:
            return None
    rounded = _rounded(number, view.rounding)
    if rounded is None or not view.type.minimum <= rounded <= view.type.maximum:
        return None
    return rounded & ((1 << view.type.bits) - 1)


def _rounded(number: Fraction, rounding: Rounding) -> int | None:
    half = Fraction(1, 2)
    whole = number.numerator // number.denominator
    if number.denominator == 1:
        return whole
    if rounding is Rounding.NONE:
        return None
    if rounding is Rounding.HALF_EVEN:
        return round(number)
    if rounding is Rounding.HALF_UP or (rounding is Rounding.HALF_AWAY and number > 0):
        return (number + half).__floor__()
    return -((-number + half).__floor__()) if rounding is Rounding.HALF_AWAY else int(number)
