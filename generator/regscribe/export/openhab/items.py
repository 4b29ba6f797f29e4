"""The file of items: a number with its unit, or a switch, for each data thing, and how it is shown."""

import re
from collections.abc import Iterator, Sequence

from regscribe.emit.words import one_line
from regscribe.export.device import Device, Point
from regscribe.export.device.names import Names
from regscribe.export.device.numbers import decimal, is_exact
from regscribe.export.device.places import step_of
from regscribe.export.openhab.things import Link
from regscribe.export.openhab.units import DIMENSIONS
from regscribe.export.openhab.values import before_gain
from regscribe.losses import Grade
from regscribe.model import Kind, show
from regscribe.visible import json_text

SEPARATORS = str.maketrans({",": ";", "=": ":"})
"""What stands between options, and what labels have in their place."""

BRACKETS = str.maketrans({"[": "(", "]": ")"})
"""In a label brackets are the form of the value."""

NUMBERS = frozenset({Kind.NUMBER, Kind.INTEGER, Kind.RAW})


def items_of(device: Device, links: Sequence[Link]) -> Iterator[str]:
    """Return the lines of the file of items."""
    yield from (f"// {line}" for line in device.heading)
    yield ""
    names = Names()
    prefix = re.sub(r"[^A-Za-z0-9_]", "_", device.name)
    for link in links:
        yield _item(device, link, names.give(f"{prefix}_{link.id}"))


def _item(device: Device, link: Link, called: str) -> str:
    point = link.point
    label = json_text((link.datum.label or point.register.name).translate(BRACKETS))
    if link.datum.channel == "switch":
        if point.register.kind is Kind.BOOLEAN and point.wire.space.is_words:
            device.lose(point.register, "truth-of-words", Grade.LOST, "any number but 0 is ON")
        return f"Switch {called} {label} {{ {', '.join([_channel(link), _shown(link, {}), *_after(link)])} }}"
    if point.register.kind is Kind.VERSION:
        done = f"shown as the number that packs its {point.register.version_digits} digits"
        device.lose(point.register, "version", Grade.LOST, done)
    dimension = DIMENSIONS.get(point.unit, "") if point.register.kind in NUMBERS else ""
    kind = f"Number:{dimension}" if dimension else "Number"
    unit = [f"unit={json_text(point.unit)}"] if dimension else []
    parts = [_channel(link, _profile(device, point, dimension)), _shown(link, _state(device, link, dimension)), *unit]
    return f"{kind} {called} {label} {{ {', '.join([*parts, *_after(link)])} }}"


def _channel(link: Link, profile: str = "") -> str:
    return f"channel={json_text(link.channel)}{profile}"


def _after(link: Link) -> list[str]:
    """Without this a command would be shown as the value before the device has it."""
    return ['autoupdate="false"'] if link.writable else []


def _profile(device: Device, point: Point, dimension: str) -> str:
    """The offset is added before the gain; the gain gives the number its unit."""
    if not point.is_scaled and not dimension:
        return ""
    before = before_gain(point)
    if not is_exact(point.slope) or not is_exact(before):
        device.lose(point.register, "scale-rounded", Grade.COSMETIC, "its scale is rounded to a decimal of 17 digits")
    gain = f"{decimal(point.slope)} {point.unit}" if dimension else decimal(point.slope)
    return f' [ profile="modbus:gainOffset", gain={json_text(gain)}, pre-gain-offset="{decimal(before)}" ]'


def _shown(link: Link, state: dict[str, str]) -> str:
    told = [*(f"{key}={json_text(text)}" for key, text in state.items())]
    return f'stateDescription=" " [ {", ".join([*told, f"readOnly={str(not link.writable).lower()}"])} ]'


def _state(device: Device, link: Link, dimension: str) -> dict[str, str]:
    """How a number is shown, and what a user is offered to write."""
    point = link.point
    found = {"pattern": _pattern(point, dimension)} if point.unit or point.decimals is not None else {}
    if point.unit and not dimension:
        device.lose(point.register, "unit", Grade.LOST, f"shown behind the number: openHAB has no unit {point.unit}")
    if point.special_numbers:
        meant = ", ".join(f"{show(one.code)} is {one.label}" for one in point.special_numbers)
        device.lose(point.register, "special-value", Grade.LOST, one_line(f"a number like any other: {meant}"))
    if point.members:
        return found | {"options": _options(device, point)}
    if link.writable and point.register.kind in NUMBERS:
        found |= _limits(device, point)
    return found


def _pattern(point: Point, dimension: str) -> str:
    number = "%s" if point.decimals is None else f"%.{point.decimals}f"
    if dimension:
        return f"{number} %unit%"
    return f"{number} {point.unit.replace('%', '%%')}".rstrip()


def _options(device: Device, point: Point) -> str:
    """Codes with their labels, separated by commas."""
    labels: dict[int, list[str]] = {}
    for member in point.members:
        labels.setdefault(member.code, []).append(member.label)
    joined = {code: " / ".join(dict.fromkeys(several)) for code, several in labels.items()}
    if any(label != label.translate(SEPARATORS) for label in joined.values()):
        device.lose(point.register, "label-changed", Grade.COSMETIC, "; and : stand in labels for , and =")
    return ",".join(f"{code}={label.translate(SEPARATORS)}" for code, label in joined.items())


def _limits(device: Device, point: Point) -> dict[str, str]:
    """What a user is offered, special values included; the binding itself checks nothing."""
    found = {}
    if point.register.range:
        shown = "offered to users as min and max" if point.limits else "left out"
        done = f"{shown}: a rule may send any number, of which the lowest bits are written"
        device.lose(point.register, "range", Grade.LOST, done)
    if point.limits is not None:
        ends = [*point.limits, *(one.code for one in point.special_numbers)]
        found = {"min": decimal(min(ends)), "max": decimal(max(ends))}
    step = step_of(point, device.request.known)
    if step or not point.wire.type.is_float:
        found["step"] = decimal(abs(point.slope) * (step or 1))
        device.lose(point.register, "step", Grade.LOST, "a value between two steps is cut and not refused")
    return found
