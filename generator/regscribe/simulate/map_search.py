"""Maps by id: a file, one of a folder maps/ here, or one that comes with regscribe; compiled once in a process."""

import os
import re
from difflib import get_close_matches
from pathlib import Path
from threading import Lock

from regscribe.model import RegisterMap
from regscribe.shipped import shipped
from regscribe.simulate.errors import SimulatorError

LOCAL = Path("maps")
ID = re.compile(r"[\w-]+(/[\w-]+)+")
SHOWN = 3
"""Mistakes of a map that a message tells."""

Stamp = tuple[tuple[str, int, int], ...]
"""The files of a map with their times and sizes: a map that is edited is compiled anew."""

_COMPILED: dict[Path, tuple[Stamp, RegisterMap]] = {}
_LOCK = Lock()


def find_map(name: str | Path | RegisterMap) -> RegisterMap:
    """Return the map of an id (`athena/series-c`) or a path; a map as it is.

    Raises SimulatorError if there is none, or if it has mistakes.
    """
    if isinstance(name, RegisterMap):
        return name
    path = _path(str(name)).resolve()
    with _LOCK:
        known = _COMPILED.get(path)
        if known is not None and _stamp([Path(file) for file, _, _ in known[0]]) == known[0]:
            return known[1]
        stamp, register_map = _compile(path)
        _COMPILED[path] = stamp, register_map
        return register_map


def _compile(path: Path) -> tuple[Stamp, RegisterMap]:
    from regscribe.pipeline import compile_map  # noqa: PLC0415 - only who names a map waits for the compiler

    compiled = compile_map(path)
    if compiled.map is None:
        found = [f"{each.span}: {each.message}" for each in compiled.diagnostics if each.severity.value == "error"]
        message = "\n".join([f"the map {path} has mistakes (see `regscribe check`):", *found[:SHOWN]])
        raise SimulatorError(message)
    return _stamp([path, *(file for file, _ in compiled.files), *compiled.empty]), compiled.map


def _stamp(files: list[Path]) -> Stamp:
    found = []
    for file in dict.fromkeys(files):
        try:
            status = file.stat()
        except OSError:
            found.append((str(file), 0, 0))
        else:
            found.append((str(file), status.st_mtime_ns, status.st_size))
    return tuple(found)


def _path(name: str) -> Path:
    if os.path.isfile(name):  # noqa: PTH113 - Path.is_file raises for names that are too long
        return Path(name)
    folders = (LOCAL, shipped())
    for folder in folders if ID.fullmatch(name) else ():
        file = folder / f"{name}.yaml"
        if os.path.isfile(file):  # noqa: PTH113 - as above
            return file
    known = sorted({_id(file, folder) for folder in folders for file in folder.glob("*/*.yaml")})
    near = get_close_matches(name, known, n=1)
    meant = f"did you mean {near[0]!r}?" if near else f"known are {', '.join(known)}"
    message = f"there is no map {name[:200]!r}: neither a file nor a map id; {meant}"
    raise SimulatorError(message)


def _id(file: Path, folder: Path) -> str:
    return file.relative_to(folder).with_suffix("").as_posix().removesuffix(".library")
