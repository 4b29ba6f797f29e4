"""The configuration: devices by name, and the user's packages of drivers; YAML, checked against its JSON Schema."""

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from regscribe.tools.live.errors import TargetError

LOCAL = "regscribe.yaml"
"""The name of a configuration in the working directory or in one above it."""

NONE = os.devnull
"""Named as the configuration: none at all, whatever lies about."""

USER = "devices.yaml"
"""The name of a configuration in the user's folder of configurations."""

TRUSTED = (0,)
"""Users whose configuration counts, besides the one who asks: root."""

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
    """The configuration that `find` finds, else an empty one.

    TargetError for a file that is named but absent, and for mistakes in it, with line and column of each.
    """
    found = find(path)
    return Config() if found is None else _read(found)


def find(path: str | Path | None = None) -> Path | None:
    """The file at `path`, else of REGSCRIBE_CONFIG, regscribe.yaml here or above, or the user's own; None for none.

    One above the working directory counts only if it is the user's or root's: it names code that is run.
    """
    named = path or os.environ.get(VARIABLE)
    if named:
        return None if str(named) == NONE else Path(named)
    import platformdirs  # noqa: PLC0415 - 10 ms that a configuration which is named does not need

    own = platformdirs.user_config_path("regscribe", appauthor=False) / USER
    here = [Path(LOCAL), *(folder / LOCAL for folder in Path.cwd().parents if _is_trusted(folder / LOCAL))]
    return next((one for one in (*here, own) if one.is_file()), None)


def _is_trusted(path: Path) -> bool:
    """Whether a file belongs to the user or to root; always where files have no owners (Windows)."""
    own = getattr(os, "getuid", None)
    try:
        return own is None or path.stat().st_uid in {*TRUSTED, own()}
    except OSError:
        return False


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
