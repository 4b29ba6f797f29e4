"""The configuration: devices by name, and the user's packages of drivers; YAML, checked against its JSON Schema."""

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from regscribe.tools.live.errors import TargetError

LOCAL = Path("regscribe.yaml")
"""Looked for in the working directory first."""

VARIABLE = "REGSCRIBE_CONFIG"
"""The environment variable that names a configuration."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedDevice:
    """A named device: its link as text, and its other settings."""

    link: str
    unit: int | None = None
    model: str = ""
    map: str = ""
    timeout: str = ""
    givens: Mapping[str, str] = field(default_factory=dict)
    note: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Config:
    """A configuration; `path` is empty where there is none."""

    path: str = ""
    devices: Mapping[str, NamedDevice] = field(default_factory=dict)
    packages: tuple[str, ...] = ()


def load(path: str | Path | None = None) -> Config:
    """The configuration at `path`, else of REGSCRIBE_CONFIG, ./regscribe.yaml or the user's own, else an empty one.

    TargetError for a file that is named but absent, and for mistakes in it, with line and column of each.
    """
    named = path or os.environ.get(VARIABLE)
    if named:
        return _read(Path(named))
    own = Path(os.environ.get("XDG_CONFIG_HOME") or "~/.config", "regscribe", "devices.yaml").expanduser()
    for one in (LOCAL, own):
        if one.is_file():
            return _read(one)
    return Config()


def _read(path: Path) -> Config:
    if not path.is_file():
        message = f"there is no configuration {path}"
        raise TargetError(message)
    from regscribe import files  # noqa: PLC0415 - yaml and jsonschema: 150 ms that only a configuration needs

    try:
        document = files.read(path, language="devices", what="configuration")
    except files.FileError as error:
        raise TargetError(str(error)) from None
    folder = path.resolve().parent
    packages = tuple(str(folder / name) if "/" in name else name for name in document.data.get("packages", ()))
    devices = {name: _entry(given, folder) for name, given in (document.data.get("devices") or {}).items()}
    return Config(path=str(path), devices=devices, packages=packages)


def _entry(given: Any, folder: Path) -> NamedDevice:  # noqa: ANN401 - checked against the schema
    if isinstance(given, str):
        return NamedDevice(link=given)
    return NamedDevice(
        link=given["link"],
        unit=given.get("unit"),
        model=given.get("model", ""),
        map=str(beside) if (beside := folder / (named := given.get("map", ""))).is_file() else named,
        timeout=str(given.get("timeout", "")),
        givens={name: _given(value) for name, value in given.get("given", {}).items()},
        note=given.get("note", ""),
    )


def _given(value: Any) -> str:  # noqa: ANN401 - as above
    if isinstance(value, bool):
        return str(value).lower()
    return ",".join(map(str, value)) or "none" if isinstance(value, list) else str(value)
