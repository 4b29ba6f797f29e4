"""Finds stale files: generated files in an output directory that no map makes any more."""

import os
import re
from collections.abc import Callable, Container, Iterable, Iterator
from pathlib import Path

from regscribe.emit.header import origin_of

TEMPORARY = re.compile(r"\..*\.([0-9]{1,10})\.tmp")
"""A file beside its target, with the number of the process that writes it."""


def stale_files(targets: Container[str], folders: Iterable[str], out: Path, owned: Callable[[str], bool]) -> list[str]:
    """Return the generated files below `out` that are not in `targets`, of maps whose id `owned` accepts.

    `folders` are the folders of `out` to look into ("": the files beside them).
    """
    paths = {path.relative_to(out).as_posix(): path for folder in folders for path in _files_below(out, folder)}
    return [name for name, path in paths.items() if name not in targets and _is_stale(path, owned)]


def _files_below(out: Path, folder: str) -> Iterator[Path]:
    if not folder:
        yield from sorted(path for path in out.glob("*") if path.is_file())
        return
    for root, folders, names in os.walk(out / folder):
        folders.sort()
        yield from (Path(root, name) for name in sorted(names))


def _is_stale(path: Path, owned: Callable[[str], bool]) -> bool:
    origin = None if path.is_symlink() or _is_being_written(path) else origin_of(path)
    return origin is not None and owned(origin)


def _is_being_written(path: Path) -> bool:
    """Tell whether it is the temporary file of a process that still runs."""
    found = TEMPORARY.fullmatch(path.name)
    if found is None or os.name != "posix":
        return found is not None
    try:
        os.kill(int(found[1]), 0)  # asks whether there is such a process
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True
    return True
