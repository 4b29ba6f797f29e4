"""Whether a backup fits a device, and what of it does: nothing is written before this is known."""

from collections.abc import Collection, Iterator, Mapping
from typing import Any, NamedTuple

from regscribe.tools.live.errors import unknown
from regscribe.tools.live.names import Driver
from regscribe.tools.live.reading import unit_of
from regscribe.tools.live.value_text import is_number, parse
from regscribe.tools.settings.backup import Backup, Saved
from regscribe_runtime import Register, ValueNotDecodable, ValueRefused
from regscribe_runtime.registers import codec
from regscribe_runtime.values.views import View

KINDS = ("address", "line", "calibration", "identity", "counter", "operation")
"""Why a setting may have to stay with its device; `include` takes these words."""


class Misfit(NamedTuple):
    """A setting of the file that this device cannot take, and why."""

    path: str
    reason: str


class BackupFit(NamedTuple):
    """What of a backup a device can take.

    `values` are what can be written, values of use by path, in the order of the file; `misfits` what cannot;
    `stays` what is left out because it belongs to the saved device alone, by its kind. `strange` says in what the file
    is of another device: each line is one difference.
    """

    values: Mapping[str, Any]
    misfits: tuple[Misfit, ...]
    stays: Mapping[str, str]
    strange: tuple[str, ...]


def fit(
    backup: Backup,
    driver: Driver,
    *,
    state: Mapping[str, Any],
    givens: Mapping[str, Any],
    include: Collection[str] = (),
) -> BackupFit:
    """Hold a backup against a driver; `state` has the device's present values where the file has none.

    `include` names kinds of settings that are to be written although they stay with their device.
    """
    meant, misfits = _meant(backup, driver)
    stays = _stays(backup, driver, include)
    values = {path: value for path, value in meant.items() if path not in stays}
    world = _World({**state, **meant}, {**state, **values}, givens)
    for path, saved in backup.settings():
        reason = _contradiction(driver.registers[path], saved, values[path], world) if path in values else ""
        if reason:
            misfits.append(Misfit(path, reason))
            del values[path]
    left = tuple(one for one in misfits if one.path not in stays)
    return BackupFit(values, left, stays, tuple(strangeness(backup, driver)))


def _meant(backup: Backup, driver: Driver) -> tuple[dict[str, Any], list[Misfit]]:
    """The values of use that the settings mean, and the settings that mean none here."""
    meant: dict[str, Any] = {}
    misfits: list[Misfit] = []
    for path, saved in backup.settings():
        try:
            meant[path] = _value(path, saved, driver)
        except ValueRefused as refusal:
            misfits.append(Misfit(path, refusal.reason))
    return meant, misfits


class _World(NamedTuple):
    """The values around a setting: on the device that was saved, and on this one when all is written."""

    there: Mapping[str, Any]
    here: Mapping[str, Any]
    givens: Mapping[str, Any]


def _stays(backup: Backup, driver: Driver, include: Collection[str]) -> dict[str, str]:
    """The settings that stay with the device that was saved, by the kind of each."""
    own = {path: one.stays for path, one in driver.registers.items()}
    kinds = {path: saved.stays or own.get(path, "") for path, saved in backup.settings()}
    return {path: kind for path, kind in kinds.items() if kind and kind not in include}


def strangeness(backup: Backup, driver: Driver) -> Iterator[str]:
    """In what a backup is of another device than a driver's: map, model, version of the map."""
    origin = backup.origin
    if origin.map_id != driver.map_id:
        yield f"the file is of the map {origin.map_id}, the device of {driver.map_id}"
    elif origin.map_sha256 != driver.map_sha256:
        yield f"the file was made with another version of the map {origin.map_id} ({origin.map_sha256[:12]}…)"
    if origin.model != driver.model:
        yield f"the file is of a {origin.model}, the device is a {driver.model}"


def _value(path: str, saved: Saved, driver: Driver) -> Any:  # noqa: ANN401 (a value of any register)
    register = driver.registers.get(path)
    if register is None:
        raise ValueRefused(path, unknown("register", path, driver.registers, where=f"in {driver.model}"))
    if register.access != "rw":
        raise ValueRefused(path, f"it is {'read-only' if register.access == 'r' else 'write-only'} on {driver.model}")
    if saved.value is None:
        raise ValueRefused(path, f"the file has no value for it ({saved.error or 'none was read'})")
    return parse(register, saved.value, unit=saved.unit, current_unit=saved.unit)


def _contradiction(register: Register[Any], saved: Saved, value: object, world: _World) -> str:
    """Why a value cannot be meant: its unit is another here, or its words say something else."""
    unit = unit_of(register, world.here, world.givens) if is_number(saved.value) else ""
    if saved.unit and saved.unit != unit:
        return f"it stands in {saved.unit}, but with these settings the device works in {unit or 'no unit'}"
    view = register.read_view()
    if len(saved.raw) != view.words or not set(register.needs(view)) <= set(world.there):
        return ""
    try:
        spelled = codec.decode(register, view, saved.raw, world.there, world.givens)
    except (ValueNotDecodable, ValueError) as error:
        return f"its words {list(saved.raw)} are no value ({error})"
    if spelled != value:
        return f"the file says {saved.spelled}, but its words {list(saved.raw)} mean {spelled}: which one is right?"
    return _lost_in_a_float(register, view, saved, spelled, world)


def _lost_in_a_float(register: Register[Any], view: View, saved: Saved, value: object, world: _World) -> str:
    """Why writing a value would send other words than it was read from: a float has fewer digits than they."""
    told = isinstance(value, float) and value and set(register.limit_needs) <= set(world.there)
    if not told:
        return ""
    try:
        words = codec.encode(register, view, value, world.there, world.givens)
    except ValueRefused:
        return ""  # writing it says why
    if words == saved.raw:
        return ""
    return (
        f"its words {list(saved.raw)} have more digits than the number {saved.spelled} in a program, which would be "
        f"written as {list(words)}: write the words themselves"
    )
