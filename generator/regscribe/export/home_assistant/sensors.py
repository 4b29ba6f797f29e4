"""A number or a text as a sensor of Home Assistant.

A value is scale x raw + offset in floats of 64 bits, shown with `precision` decimals, of which integers have none where
they are not stated; so they are always stated.
"""

from collections.abc import Mapping

from regscribe.dialects.home_assistant import SPACES, SWAPS, TYPES
from regscribe.emit.words import one_line
from regscribe.export.device import Device, Point
from regscribe.export.device.numbers import EXACT_DOUBLE, decimal, is_exact
from regscribe.export.device.points import Fault
from regscribe.export.home_assistant.entities import Entity, lose_faults, placed
from regscribe.export.home_assistant.units import classes
from regscribe.files import Plain
from regscribe.losses import Grade
from regscribe.model import Order, WireType

TEXT_CODECS = frozenset({"ascii", "utf-8"})

BYTES: Mapping[WireType, str] = {WireType.UINT8: "B", WireType.INT8: "b"}
"""The letter of a `structure` for one byte of a word."""

DECIMALS = 6
"""Shown of a number that may have any."""


def sensor(device: Device, point: Point) -> Entity:
    """The sensor of a register, with its losses told."""
    place = placed(device, point) | {"input_type": SPACES[point.wire.space]}
    if point.register.access.writable:
        done = "read only: Home Assistant's modbus integration has no numbers, selects and texts to write"
        device.lose(point.register, "write", Grade.LOST, done)
    if point.is_truth:
        device.lose(
            point.register, "boolean", Grade.LOST, "shown as the number 0 or 1: only the lowest bit of a word can be on"
        )
    if point.wire.type is WireType.STRING:
        return place | {"data_type": TYPES[WireType.STRING], "count": point.words} | _swap(point)
    device.lose_version(point)
    return place | _type(point) | _scale(device, point) | _nan(device, point) | _unit(point)


def _type(point: Point) -> Entity:
    if letter := BYTES.get(point.wire.type):
        structure = f">x{letter}" if point.wire.bytes is Order.BIG else f">{letter}x"
        return {"data_type": "custom", "count": 1, "structure": structure}
    return {"data_type": TYPES[point.wire.type]} | _swap(point)


def _swap(point: Point) -> Entity:
    swap = SWAPS[point.wire.words, point.wire.bytes]  # type: ignore[index]  # what fits is there
    return {"swap": swap} if swap else {}


def _scale(device: Device, point: Point) -> Entity:
    register, places = point.register, point.decimals
    if places is None:
        done = f"shown with {DECIMALS} decimals: what is smaller reads as 0"
        device.lose(register, "decimals-cut", Grade.LOST, done)
    if not (is_exact(point.slope) and is_exact(point.offset)):
        device.lose(register, "scale-rounded", Grade.COSMETIC, "its scale is rounded to a decimal of 17 digits")
    if point.wire.type.is_integer and max(map(abs, point.wire.type.ends)) > EXACT_DOUBLE:
        done = "numbers beyond 2^53 on the wire lose their last digits"
        device.lose(register, "precision-float64", Grade.WRONG, done)
    scale = {"scale": Plain(decimal(point.slope))} if point.slope != 1 else {}
    offset = {"offset": Plain(decimal(point.offset))} if point.offset else {}
    return {**scale, **offset, "precision": DECIMALS if places is None else places}


def _nan(device: Device, point: Point) -> Entity:
    """The one fault word that becomes `unknown`; what is no number does so by itself."""
    faults = [one for one in point.faults if one.low is not None]
    chosen = next((one for one in faults if _is_honest(one, point)), None)
    if chosen is None or chosen.low is None:
        lose_faults(device, point, "sentinel", "its negative, or numbers beside it, would be lost as well")
        return {}
    number = int(chosen.low)
    lose_faults(device, point, "several-sentinels", "nan_value takes one alone", number)
    done = f"shown as unknown without its label: {number} = {one_line(chosen.label)}"
    device.lose(point.register, "sentinel-label", Grade.LOST, done)
    return {"nan_value": number}


def _is_honest(fault: Fault, point: Point) -> bool:
    """Whether `nan_value` hits this fault and nothing that is a value: it hits the negative number too."""
    if fault.low is None or fault.low != fault.high or fault.low.denominator != 1:
        return False
    other, (least, most) = -fault.low, point.wire.type.ends
    if other == fault.low or not (point.wire.type.is_float or least <= other <= most):
        return True
    ends = [(one.low, one.high) for one in point.faults if one.low is not None and one.high is not None]
    return any(low <= other <= high for low, high in ends)


def _unit(point: Point) -> Entity:
    return {"unit_of_measurement": point.unit, **classes(point)} if point.unit else {}
