"""Maps to simulate, by file or id: compiled once in a process, and anew when their files change."""

from pathlib import Path
from threading import Lock

from regscribe.map_files import LOCAL, file_of, ids_in, is_file, shipped
from regscribe.model import RegisterMap
from regscribe.model.nearest import nearest
from regscribe.simulate.errors import SimulatorError

SHOWN = 3
"""Mistakes of a map that a message lists."""

Stamp = tuple[tuple[str, int, int], ...]
"""The files of a map with their times and sizes: a map that is edited is compiled anew."""

_COMPILED: dict[Path, tuple[Stamp, RegisterMap]] = {}
_LOCK = Lock()


def find_map(name: str | Path | RegisterMap) -> RegisterMap:
    """Return the map of an id (`athena/series-c`) or a path; a compiled map is returned unchanged.

    Raises SimulatorError if there is none, or if it has mistakes.
    """
    if isinstance(name, RegisterMap):
        return name
    path = _path(str(name)).resolve()
    with _LOCK:
        if path in _COMPILED:
            stamp, register_map = _COMPILED[path]
            if stamp == _stamp([Path(file) for file, _, _ in stamp]):
                return register_map
        _COMPILED[path] = _compile(path)
        return _COMPILED[path][1]


def _compile(path: Path) -> tuple[Stamp, RegisterMap]:
    from regscribe.pipeline import compile_map  # noqa: PLC0415 - loads slowly, and is needed for a named map only

    compiled = compile_map(path)
    if compiled.map is None:
        found = [f"{each.span}: {each.message}" for each in compiled.diagnostics if each.severity.value == "error"]
        message = "\n".join([f"the map {path} has mistakes (see `regscribe check`):", *found[:SHOWN]])
        raise SimulatorError(message)
    return _stamp([path, *(file for file, _ in compiled.files), *compiled.empty]), compiled.map


def _stamp(files: list[Path]) -> Stamp:
    stamp = []
    for file in dict.fromkeys(files):
        try:
            status = file.stat()
            stamp.append((str(file), status.st_mtime_ns, status.st_size))
        except OSError:
            stamp.append((str(file), 0, 0))
    return tuple(stamp)


def _path(name: str) -> Path:
    found = Path(name) if is_file(name) else file_of(name)
    if found is None:
        known = sorted(set(ids_in((LOCAL, shipped()))))
        near = nearest(name, known)
        meant = f"did you mean {near!r}?" if near else f"known are {', '.join(known)}"
        message = f"there is no map {name[:200]!r}: neither a file nor a map id; {meant}"
        raise SimulatorError(message)
    return found
