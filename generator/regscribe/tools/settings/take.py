"""Reads all settings of a device in one snapshot, as a backup: by group and name."""

from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from typing import Any

from regscribe.tools.live.names import Driver, groups_of, readable
from regscribe.tools.live.reading import read_with, reason, unit_needs, unit_of
from regscribe.tools.live.value_text import is_number, show
from regscribe.tools.settings.backup import NO_GROUP, Backup, BackupOrigin, Saved
from regscribe_runtime import Register, RegscribeError, Snapshot
from regscribe_runtime.operations.session import Operation, Session, Task


def writable(driver: Driver) -> list[Register[Any]]:
    """The registers of a driver that can be read and written: what its settings are among."""
    return [register for register in readable(driver) if register.access == "rw"]


def in_groups(driver: Driver) -> dict[str, list[Register[Any]]]:
    """The settings of a driver by the group that has them first; those of no group last."""
    left = {register.path: register for register in writable(driver)}
    found = {
        name: [left.pop(one.path) for one in group.registers(driver) if one.path in left]
        for name, group in groups_of(driver).items()
    }
    return {name: members for name, members in {**found, NO_GROUP: list(left.values())}.items() if members}


def identity_of(driver: Driver) -> list[Register[Any]]:
    """The registers that tell the model of a device, and those that tell one device from another."""
    paths = [path for one in driver.identity for path in one.registers()]
    paths += [path for path, one in driver.registers.items() if one.stays == "identity" and one.access == "r"]
    return [driver.registers[path] for path in dict.fromkeys(paths)]


def backup(driver: Driver, *, link: str = "", now: datetime | None = None) -> Task[Backup]:
    """Read all settings of a device of that driver; `link` and `now` are for the record.

    A setting that holds no value is kept with its words and the reason. Raises what reading raises.
    """

    def task(session: Session) -> Operation[Backup]:
        found = yield from saved([*writable(driver), *identity_of(driver)])(session)
        origin = BackupOrigin(
            map_id=driver.map_id,
            map_sha256=driver.map_sha256,
            model=driver.model,
            unit=session.unit,
            link=link,
            taken=(now or datetime.now(UTC)).strftime("%Y-%m-%dT%H:%M:%SZ"),
            identification={register.path: found[register.path] for register in identity_of(driver)},
        )
        groups = {name: {one.path: found[one.path] for one in members} for name, members in in_groups(driver).items()}
        return Backup(origin=origin, groups=groups)

    return task


def saved(registers: Sequence[Register[Any]]) -> Task[dict[str, Saved]]:
    """Read registers, and with them those that decide their units; plain values, units and words by path."""

    def task(session: Session) -> Operation[dict[str, Saved]]:
        snapshot = yield from read_with(registers, unit_needs)(session)
        state = snapshot.valid
        return {register.path: _saved(register, snapshot, state, session.givens) for register in registers}

    return task


def _saved(register: Register[Any], snapshot: Snapshot, state: Mapping[str, Any], givens: Mapping[str, Any]) -> Saved:
    raw = snapshot.words.get(register.path, ())
    try:
        value = snapshot[register.path]
    except RegscribeError as error:
        return Saved(error=reason(error, register.path), raw=raw, stays=register.stays)
    plain = show(register, value)
    unit = unit_of(register, state, givens) if is_number(plain) else ""
    return Saved(value=plain, unit=unit, raw=raw, stays=register.stays)
