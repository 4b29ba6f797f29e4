"""Compiles and renders each map of a build, several at once where there are cores for it."""

import os
import re
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from regscribe.emit import build_cache, docs_index, load_emitters, render
from regscribe.emit.build_cache import BuildRecord, Counts
from regscribe.emit.templates import Templates
from regscribe.emit.write import with_package_files
from regscribe.model import Diagnostic, RegisterMap

if TYPE_CHECKING:
    from regscribe.emit.docs_index import Card
    from regscribe.pipeline import Compiled


HEAD = 10_000
"""Bytes at the beginning of a map that are searched for `extends`."""


@dataclass(frozen=True, slots=True)
class Made:
    """A map compiled and rendered: its diagnostics; without an error the texts, and the record for the next run."""

    path: Path
    diagnostics: tuple[Diagnostic, ...]
    entry: BuildRecord | None = None
    files: dict[str, str] = field(default_factory=dict)


def make(path: Path, templates: Templates | None = None) -> Made:
    """Compile and render the map at `path`, by the user's own templates too. Raises WriteError for these."""
    compile_map, card = _load()
    compiled = compile_map(path)
    if compiled.map is None:
        return Made(path, compiled.diagnostics)
    files = render(compiled.map)
    if templates:
        files |= templates.render(compiled.map, {*with_package_files(files), docs_index.PATH})
    hashes = {name: build_cache.digest(text.encode()) for name, text in files.items()}
    sources = {build_cache.key(source): known for source, known in compiled.files}
    sources |= {build_cache.key(source): build_cache.NOTHING for source in compiled.empty}
    entry = BuildRecord(compiled.map.id, sources, hashes, counts_of(compiled.map), card(compiled.map))
    return Made(path, compiled.diagnostics, entry, files)


def _load() -> "tuple[Callable[[Path], Compiled], Callable[[RegisterMap], Card]]":
    """Import the compiler, and the function that makes a map's row of the index."""
    from regscribe.evidence.index_row import card  # noqa: PLC0415 - a build without change needs neither
    from regscribe.pipeline import compile_map  # noqa: PLC0415 - 100 ms that a build without change does not need

    return compile_map, card


def make_all(paths: Sequence[Path], templates: Templates | None = None) -> Iterator[Made]:
    """Make all maps, in their order; on several cores unless this process has threads, which a fork would cut off."""
    workers = min(len(paths), _cores())
    if workers > 1 and threading.active_count() == 1:
        return _at_once(paths, templates, workers)
    return (make(path, templates) for path in paths)


def _cores() -> int:
    """How many cores this process may use."""
    allowed = getattr(os, "sched_getaffinity", None)  # not everywhere
    return len(allowed(0)) if allowed else os.cpu_count() or 1


def _at_once(paths: Sequence[Path], templates: Templates | None, workers: int) -> Iterator[Made]:
    """Start with the costliest maps, so that none of them is left for the end; yield all in the given order."""
    from concurrent.futures import ProcessPoolExecutor  # noqa: PLC0415 - a build of one map needs neither
    from multiprocessing import get_context  # noqa: PLC0415 - as above

    context = get_context("fork" if sys.platform == "linux" else "spawn")
    load_emitters()
    _load()
    default = (signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends a worker silently: its parent reports it
    with ProcessPoolExecutor(workers, context, signal.signal, default) as pool:
        try:
            makings = {path: pool.submit(make, path, templates) for path in sorted(paths, key=_cost, reverse=True)}
            for path in paths:
                yield makings[path].result()
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def _cost(path: Path) -> tuple[bool, int]:
    """Estimate how long a map takes, for sorting: maps that extend another are the costliest, then by size."""
    try:
        if path.is_file():
            with path.open("rb") as file:
                return re.search(rb"^extends:", file.read(HEAD), re.MULTILINE) is not None, path.stat().st_size
    except (OSError, ValueError):  # compiling it reports it
        pass
    return False, 0


def counts_of(register_map: RegisterMap) -> Counts:
    """The numbers of models, registers and enums of a map."""
    registers = {register.path: register for model in register_map.models for register in model.registers}
    enums = {register.enum.id for register in registers.values() if register.enum}
    enums |= {part.enum.id for register in registers.values() for part in register.fields if part.enum}
    return Counts(len(register_map.models), len(registers), len(enums))
