"""Exporters and importers are plug-ins: what they must offer, and how they are found (docs/plugins.md).

A package declares them as entry points; those of regscribe itself stand in its own pyproject.toml. A plug-in is an
object or a module. One that is broken is told by its name: whatever it raises becomes a PluginError.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.metadata import EntryPoint, entry_points
from typing import Protocol, cast

from regscribe.model import Diagnostic, RegisterMap
from regscribe.visible import safe

EXPORTERS, IMPORTERS = "regscribe.exporters", "regscribe.importers"
KINDS = {EXPORTERS: "exporter", IMPORTERS: "importer"}

OPTION = re.compile(r"(?!(format|out|help)$)[a-z][a-z0-9-]*")
"""What an option may be called; three are options of `regscribe export` itself."""

MOST_TEXT = 300
"""Most characters that are shown of what a plug-in says of itself."""


class PluginError(Exception):
    """A plug-in is missing, doubled or broken; the message names it and its distribution."""


class OptionError(Exception):
    """For exporters: what their options ask cannot be done; the message names the option and says what to write."""


@dataclass(frozen=True, slots=True)
class Option:
    """An option of an exporter: `--name METAVAR` on the command line, `default` where it is not given.

    With `several` it may be given more than once; the texts arrive joined by line ends.
    """

    name: str
    help: str
    default: str = ""
    metavar: str = "TEXT"
    several: bool = False


class Exporter(Protocol):
    """Maps to texts for other programs: an entry point of the group `regscribe.exporters`."""

    name: str
    summary: str
    options: tuple[Option, ...]

    def export(self, maps: Sequence[RegisterMap], options: Mapping[str, str]) -> dict[str, str]:
        """Return texts by path below the folder --out, with `/` between its parts; "" is standard output."""
        ...


class Importer(Protocol):
    """A file of another form to a map: an entry point of the group `regscribe.importers`."""

    name: str
    summary: str

    def read(self, data: bytes, name: str) -> tuple[str, tuple[Diagnostic, ...]]:
        """Return a map as YAML but for its keys `format` and `map`, and what is to be said of the file `name`."""
        ...


def names(group: str) -> tuple[str, ...]:
    """The names of all plug-ins of a group, broken ones too, sorted. Raises PluginError."""
    return tuple(sorted({one.name for one in _found(group)}))


def exporter(name: str) -> Exporter:
    """Load an exporter. Raises PluginError."""
    return cast("Exporter", _load(EXPORTERS, name))


def importer(name: str) -> Importer:
    """Load an importer. Raises PluginError."""
    return cast("Importer", _load(IMPORTERS, name))


def export(name: str, maps: Sequence[RegisterMap], options: Mapping[str, str]) -> dict[str, str]:
    """Return what an exporter makes of the maps. Raises PluginError and OptionError."""
    loaded = exporter(name)
    with guarded(EXPORTERS, name):
        texts: object = loaded.export(maps, options)
        if not isinstance(texts, dict) or not all(isinstance(part, str) for pair in texts.items() for part in pair):
            message = "it returns no dict of texts"
            raise TypeError(message)
        "".join(texts.values()).encode()  # raises for what no file can hold
        return texts


def read(name: str, data: bytes, file: str) -> tuple[str, tuple[Diagnostic, ...]]:
    """Return what an importer makes of the bytes of a file. Raises PluginError."""
    loaded = importer(name)
    with guarded(IMPORTERS, name):
        result: object = loaded.read(data, file)
        match result:
            case (str(text), tuple(found)) if all(isinstance(one, Diagnostic) for one in found):
                text.encode()
                return text, found
        message = "it returns no text with a tuple of findings"
        raise TypeError(message)


@contextmanager
def guarded(group: str, name: str) -> Iterator[None]:
    """Turn whatever a plug-in raises, but for an OptionError, into a PluginError that names it."""
    try:
        yield
    except (PluginError, OptionError):
        raise
    except (Exception, SystemExit) as error:
        owners = " and ".join(_owner(one) for one in _found(group) if one.name == name)
        what = f"{type(error).__name__}: {error}"[:MOST_TEXT]
        message = f"the {KINDS[group]} {name} of {owners} is broken: {what}"
        raise PluginError(safe(message)) from error


def _found(group: str) -> Sequence[EntryPoint]:
    try:
        return tuple(entry_points(group=group))
    except Exception as error:
        message = safe(f"the entry points of some installed package cannot be read: {error}"[:MOST_TEXT])
        raise PluginError(message) from error


def _load(group: str, name: str) -> object:
    found = [one for one in _found(group) if one.name == name]
    if len(found) != 1:
        raise PluginError(safe(_no_single(group, name, found)))
    with guarded(group, name):
        loaded = found[0].load()
        if fault := _fault(loaded, group, name):
            raise TypeError(fault)
    return loaded


def _no_single(group: str, name: str, found: Sequence[EntryPoint]) -> str:
    if found:
        owners = " and ".join(sorted(_owner(one) for one in found))
        return f"{len(found)} plug-ins call themselves the {KINDS[group]} {name}, of {owners}: uninstall all but one"
    return f"there is no {KINDS[group]} {name}; there are {', '.join(names(group))}"


def _owner(found: EntryPoint) -> str:
    return f"{found.dist.name} {found.dist.version}" if found.dist else "nobody"


def _fault(loaded: object, group: str, name: str) -> str:
    """What an object lacks to be the plug-in that its entry point calls it; empty if nothing."""
    if getattr(loaded, "name", None) != name or not isinstance(getattr(loaded, "summary", None), str):
        return f"it has no name `{name}` with a summary"
    method = "export" if group == EXPORTERS else "read"
    if not callable(getattr(loaded, method, None)):
        return f"it has no function `{method}`"
    options = getattr(loaded, "options", None)
    if group == EXPORTERS and not (isinstance(options, tuple) and all(map(_is_option, options))):
        return "its options are no tuple of Option with names in lower case"
    return ""


def _is_option(option: object) -> bool:
    return isinstance(option, Option) and OPTION.fullmatch(option.name) is not None
