"""State files: the state of a device as plain YAML; a backup of a real device can be loaded as well.

format: 1
state: {map: athena/series-c, model: 16C, unit: 1}
values: {setpoint_ram: 150.5, operating_mode: MANUAL}
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from regscribe import files, source
from regscribe.model import Diagnostic
from regscribe.simulate.device.device_plan import Stored, sources_of
from regscribe.simulate.device.plain_values import Plain, meant, set_to, shown
from regscribe.simulate.device.state import DeviceState
from regscribe.simulate.errors import SimulatorError
from regscribe.source import Document

FORMAT = 1
MOST_BYTES = 8_000_000
"""A state of the largest device has 200 kB; a file beyond this is none."""

PASSES = 2
"""How often values are set: in the first pass scales and word orders may come after the values that need them."""


def snapshot(state: DeviceState, unit: int, wear: Mapping[str, int]) -> dict[str, Any]:
    """Return all that a device holds, ready for YAML or JSON."""
    blueprint = state.blueprint
    head = {"map": blueprint.register_map.id, "model": blueprint.model.name, "unit": unit}
    values = {each.path: shown(state, each, state.stored(each.path)) for each in blueprint.model.registers}
    pending = {path: _in_effect(state, path, stored) for path, stored in state.pending.items()}
    document: dict[str, Any] = {"format": FORMAT, "state": head, "values": values}
    return document | ({"in_effect": pending} if pending else {}) | ({"wear": dict(wear)} if wear else {})


def _in_effect(state: DeviceState, path: str, former: Stored) -> Plain:
    """The plain value in effect of a register that shows another one."""
    copy = state.copy()
    copy.take_effect(path)
    copy.store(path, former)
    return shown(copy, state.register(path), copy.stored(path))


def as_text(document: Mapping[str, Any]) -> str:
    """A state as the text of its file."""
    return files.dump(document, remarks=("State of a simulated device; `regscribe simulate --state` loads it.",))


def save(path: Path, document: Mapping[str, Any]) -> None:
    """Write a state; if that fails, SimulatorError, and an existing file stays as it was."""
    try:
        files.save(path, as_text(document))
    except files.FileError as problem:
        message = f"cannot write the state: {problem}"
        raise SimulatorError(message) from None


def load(path: Path) -> Mapping[str, Any]:
    """Return the document in a state or backup file; SimulatorError with line and column where it is none."""
    try:
        size = path.stat().st_size
    except OSError as problem:
        message = f"cannot read the state {path}: {problem.strerror or problem}"
        raise SimulatorError(message) from None
    if size > MOST_BYTES:
        message = f"{path} has {size} bytes: a state has at most {MOST_BYTES}"
        raise SimulatorError(message)
    return _mapping_in(*source.load(path, escapes=True), name=str(path))


def parse(content: bytes, name: str) -> Mapping[str, Any]:
    """Return the document in the bytes of a state or backup; SimulatorError as `load`."""
    return _mapping_in(*source.parse(content, name=name, escapes=True), name=name)


def _mapping_in(document: Document | None, found: Sequence[Diagnostic], *, name: str) -> Mapping[str, Any]:
    if document is None:
        first = found[0]
        message = f"{name} is no state: {first.span.line}:{first.span.column}: {first.message}"
        raise SimulatorError(message)
    if not isinstance(document.data, dict):
        message = f"{name} is no state: it is no mapping with `format`, `state` and `values`"
        raise SimulatorError(message)
    return document.data


def restore(state: DeviceState, document: Mapping[str, Any], name: str) -> dict[str, int]:
    """Set a device to a state or a backup; return the wear that it records.

    Raises SimulatorError if it is of another model, or a value is none; the device is then as it was.
    """
    head, values = _parts(document, name)
    here = (state.blueprint.register_map.id, state.blueprint.model.name)
    there = (str(head.get("map")), str(head.get("model")))
    if there != here:
        message = f"{name} is of {there[0]}, model {there[1]}, but this is {here[0]}, model {here[1]}"
        raise SimulatorError(message)
    trial = state.copy()
    for _ in range(PASSES):
        _set(trial, values, name)
    _set(trial, {path: plain for path, plain in values.items() if sources_of(trial.register(path))}, name)
    for path, plain in _mapping(document.get("in_effect")).items():
        _hold_back(trial, path, plain, name)
    state.adopt(trial)
    counts = _mapping(document.get("wear")).items()
    return {str(path): count for path, count in counts if isinstance(count, int) and count > 0}


def _parts(document: Mapping[str, Any], name: str) -> tuple[Mapping[str, Any], Mapping[str, object]]:
    """The head and the values of a state, or of a backup, whose settings stand in groups."""
    if document.get("format") != FORMAT:
        message = f"{name} is no state of format {FORMAT}: its `format` is {document.get('format')!r}"
        raise SimulatorError(message)
    head, values = document.get("state"), document.get("values")
    if isinstance(head, dict) and isinstance(values, dict):
        return head, values
    head, settings = document.get("backup"), document.get("settings")
    if isinstance(head, dict) and isinstance(settings, dict):
        return head, _settings(settings)
    message = f"{name} is no state: it has neither `state` and `values` nor `backup` and `settings`"
    raise SimulatorError(message)


def _settings(groups: Mapping[str, Any]) -> dict[str, object]:
    """The values of a backup by path; a setting without one is left as it is."""
    entries = [entry for group in groups.values() for entry in _mapping(group).items()]
    values = {path: _mapping(entry).get("value") for path, entry in entries}
    return {path: value for path, value in values.items() if value is not None}


def _mapping(plain: object) -> Mapping[str, Any]:
    """The value itself if it is a mapping, else an empty one."""
    return plain if isinstance(plain, dict) else {}


def _set(state: DeviceState, values: Mapping[str, object], name: str) -> None:
    known = {register.path: register for register in state.blueprint.model.registers}
    for path, plain in values.items():
        if path not in known:
            message = f"{name}: model {state.blueprint.model.name} has no register `{path}`{meant(path, list(known))}"
            raise SimulatorError(message)
        try:
            set_to(state, known[path], plain)
        except SimulatorError as problem:
            message = f"{name}: {problem}"
            raise SimulatorError(message) from None


def _hold_back(state: DeviceState, path: str, plain: object, name: str) -> None:
    """Put a plain value in effect for a register that shows another one."""
    shown = state.stored(path) if any(each.path == path for each in state.blueprint.model.registers) else None
    _set(state, {path: plain}, name)
    former = state.stored(path)
    if shown is not None and former != shown:
        state.store(path, shown)
        state.hold_back(path, former)
