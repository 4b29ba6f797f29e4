"""The words of a constant value, for the steps of commands."""

from dataclasses import replace

from regscribe.lower.node import Value
from regscribe.lower.rules import NOT_CONSTANT, UNKNOWN_MEMBER
from regscribe.lower.special_values import named_value
from regscribe.model import Register, Rounding, View
from regscribe.reference import RefusedError, UnknownValueError, encode

_INSTEAD = "choose another value or view, or give the `words` that the manual prints"


def words_of_value(node: Value, register: Register, view: View) -> tuple[int, ...]:
    """The words that transmit the value in a view; RS0326 where they are not constant or cannot carry it."""
    value = named_value(node, register.kind, register.enum, register.specials, UNKNOWN_MEMBER)
    if any(case.then.multiply == 0 for case in register.scale):
        node.report(NOT_CONSTANT, f"the scale of `{register.path}` is zero", remedy=_INSTEAD)
        return ()
    # A range is none of the words: whether the device takes the value may depend on other registers.
    unlimited = replace(register, range=())
    try:
        return encode(unlimited, view, value, rounded=view.rounding is not Rounding.NONE)
    except UnknownValueError as unknown:
        message = f"what `{register.path}` sends for {node.text()} depends on other registers: {unknown}"
    except RefusedError as refused:
        message = f"{node.text()} cannot be sent as {view.type} of `{register.path}`: {refused}"
    node.report(NOT_CONSTANT, message, remedy=_INSTEAD)
    return ()
