"""Devices to simulate, from the command line or a file: map and model, unit, givens, initial state, process."""

import re
import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

import click

from regscribe import source
from regscribe.cli.shared.compiled_maps import compiled_maps
from regscribe.cli.shared.diagnostic_text import findings
from regscribe.cli.shared.map_arguments import did_you_mean, find_map
from regscribe.cli.shared.output import raised_as, refuse, show
from regscribe.cli.shared.standard_input import input_bytes, is_stdin
from regscribe.model import RegisterMap
from regscribe.model.nearest import nearest
from regscribe.simulate import SimulatedDevice, SimulatorError, ThermalProcess
from regscribe.simulate.device import state_files
from regscribe.tools.live.givens import Given, given_of
from regscribe_runtime.values.blocks import bases_in
from regscribe_runtime.values.serial_line import ADDRESSINGS, MODBUS

KEYS = ("map", "model", "unit", "given", "base", "state", "process", "seed", "addressing", "without")


@dataclass(frozen=True, slots=True, kw_only=True)
class WantedDevice:
    """A device to make; where a field is None or empty, the options of the command count."""

    map: str
    model: str | None = None
    unit: int | None = None
    givens: tuple[str, ...] = ()
    bases: tuple[str, ...] = ()
    state: str = ""
    process: ThermalProcess | None = None
    seed: int | None = None
    addressing: str = ""
    without: tuple[str, ...] = ()

    def over(self, common: Mapping[str, Any]) -> "WantedDevice":
        """The same with the options common to all devices where a field is None or empty."""
        return replace(self, **{key: value for key, value in common.items() if getattr(self, key) in (None, "")})


def wanted_device(text: str) -> WantedDevice:
    """The device of `MAP:MODEL:UNIT`, `MAP:MODEL` or `MAP`; of `MAP::UNIT` where the map has one model."""
    found = re.fullmatch(r"(.+?)(?::([^:]*)(?::([0-9]{1,3}))?)?", text, re.DOTALL)
    if not found:
        refuse(f"--device {text}: write MAP:MODEL:UNIT, for example athena/series-c:16C:3")
    return WantedDevice(map=found[1], model=found[2] or None, unit=int(found[3]) if found[3] else None)


def wanted_devices(path: Path) -> list[WantedDevice]:
    """The devices of a YAML file, as `devices: [{map: athena/series-c, model: 16C, unit: 3}]`; UsageError if none."""
    document, found = source.load(path)
    if document is None:
        show(findings(found), stream=sys.stderr)
        refuse(f"--devices {path}: it cannot be read as YAML")
    listed = document.data.get("devices") if isinstance(document.data, dict) else None
    if not isinstance(listed, list) or not listed:
        refuse(f"--devices {path}: write `devices:` with a list of mappings that have `map`, `model` and `unit`")
    return [_wanted(each, f"--devices {path}: device {number}") for number, each in enumerate(listed, start=1)]


def _wanted(entry: object, where: str) -> WantedDevice:
    given = _mapping(entry, where)
    givens, unit, seed = given.get("given") or {}, given.get("unit"), given.get("seed")
    bases = given.get("base") or {}
    without = given.get("without") or []
    formed = isinstance(givens, dict) and isinstance(bases, dict) and isinstance(without, list)
    if not formed or not all(isinstance(each, int | None) for each in (unit, seed)):
        refuse(f"{where}: `given` and `base` are mappings, `without` is a list, `unit` and `seed` are whole numbers")
    return WantedDevice(
        map=str(given["map"]),
        model=None if given.get("model") is None else str(given["model"]),
        unit=unit,
        givens=tuple(f"{name}={_option_text(value)}" for name, value in givens.items()),
        bases=tuple(f"{name}={value}" for name, value in bases.items()),
        state=str(given.get("state") or ""),
        process=_process(given.get("process"), where),
        seed=seed,
        addressing=str(given.get("addressing") or ""),
        without=tuple(map(str, without)),
    )


def _mapping(entry: object, where: str) -> dict[str, Any]:
    if not isinstance(entry, dict) or "map" not in entry:
        refuse(f"{where} is no mapping with `map` and, if that has several, `model`")
    for key in entry:
        if key not in KEYS:
            refuse(f"{where} has the key `{key}`: known are {', '.join(KEYS)}{did_you_mean(str(key), KEYS)}")
    return entry


def _option_text(value: object) -> str:
    """The value of a given in the form of the command line."""
    if isinstance(value, list):
        return ",".join(map(str, value))
    return str(value).lower() if isinstance(value, bool) else str(value)


def _process(value: object, where: str) -> ThermalProcess | None:
    if isinstance(value, dict):
        return process_of(",".join(f"{key}={each}" for key, each in value.items()) or "on", where=f"{where}: process")
    return process_of("on", where=where) if value is True else None


def process_of(text: str | None, *, where: str = "--process") -> ThermalProcess | None:
    """The process of `on` or `time_constant=60,dead_time=5`; None for no text."""
    if text is None:
        return None
    known = [field.name for field in fields(ThermalProcess)]
    given: dict[str, float] = {}
    for part in text.split(",") if text != "on" else ():
        name, equals, value = part.partition("=")
        if not equals or name.strip() not in known:
            wanted = f"NAME=NUMBER with one of {', '.join(known)}"
            refuse(f"{where} {text}: `{part}` is not {wanted}{did_you_mean(name, known)}")
        try:
            given[name.strip()] = float(value)
        except ValueError:
            refuse(f"{where} {text}: `{value}` is no number")
    with raised_as(click.UsageError, SimulatorError):
        return ThermalProcess(**given)


def compiled_by_name(names: Iterable[str]) -> dict[str, RegisterMap]:
    """The compiled maps by name, each once; ends the command where one has errors."""
    return {name: compiled_maps([find_map(name)], nothing="nothing is served")[0] for name in dict.fromkeys(names)}


def device_of(wanted: WantedDevice, register_map: RegisterMap) -> SimulatedDevice:
    """Make a device; UsageError where the wish is at fault, SimulatorError where its state cannot be loaded."""
    model = _model(wanted.model, register_map)
    with raised_as(click.UsageError, ValueError):
        bases = bases_in(register_map.id, register_map.blocks, wanted.bases)
    values = dict(_given(one, register_map) for one in wanted.givens)
    addressing = wanted.addressing or MODBUS
    if addressing not in ADDRESSINGS:
        refuse(f"addressing {addressing} is none of {', '.join(ADDRESSINGS)}")
    try:
        device = SimulatedDevice(
            register_map,
            model,
            unit=wanted.unit,
            givens=values,
            seed=wanted.seed or 0,
            addressing=addressing,
            process=wanted.process or False,
            bases=bases,
            without=wanted.without,
        )
    except SimulatorError as error:
        tips = (f"\nOn the command line: --given {one.id}=VALUE" for one in register_map.givens if one.id not in values)
        refuse(f"{error}{next(tips, '')}")
    if wanted.state:
        _load(device, wanted.state)
    return device


def _load(device: SimulatedDevice, name: str) -> None:
    """Set a device to a file, or to standard input. Raises SimulatorError."""
    if is_stdin(name):
        name = "standard input"
        device.restore(state_files.parse(input_bytes(state_files.MOST_BYTES), name), name=name)
    else:
        device.load(name)


def _model(model: str | None, register_map: RegisterMap) -> str:
    names = [one.name for one in register_map.models]
    model = model or register_map.only_model
    if not model:
        refuse(f"--model is missing: {register_map.id} has {', '.join(names)}")
    if model not in names:
        folded = {name.casefold(): name for name in names}
        near = nearest(model.casefold(), folded)
        hint = f"; did you mean `{folded[near]}`?" if near else ""
        refuse(f"{register_map.id} has no model `{model}`: it has {', '.join(names)}{hint}")
    return model


def _given(text: str, register_map: RegisterMap) -> tuple[str, Given]:
    name, equals, value = text.partition("=")
    known = {given.id: given for given in register_map.givens}
    if not equals or name not in known:
        refuse(f"--given {text}: write ID=VALUE; {register_map.id} has the givens {', '.join(known) or '(none)'}")
    try:
        return name, given_of(name, known[name].kind, value, known[name].choices)
    except ValueError as error:
        refuse(f"--given {text}: {error}")
