"""What Home Assistant writes: switches, lights and fans, covers, climates; each as the registers that it uses."""

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import partial
from typing import Any

from regscribe.dialects.home_assistant import WRITES
from regscribe.draft import Remark
from regscribe.draft.labels import labelled
from regscribe.files import OneLine
from regscribe.importers.home_assistant.sensors import INPUTS, address_of, form_of, poll
from regscribe.importers.shared.document import Collecting
from regscribe.importers.shared.points import Point
from regscribe.importers.shared.reading import Keys, refuse
from regscribe.importers.shared.tree import Node
from regscribe.model import Space, WireType, show

UNITS = {"C": "°C", "F": "°F", "K": "K", "°C": "°C", "°F": "°F"}
LEVELS = {"brightness_address": "Brightness", "color_temp_address": "Colour temperature"}
TEMPERATURES = {"max_temp", "min_temp", "temp_step", "target_temp_write_registers", "temperature_unit"}
MODES = {
    "hvac_mode_register": "Mode",
    "hvac_onoff_register": "On off",
    "fan_mode_register": "Fan mode",
    "swing_mode_register": "Swing mode",
    "hvac_action_register": "Action",
}
"""Registers of a climate with codes, and what they are called here."""


def _on_off(point: Point, on: int, off: int) -> Point:
    """A coil as it is; a register with both codes."""
    if point.space.is_bits:
        return replace(point, type=WireType.BIT)
    return replace(point, more={**point.more, "enum": labelled(dict(sorted({off: "off", on: "on"}.items())))})


def switches(found: Collecting, entity: Node, name: str, group: str) -> None:
    """Add the register of a switch, light or fan: written only, unless `verify` says where its state is read."""

    def make(keys: Keys) -> Point:
        space = keys.choice("write_type", WRITES, "holding")
        on, off = keys.whole("command_on"), keys.whole("command_off")
        codes = 1 if on is None else on, 0 if off is None else off
        point = Point(name=name, place=found.place(entity), at=address_of(keys), space=space, access="w", group=group)
        verify = keys.take("verify")
        point = point if verify is None else _verified(keys, Keys(verify), point, codes)
        if codes[0] == codes[1]:
            refuse("command_on", f"command_on and command_off are both {codes[0]}")
        if space.is_bits and not codes[0]:
            keys.remarks.append(Remark("command-on-dropped", "command_on 0: the coil is off while this is on"))
        return _on_off(replace(point, more={**point.more, **poll(keys)}), *codes)

    found.add(name, entity, make)
    for key, called in LEVELS.items():
        if entity.get(key):
            found.add(f"{name} {called}", entity, _register(found, key, f"{name} {called}", group))


def _verified(keys: Keys, verify: Keys, point: Point, codes: tuple[int, int]) -> Point:
    """The register with the place where its state is read, which may be another one than is written."""
    usual = "coil" if point.space is Space.COIL else "holding"
    space, at = verify.choice("input_type", INPUTS, usual), verify.whole("address")
    for key, code in zip(("state_on", "state_off"), codes, strict=True):
        state = verify.whole(key)
        if state not in {None, code}:
            keys.remarks.append(
                Remark(f"{key.replace('_', '-')}-dropped", f"{key} {state}: the code written is {code}")
            )
    delay = verify.whole("delay")
    more: dict[str, Any] = {"settle": delay * 1000} if delay else {}
    keys.remarks += verify.rest(frozenset())
    at = point.at if at is None else at
    if (space, at) == (point.space, point.at):
        return replace(point, access="rw", more=more)
    way = {"write_at": point.at} if space is point.space else {"write": OneLine(space=point.space.value, at=point.at)}
    return replace(point, at=at, space=space, access="rw", more=more | way)


def _register(found: Collecting, key: str, name: str, group: str) -> Callable[[Keys], Point]:
    """A further register of an entity, which has one of the entity's keys only."""

    def make(keys: Keys) -> Point:
        at = keys.whole(key)
        keys.taken |= set(keys.node.members or {})
        return Point(name=name, place=found.place(keys.node), at=at or 0, access="rw", group=group)

    return make


def covers(found: Collecting, entity: Node, name: str, group: str) -> None:
    """Add the register that moves a cover, and that of its state if it is another one."""
    states = {"state_closed": 0, "state_open": 1, "state_opening": 2, "state_closing": 3}
    status = entity.get("status_register")

    def codes(keys: Keys, *, writes: bool) -> dict[int, str]:
        given = {key: keys.whole(key) for key in states}
        found = {(states[key] if code is None else code): key.removeprefix("state_") for key, code in given.items()}
        return {code: label for code, label in found.items() if not writes or label in {"open", "closed"}}

    def make(keys: Keys) -> Point:
        space = keys.choice("input_type", WRITES, "holding")
        keys.taken |= {"status_register", "status_register_type"}
        access = "rw" if status is None else "w"
        point = Point(
            name=name, place=found.place(entity), at=address_of(keys), space=space, access=access, group=group
        )
        labels = codes(keys, writes=status is not None)
        return (
            replace(point, type=WireType.BIT)
            if space.is_bits
            else replace(point, more={"enum": labelled(labels), **poll(keys)})
        )

    def make_status(keys: Keys) -> Point:
        at = keys.whole("status_register")
        space = keys.choice("status_register_type", INPUTS, "holding")
        labels = codes(keys, writes=False)
        keys.taken |= set(entity.members or {})
        point = Point(name=f"{name} status", place=found.place(entity), at=at or 0, space=space, group=group)
        return replace(point, type=WireType.BIT) if space.is_bits else replace(point, more={"enum": labelled(labels)})

    found.add(name, entity, make)
    if status is not None:
        found.add(f"{name} status", entity, make_status)


def climates(found: Collecting, entity: Node, name: str, group: str) -> None:
    """Add the registers of a climate: the temperature, the setpoint, and those of its modes."""

    def temperature(keys: Keys, at: int, called: str, access: str) -> Point:
        form = form_of(keys)
        if form.repeated > 1 or form.type.is_octets:
            refuse("data_type", "a temperature is one number")
        unit = UNITS.get(keys.text("temperature_unit"), "")
        space = keys.choice("input_type", INPUTS, "holding") if access == "r" else Space.HOLDING
        return Point(
            name=called,
            place=found.place(entity),
            at=at,
            space=space,
            type=form.type,
            orders=form.orders,
            multiply=keys.scale("scale"),
            add=keys.number("offset") or Fraction(0),
            unit=unit,
            access=access,
            group=group,
        )

    def current(keys: Keys) -> Point:
        point = temperature(keys, address_of(keys), f"{name} temperature", "r")
        keys.taken |= {"target_temp_register", *MODES, *TEMPERATURES}
        return replace(point, more=poll(keys))

    def target(keys: Keys) -> Point:
        registers = keys.take("target_temp_register")
        numbers = [one.text for one in (registers.each if registers else ())]
        if not numbers or len({*numbers}) > 1 or not numbers[0].strip().isdecimal():
            refuse("target_temp_register", f"target_temp_register is {numbers}: one for each mode is not understood")
        point = temperature(keys, int(numbers[0]), f"{name} setpoint", "rw")
        low, high = keys.number("min_temp"), keys.number("max_temp")
        keys.taken |= set(entity.members or {})
        limits = {} if low is None or high is None else {"range": f"{show(low)}..{show(high)}"}
        return replace(point, more=limits)

    found.add(f"{name} temperature", entity, current)
    if entity.get("target_temp_register"):
        found.add(f"{name} setpoint", entity, target)
    for key, called in MODES.items():
        modes = entity.get(key)
        if modes is not None:
            found.add(f"{name} {called}", modes, partial(_mode, found, f"{name} {called}", group))


def _mode(found: Collecting, name: str, group: str, keys: Keys) -> Point:
    """A register with the codes of modes."""
    keys.taken |= {"write_registers"}
    at = keys.take("address")
    place = at.each[0].text if at and at.each else ""
    if not place.strip().isdecimal():
        refuse("address", f"address `{place}` is no address")
    values = keys.take("values")
    labels: dict[int, str] = {}
    for label, node in ((values and values.members) or {}).items():
        for one in node.each:
            if one.text.strip().isdecimal():
                labels.setdefault(int(one.text), label.removeprefix("state_"))
            else:
                keys.remarks.append(Remark("value-unclear", f"{label} {one.shown} is no code"))
    if not labels:
        labels = {
            code: word.removeprefix("state_")
            for word in ("state_off", "state_on")
            if (code := keys.whole(word)) is not None
        }
    keys.taken |= {"state_on", "state_off"}
    more = {"enum": labelled(dict(sorted(labels.items())))} if labels else {}
    return Point(name=name, place=found.place(keys.node), at=int(place), access="rw", group=group, more=more)
