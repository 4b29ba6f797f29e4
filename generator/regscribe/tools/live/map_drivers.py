"""Drivers of maps that none were generated for: made when one is asked for, and kept in the user's cache directory.

What is kept counts as long as the map, what it builds on, and regscribe are the same.
"""

import atexit
import importlib
import re
import shutil
import sys
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from functools import cache
from pathlib import Path
from types import ModuleType

from regscribe.model import Diagnostic, RegisterMap
from regscribe.tools.live.errors import TargetError

_ORIGINS: dict[str, Path] = {}
"""The map of each package that was imported here, by the package's name."""

_FAILED: dict[tuple[Path, bytes], "MapError"] = {}
"""The errors of maps by path and text: a command asks several times."""

RECORD = "record.json"

_IMPORT = re.compile(r"^from (regscribe_devices[\w.]*) import ", re.MULTILINE)


class MapError(TargetError):
    """The map at `path` has errors, so it has no drivers; `diagnostics` tell them as `regscribe check` would."""

    def __init__(self, path: Path, diagnostics: Sequence[Diagnostic]) -> None:
        self.path, self.diagnostics = path, tuple(diagnostics)
        first = next((one for one in diagnostics if one.severity.value == "error"), None)
        super().__init__(f"the map {path} has errors: {f'{first.span}: {first.message}' if first else 'see `check`'}")


def package_of(path: Path) -> ModuleType:
    """The package of the drivers of the map at `path`; MapError if the map has errors."""
    from regscribe.emit import build_cache  # noqa: PLC0415 - hashing, which only a map without drivers needs

    place = build_cache.folder().absolute() / "drivers" / build_cache.name_of(path)
    name = _kept(place)
    if not name:
        text = path.read_bytes()
        if (path, text) in _FAILED:
            raise _FAILED[path, text]
        try:
            name = _make(path, place)
        except MapError as error:
            _FAILED[path, text] = error
            raise
    return _imported(name, path)


def origin_of(driver: type) -> Path | None:
    """The map that a driver was made of here; None for one of a generated package."""
    return _ORIGINS.get(driver.__module__.partition(".")[0])


@cache
def _fingerprint() -> str:
    from regscribe.emit import build_cache  # noqa: PLC0415 - as above

    return build_cache.fingerprint()


def _kept(place: Path) -> str:
    """The name of the package that is kept at `place`, importable from now on; empty if it does not count any more."""
    from regscribe.emit import build_cache  # noqa: PLC0415 - as above

    with suppress(OSError, ValueError, TypeError, KeyError, AttributeError):  # absent, cut off or of another shape
        record = build_cache.read_record(place / RECORD)
        name = str(record["package"])
        current = record["fingerprint"] == _fingerprint() and build_cache.same(record["sources"])
        if current and name.isidentifier() and build_cache.same(record["files"], place / name):
            _offer(name, place / name)
            return name
    return ""


def _make(path: Path, place: Path) -> str:
    """Compile a map, keep its drivers at `place`, and return the name of their package."""
    from regscribe.emit import build_cache  # noqa: PLC0415 - as above
    from regscribe.pipeline import compile_map  # noqa: PLC0415 - 200 ms that only a new or changed map needs

    compiled = compile_map(path)
    if compiled.map is None:
        raise MapError(path, compiled.diagnostics)
    sources = {build_cache.key(source): known for source, known in compiled.files}
    sources |= {build_cache.key(source): build_cache.NOTHING for source in compiled.empty}
    try:
        return _keep(compiled.map, place, sources)
    except OSError:  # a home that cannot be written to
        temporary = Path(tempfile.mkdtemp(prefix="regscribe-"))
        atexit.register(shutil.rmtree, temporary, ignore_errors=True)
        return _keep(compiled.map, temporary, sources)


def _keep(register_map: RegisterMap, place: Path, sources: Mapping[str, str]) -> str:
    """Write the drivers of a map and the record of what they were made of; the name of their package. OSError."""
    from regscribe.emit import build_cache, python  # noqa: PLC0415 - as above
    from regscribe.emit.write import WriteError, with_package_files, write  # noqa: PLC0415 - as above

    files = python.render(register_map)
    contents = "".join(files.values())
    name = f"regscribe_map_{build_cache.digest(f'{place}{contents}'.encode())[:16]}"
    files = with_package_files(_inside(name, files))
    try:
        write(files, place / name)
    except WriteError as error:
        raise OSError(str(error)) from None
    hashes = {file: build_cache.digest(text.encode()) for file, text in files.items()}
    record = {"package": name, "fingerprint": _fingerprint(), "sources": sources, "files": hashes}
    build_cache.write_record(place / RECORD, record)
    _forget(one for one in place.iterdir() if one.is_dir() and one.name != name)
    _offer(name, place / name)
    return name


def _inside(package: str, files: Mapping[str, str]) -> dict[str, str]:
    """The modules as parts of `package`: they import each other from there, and all else from where it is installed."""
    own = {file.removesuffix(".py").replace("/", ".") for file in files}

    def moved(found: re.Match[str]) -> str:
        return f"from {package}.{found[1]} import " if found[1] in own else found[0]

    return {file: _IMPORT.sub(moved, text) for file, text in files.items()}


def _forget(folders: Iterable[Path]) -> None:
    """Remove what was made of earlier versions of a map."""
    for folder in folders:
        shutil.rmtree(folder, ignore_errors=True)


def _offer(name: str, folder: Path) -> None:
    """Let a package be imported from `folder`."""
    if name not in sys.modules:
        package = ModuleType(name)
        package.__path__ = [str(folder)]
        sys.modules[name] = package


def _imported(name: str, path: Path) -> ModuleType:
    importlib.invalidate_caches()  # the folder may be as old as the last look into it
    _ORIGINS[name] = path
    return importlib.import_module(f"{name}.regscribe_devices")
