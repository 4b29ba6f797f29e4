"""Checks which settings of a backup fit a device, before anything is written."""

from collections.abc import Collection, Iterator, Mapping
from typing import Any, NamedTuple

from regscribe.tools.live.errors import unknown
from regscribe.tools.live.names import Driver
from regscribe.tools.live.reading import unit_of
from regscribe.tools.live.value_text import is_number, parse
from regscribe.tools.settings.backup import Backup, Saved
from regscribe_runtime import NotPresent, Register, ValueNotDecodable, ValueRefused
from regscribe_runtime.registers import codec
from regscribe_runtime.registers.presence import absence
from regscribe_runtime.values.views import View

KINDS = ("address", "line", "calibration", "identity", "counter", "operation")
"""Why a setting may have to stay with its device; `include` takes these words."""


class Misfit(NamedTuple):
    """A setting of the file that this device cannot take, and why."""

    path: str
    reason: str


class BackupFit(NamedTuple):
    """The settings of a backup that a device can take, and those that it cannot.

    `values` are decoded values by path that can be written, in the order of the file; `misfits` those that cannot;
    `stays` are kinds by path of settings that are left out because they belong to the saved device alone. `strange` are
    messages: in which respects the file is of another device.
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
    held: Collection[str] = (),
) -> BackupFit:
    """Compare a backup with a driver; `state` has the device's present values where the file has none.

    `include` names kinds of settings that are to be written although they stay with their device. What the device has
    `held` as the file has it, whether it is a value or not, need not fit.
    """
    stays = staying(backup, driver, include)
    parsed: dict[str, Any] = {}
    misfits: list[Misfit] = []
    for path, saved in backup.settings():
        if path in held:
            continue
        try:
            parsed[path] = _value(path, saved, driver)
        except ValueRefused as refusal:
            misfits.append(Misfit(path, refusal.reason))
    values = {path: value for path, value in parsed.items() if path not in stays}
    context = _Context({**state, **parsed}, {**state, **values}, givens)
    for path, saved in backup.settings():
        if path in values and (reason := _contradiction(driver.registers[path], saved, values[path], context)):
            misfits.append(Misfit(path, reason))
            del values[path]
    there = (one for one in misfits if not _did_not_exist(one.path, driver, context))
    left = tuple(one for one in there if one.path not in stays)
    return BackupFit(values, left, stays, tuple(_strangeness(backup, driver)))


class _Context(NamedTuple):
    """The other settings: of the device that was saved, and of this one after the restore; and the givens."""

    saved: Mapping[str, Any]
    restored: Mapping[str, Any]
    givens: Mapping[str, Any]


def _did_not_exist(path: str, driver: Driver, context: _Context) -> bool:
    """Whether a setting did not exist on the device that was saved, so that there is nothing to restore."""
    register = driver.registers.get(path)
    if register is None or path in context.saved:
        return False
    lacking = {name: NotPresent(name, "", {}) for name in register.when.registers if name not in context.saved}
    return isinstance(absence(path, register.when, context.saved, context.givens, lacking), NotPresent)


def staying(backup: Backup, driver: Driver, include: Collection[str]) -> dict[str, str]:
    """The settings of a backup that are not written, with the kind of each that is not in `include`."""
    own = {path: one.stays for path, one in driver.registers.items()}
    kinds = {path: saved.stays or own.get(path, "") for path, saved in backup.settings()}
    return {path: kind for path, kind in kinds.items() if kind not in {"", *include}}


def _strangeness(backup: Backup, driver: Driver) -> Iterator[str]:
    """Yield the differences between a backup's device and a driver: map, version of the map, model."""
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


def _contradiction(register: Register[Any], saved: Saved, value: object, context: _Context) -> str:
    """The reason why a value cannot be meant: its unit is another here, or its words decode to another value."""
    unit = unit_of(register, context.restored, context.givens) if is_number(saved.value) else ""
    if saved.unit and saved.unit != unit:
        return f"it stands in {saved.unit}, but with these settings the device works in {unit or 'no unit'}"
    view = register.read_view()
    if len(saved.raw) != view.words or not set(register.needs(view)) <= set(context.saved):
        return ""
    try:
        decoded = codec.decode(register, view, saved.raw, context.saved, context.givens)
    except (ValueNotDecodable, ValueError) as error:
        return f"its words {list(saved.raw)} are no value ({error})"
    if decoded != value:
        return f"the file says {saved.spelled}, but its words {list(saved.raw)} mean {decoded}: which one is right?"
    return _lost_in_a_float(register, view, saved, decoded, context)


def _lost_in_a_float(register: Register[Any], view: View, saved: Saved, value: object, context: _Context) -> str:
    """The reason why writing a value would send other words than it was read from: a float has fewer digits."""
    if not (isinstance(value, float) and value and set(register.limit_needs) <= set(context.saved)):
        return ""
    try:
        words = codec.encode(register, view, value, context.saved, context.givens)
    except ValueRefused:
        return ""  # writing it says why
    if words == saved.raw:
        return ""
    return (
        f"its words {list(saved.raw)} have more digits than the number {saved.spelled} in a program, which would be "
        f"written as {list(words)}: write the words themselves"
    )
