"""Finds and runs exporters and importers, which are plug-ins, and says what these must offer (docs/plugins.md).

A package declares them as entry points; those of regscribe itself stand in its own pyproject.toml. A plug-in is an
object or a module. Whatever a broken one raises becomes a PluginError that names it.
"""

import re
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from enum import IntEnum
from functools import cache
from importlib.metadata import EntryPoint, EntryPoints, entry_points
from typing import Protocol, cast

from regscribe.draft import Draft
from regscribe.losses import Exported
from regscribe.model import RegisterMap
from regscribe.visible import safe

EXPORTERS, IMPORTERS = "regscribe.exporters", "regscribe.importers"
KINDS = {EXPORTERS: "exporter", IMPORTERS: "importer"}

OPTION = re.compile(r"(?!(format|out|help|as|strict|report|report-to|merge|mapping|save-mapping)$)[a-z][a-z0-9-]*")
"""Names that an option may have; those left out are options of `regscribe export` and `import` themselves."""

MOST_TEXT = 300
"""Most characters of a plug-in's error that are shown."""


class PluginError(Exception):
    """A plug-in is missing, doubled or broken; the message names it and its distribution."""


class OptionError(Exception):
    """Raised by exporters for options that ask the impossible; the message names the option and what to write."""


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

    def export(self, maps: Sequence[RegisterMap], options: Mapping[str, str]) -> Exported | dict[str, str]:
        """Return texts by path below the folder --out, with `/` between its parts; "" is the one text of the format.

        With what the format cannot say, as `Exported`. Raises OptionError.
        """
        ...


class Likeness(IntEnum):
    """Whether a file is of an importer's form: it is not, it may be (a table is one of many things), it surely is."""

    NO = 0
    PERHAPS = 1
    SURE = 2


class Importer(Protocol):
    """A file of another form to a map: an entry point of the group `regscribe.importers`."""

    name: str
    summary: str
    options: tuple[Option, ...]

    def likeness(self, data: bytes, name: str) -> Likeness:
        """Whether the bytes of the file `name` are of this form; told by a look at them, not by reading all."""
        ...

    def read(self, data: bytes, name: str, options: Mapping[str, str]) -> Draft:
        """Return the map that the file `name` says, with what became of each of its rows. Raises OptionError."""
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


def export(name: str, maps: Sequence[RegisterMap], options: Mapping[str, str]) -> Exported:
    """Return what an exporter makes of the maps. Raises PluginError and OptionError."""
    loaded = exporter(name)
    with guarded(EXPORTERS, name):
        result: object = loaded.export(maps, options)
        made = result if isinstance(result, Exported) else Exported(cast("dict[str, str | bytes]", result))
        if not _is_content(made.texts):
            message = "it returns no dict of texts"
            raise TypeError(message)
        "".join(text for text in made.texts.values() if isinstance(text, str)).encode()  # raises for what no file holds
        return made


def _is_content(texts: object) -> bool:
    return isinstance(texts, dict) and all(
        isinstance(path, str) and isinstance(text, str | bytes) for path, text in texts.items()
    )


def recognise(data: bytes, file: str) -> tuple[str, ...]:
    """The names of the importers whose form the bytes of a file are most likely of. Raises PluginError."""
    found: dict[str, Likeness] = {}
    for name in names(IMPORTERS):
        with suppress(PluginError):  # a broken plug-in disturbs nobody who did not ask for it
            loaded = importer(name)
            with guarded(IMPORTERS, name):
                found[name] = Likeness(loaded.likeness(data, file))
    most = max(found.values(), default=Likeness.NO)
    return tuple(name for name, one in found.items() if one is most and most is not Likeness.NO)


def read(name: str, data: bytes, file: str, options: Mapping[str, str]) -> Draft:
    """Return what an importer makes of the bytes of a file. Raises PluginError and OptionError."""
    loaded = importer(name)
    with guarded(IMPORTERS, name):
        draft: object = loaded.read(data, file, options)
        if not isinstance(draft, Draft):
            message = "it returns no Draft"
            raise TypeError(message)
        return draft


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
        return _declared(entry_points, group, tuple(sys.path))
    except Exception as error:
        message = safe(f"the entry points of some installed package cannot be read: {error}"[:MOST_TEXT])
        raise PluginError(message) from error


@cache
def _declared(read: Callable[..., EntryPoints], group: str, _path: tuple[str, ...]) -> tuple[EntryPoint, ...]:
    """Read once for each path of Python: it takes 10 ms, and every plug-in is asked for by itself."""
    return tuple(read(group=group))


def _load(group: str, name: str) -> object:
    found = [one for one in _found(group) if one.name == name]
    if not found:
        message = f"there is no {KINDS[group]} {name}; there are {', '.join(names(group))}"
        raise PluginError(safe(message))
    if len(found) > 1:
        owners = " and ".join(sorted(map(_owner, found)))
        message = f"{len(found)} plug-ins call themselves the {KINDS[group]} {name}, of {owners}: uninstall all but one"
        raise PluginError(safe(message))
    with guarded(group, name):
        loaded = found[0].load()
        if fault := _fault(loaded, group, name):
            raise TypeError(fault)
    return loaded


def _owner(found: EntryPoint) -> str:
    return f"{found.dist.name} {found.dist.version}" if found.dist else "nobody"


def _fault(loaded: object, group: str, name: str) -> str:
    """The member that an object lacks to be a plug-in of its group; empty if none."""
    if getattr(loaded, "name", None) != name or not isinstance(getattr(loaded, "summary", None), str):
        return f"it has no name `{name}` with a summary"
    for method in ("export",) if group == EXPORTERS else ("read", "likeness"):
        if not callable(getattr(loaded, method, None)):
            return f"it has no function `{method}`"
    options = getattr(loaded, "options", None)
    if isinstance(options, tuple) and all(isinstance(one, Option) and OPTION.fullmatch(one.name) for one in options):
        return ""
    return "its options are no tuple of Option with names in lower case"
