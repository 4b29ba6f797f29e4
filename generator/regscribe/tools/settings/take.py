"""The settings of a model: read from a device in one snapshot as a backup, or as its manual gives their defaults."""

from collections.abc import Callable, Collection, Iterable, Mapping
from contextlib import suppress
from dataclasses import replace
from datetime import UTC, datetime
from fractions import Fraction
from types import MappingProxyType
from typing import Any

from regscribe.tools.live.names import Driver, groups_of, readable
from regscribe.tools.live.reading import left_out, read_with, reason, shown_needs, unit_needs, unit_of
from regscribe.tools.live.value_text import is_number, parse, show
from regscribe.tools.settings.backup import NO_GROUP, Backup, BackupOrigin, Saved
from regscribe_runtime import Register, RegscribeError, Snapshot, ValueRefused
from regscribe_runtime.operations.session import Operation, Session, Task
from regscribe_runtime.registers.codec import present_type
from regscribe_runtime.registers.octets import OctetType
from regscribe_runtime.registers.presence import absence
from regscribe_runtime.values.conditions import choose
from regscribe_runtime.values.kinds import OCTETS, Kind
from regscribe_runtime.values.numbers import Number, exact

TEXTS = OCTETS | {Kind.VERSION}


def writable(driver: Driver) -> list[Register[Any]]:
    """The registers of a driver that can be read and written: its settings are among them."""
    return [register for register in readable(driver) if register.access == "rw" and register.stays != "momentary"]


def _in_groups(driver: Driver) -> dict[str, list[Register[Any]]]:
    """The settings of a driver by the group that has them first; those of no group last."""
    left = {register.path: register for register in writable(driver)}
    groups = {
        name: [left.pop(one.path) for one in group.registers(driver) if one.path in left]
        for name, group in groups_of(driver).items()
    }
    return {name: members for name, members in {**groups, NO_GROUP: list(left.values())}.items() if members}


def _identity_of(driver: Driver) -> list[Register[Any]]:
    """The registers that tell the model of a device, and those that tell one device from another."""
    paths = [path for one in driver.identity for path in one.registers()]
    paths += [path for path, one in driver.registers.items() if one.stays == "identity" and one.access == "r"]
    return [driver.registers[path] for path in dict.fromkeys(paths)]


def backup(driver: Driver, *, link: str = "", now: datetime | None = None) -> Task[Backup]:
    """Read all settings of a device of that driver; `link` and `now` are for the record.

    A setting that holds no value is kept with its words and the reason. Raises what reading raises.
    """
    identity = _identity_of(driver)
    registers = {register.path: register for register in (*writable(driver), *identity)}

    def task(session: Session) -> Operation[Backup]:
        _, saved = yield from read_saved(registers.values(), shown_needs)(session)
        origin = BackupOrigin(
            map_id=driver.map_id,
            map_sha256=driver.map_sha256,
            model=driver.model,
            unit=session.unit,
            link=link,
            taken=(now or datetime.now(UTC)).strftime("%Y-%m-%dT%H:%M:%SZ"),
            identification={register.path: saved[register.path] for register in identity},
        )
        groups = {name: {one.path: saved[one.path] for one in members} for name, members in _in_groups(driver).items()}
        return Backup(origin=origin, groups=groups)

    return task


def read_saved(
    registers: Collection[Register[Any]], needs: Callable[[Register[Any]], Iterable[str]]
) -> Task[tuple[dict[str, Any], dict[str, Saved]]]:
    """Read registers, and those that each `needs`: the values that are known then, and each of `registers` as saved."""

    def task(session: Session) -> Operation[tuple[dict[str, Any], dict[str, Saved]]]:
        snapshot = yield from read_with(registers, needs)(session)
        return snapshot.valid, {one.path: _saved_of(one, snapshot, session.givens) for one in registers}

    return task


def _saved_of(register: Register[Any], snapshot: Snapshot, givens: Mapping[str, Any]) -> Saved:
    """A register of a snapshot; one that holds no value with its words and the reason."""
    raw, state = snapshot.words.get(register.path, ()), snapshot.valid
    try:
        value = snapshot[register.path]
    except RegscribeError as error:
        return Saved(error=reason(error, register.path), raw=raw, stays=register.stays)
    absent = left_out(register, value, state, givens)
    held = _saved(register, value, state, givens, raw)
    return replace(held, value=show(register, value, absent), absent=absent)


def factory(driver: Driver, beside: Mapping[str, Saved] = MappingProxyType({})) -> dict[str, Saved]:
    """The settings of a model by path, where its manual gives a default and they exist as delivered.

    What the defaults leave open (a condition on a register without one) is as in the settings `beside` them.
    """
    values: dict[str, Any] = {}
    for one in writable(driver):
        if one.default is not None:
            values[one.path] = _default_of(one, one.default, values)
    for one in writable(driver):
        with suppress(KeyError):  # the case depends on what has no default
            if (default := choose(one.default_cases, values, {})) is not None:
                values[one.path] = _default_of(one, default, values)
    there = {
        path: driver.registers[path] for path in values if _stands(driver.registers[path], values, beside.get(path))
    }
    return {path: _delivered(one, values[path], values, beside.get(path, Saved())) for path, one in there.items()}


def _stands(register: Register[Any], state: Mapping[str, Any], beside: Saved | None) -> bool:
    """Whether a register exists as delivered; where the defaults leave that open, whether it does on the other side."""
    try:
        return absence(register.path, register.when, state, {}) is None
    except KeyError:
        return beside is None or beside.value is not None or bool(beside.raw)


def _delivered(register: Register[Any], value: Any, state: Mapping[str, Any], beside: Saved) -> Saved:  # noqa: ANN401 (a value of any register)
    """A default; a code that means nothing by itself, or a number without a unit, has that of an equal one `beside`."""
    if register.value_type.coded and type(value) is int and value == _code_of(register, beside):
        return replace(beside, raw=(), stays=register.stays)
    saved = _saved(register, value, state, {})
    if is_number(saved.value) and not set(unit_needs(register)) <= set(state):
        saved = replace(saved, unit=beside.unit)
    absent = left_out(register, value, state, {})
    return replace(saved, value=show(register, value, absent), absent=absent)


def _code_of(register: Register[Any], saved: Saved) -> int | None:
    """The code of a saved value; None where it has none."""
    with suppress(ValueRefused):
        return None if saved.value is None else int(parse(register, saved.value))
    return None


def _default_of(register: Register[Any], default: Number | float | str | None, state: Mapping[str, Any]) -> Any:  # noqa: ANN401 (a value of any register)
    """The default as a driver would read it: a member of the enum, a special value, a number, a text.

    A code whose meaning depends on what is not in `state` stays a number.
    """
    value_type = register.value_type
    if isinstance(value_type, OctetType) and isinstance(default, str):
        return value_type.parse(default)
    if register.kind in TEXTS or default is None:
        return default
    if value_type.coded:
        with suppress(KeyError):
            return present_type(register, state, {}).make(int(default))
        return int(default)
    number = Fraction(default) if isinstance(default, str) else exact(default)
    for member in value_type.special or ():
        if exact(member.value) == number:
            return member
    return value_type.make(number)


def _saved(
    register: Register[Any],
    value: Any,  # noqa: ANN401 (as above)
    state: Mapping[str, Any],
    givens: Mapping[str, Any],
    raw: tuple[int, ...] = (),
) -> Saved:
    plain = show(register, value)
    unit = unit_of(register, state, givens) if is_number(plain) else ""
    return Saved(value=plain, unit=unit, raw=raw, stays=register.stays)
