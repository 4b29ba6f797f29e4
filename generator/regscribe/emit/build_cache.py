"""A record of what the last run wrote, so that an unchanged map is not compiled again.

A map is unchanged only if its own bytes, those of the files that it builds on, the whole generator and every file
written from it are; only maps without any finding are recorded, so that each run shows all warnings. The record lies
in the user's cache directory, not in the output: the output stays reproducible, and losing the record costs one full
build.
"""

import hashlib
import json
import os
import sys
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass, field
from importlib.util import find_spec
from itertools import chain
from pathlib import Path
from typing import Any

import regscribe
import regscribe_runtime
from regscribe.emit.docs_index import Card, card_of

NOTHING = ""
"""In place of a hash: there must be no file, since the map would build on it instead of another one."""

LIBRARIES = ("jinja2", "yaml", "jsonschema")
"""Another version of these may read or render something differently."""


@dataclass(frozen=True, slots=True)
class Counts:
    """Numbers of models, registers and enums of a map; each register and enum counts once, not for each model."""

    models: int = 0
    registers: int = 0
    enums: int = 0


@dataclass(frozen=True, slots=True)
class BuildRecord:
    """One map of the last run: its id, the SHA-256 of each file it was made of and of each written from it, its counts.

    Among the former are places where a file was looked for in vain (`NOTHING`). `card` is its part of the index, which
    is written anew when any map changes.
    """

    id: str
    sources: dict[str, str]
    files: dict[str, str]
    counts: Counts
    card: Card


@dataclass(frozen=True, slots=True)
class Cache:
    """The record of one output directory; entries stand under the path of the map's file."""

    out: Path
    fingerprint: str
    entries: dict[str, BuildRecord] = field(default_factory=dict)

    def unchanged(self, path: Path) -> BuildRecord | None:
        """Return the entry of the map at `path` if compiling it again would change nothing."""
        entry = self.entries.get(key(path))
        with suppress(OSError, ValueError):
            if entry is not None and same(entry.sources) and same(entry.files, self.out):
                return entry
        return None

    def save(self) -> None:
        """Keep the record for the next run; a cache that cannot be written is no error."""
        with suppress(OSError):
            write_record(_place(self.out), asdict(self) | {"out": str(self.out)})


def load(out: Path, more: Iterable[tuple[str, bytes]] = ()) -> Cache:
    """Return the record of the last run into `out`; an empty one without a sound record of this generator.

    `more` are names and contents of further inputs: templates.
    """
    empty = Cache(out, fingerprint(more))
    try:
        plain = read_record(_place(out))
        entries = {path: _entry(entry) for path, entry in plain["entries"].items()}
        return Cache(out, empty.fingerprint, entries) if plain["fingerprint"] == empty.fingerprint else empty
    except (OSError, ValueError, TypeError, KeyError, AttributeError):  # absent, cut off or of another shape
        return empty


def _entry(plain: Mapping[str, object]) -> BuildRecord:
    fields: dict[str, object] = dict(plain)
    counts = fields.pop("counts")
    files, sources = fields["files"], fields["sources"]
    if not isinstance(counts, dict) or not isinstance(files, dict) or not isinstance(sources, dict) or not sources:
        raise TypeError
    return BuildRecord(str(fields["id"]), sources, files, Counts(**counts), card_of(fields["card"]))


def read_record(place: Path) -> dict[str, Any]:
    """Return what `write_record` kept, empty if it was cut off. Raises OSError or ValueError if it cannot be read."""
    checksum, _, record = place.read_text(encoding="utf-8").partition("\n")
    plain: dict[str, Any] = json.loads(record) if checksum == digest(record.encode()) else {}
    return plain


def write_record(place: Path, plain: Mapping[str, object]) -> None:
    """Keep `plain` as JSON behind its own hash, all of it or nothing. Raises OSError."""
    place.parent.mkdir(parents=True, exist_ok=True)
    temporary = place.with_name(f"{place.name}.{os.getpid()}.tmp")
    record = json.dumps(plain)
    temporary.write_text(f"{digest(record.encode())}\n{record}", encoding="utf-8", newline="\n")
    temporary.replace(place)


def same(digests: Mapping[str, str], folder: Path = Path()) -> bool:
    """Tell whether the files below `folder` have these digests; with NOTHING, whether there is none."""
    return all(
        digest((folder / path).read_bytes()) == known if known else not os.path.lexists(folder / path)
        for path, known in digests.items()
    )


def key(path: Path) -> str:
    """Return the key of a file: its path with links unresolved, since a link may lead elsewhere next time."""
    return os.path.abspath(path)  # noqa: PTH100 - resolve() would follow links


def digest(content: bytes) -> str:
    """Return the SHA-256 in hex."""
    return hashlib.sha256(content).hexdigest()


def fingerprint(more: Iterable[tuple[str, bytes]] = ()) -> str:
    """Return a hash of all inputs beside the map: the package, the schema, Python, the libraries, `more`."""
    total = hashlib.sha256(sys.version.encode())
    for name, content in chain(_ingredients(), more):
        total.update(f"{name}\0{len(content)}\0".encode())
        total.update(content)
    return total.hexdigest()


def _ingredients() -> Iterator[tuple[str, bytes]]:
    package, runtime = (Path(str(top.__file__)).parent for top in (regscribe, regscribe_runtime))
    schema = package.parents[1] / "schema"  # of a checkout; the wheel's is in the package
    for folder in (package, runtime, schema):
        for path in sorted(_files(folder)):
            yield path.relative_to(folder).as_posix(), path.read_bytes()
    for library in LIBRARIES:
        spec = find_spec(library)  # does not import it
        if spec is not None and spec.origin is not None:
            stat = Path(spec.origin).stat()
            yield library, f"{stat.st_size} {stat.st_mtime_ns}".encode()


def _files(folder: Path) -> Iterator[Path]:
    for root, _, names in os.walk(folder):
        yield from (Path(root, name) for name in names if not name.endswith((".pyc", ".yaml")))


def folder() -> Path:
    """Return the folder in the user's cache directory that is regscribe's own."""
    usual = os.environ.get("LOCALAPPDATA") if sys.platform == "win32" else None
    home = os.environ.get("XDG_CACHE_HOME") or usual or os.path.expanduser("~/.cache")  # noqa: PTH111 - Path.expanduser raises without a home
    return Path(home, "regscribe")


def name_of(path: Path) -> str:
    """Return the name of what is kept for a file or a folder: a hash of its real path."""
    return digest(os.path.realpath(path).encode(errors="surrogateescape"))[:32]


def _place(out: Path) -> Path:
    return folder() / f"{name_of(out)}.json"
