"""What an import reads: the bytes of the source, a mapping, the form of the source, and the id of a map of it."""

import re
import tempfile
from collections.abc import Sequence
from pathlib import Path

from regscribe import plugins
from regscribe.cli.shared.map_heads import is_part, parts_of
from regscribe.cli.shared.output import refuse
from regscribe.cli.shared.standard_input import input_bytes, is_stdin
from regscribe.draft import Draft
from regscribe.draft.mapping import ImportMapping, load
from regscribe.model import Diagnostic
from regscribe.model.identifiers import snake
from regscribe.pipeline import compile_map
from regscribe.plugins import IMPORTERS, OptionError

MOST_BYTES = 64 * 1024 * 1024
"""Far beyond any list of registers."""


def data_of(origin: str) -> tuple[bytes, str]:
    """Return the bytes of the source and what messages call it. Raises click.UsageError."""
    try:
        if is_stdin(origin):
            data, name = input_bytes(MOST_BYTES), "stdin"
        else:
            with Path(origin).open("rb") as file:
                data, name = file.read(MOST_BYTES + 1), origin
    except (OSError, ValueError) as error:
        refuse(f"cannot read {origin}: {getattr(error, 'strerror', None) or error}")
    if len(data) > MOST_BYTES:
        refuse(f"{name} has more than {MOST_BYTES} bytes, which no list of registers has")
    return data, name


def mapping_of(path: Path | None) -> ImportMapping:
    """Return the mapping in a file, an empty one without. Raises FileError."""
    return ImportMapping() if path is None else load(path)


def check_free(path: Path | None, mapping: Path | None) -> None:
    """Raise OptionError where a new mapping would take the place of another file than the mapping itself."""
    if path is not None and path != mapping and path.exists():
        message = f"{path} exists; nothing of it was changed. Use it with --mapping, or choose another name"
        raise OptionError(message)


def recognised(data: bytes, name: str) -> str:
    """Return the form of the source. Raises OptionError where that is not sure."""
    found = plugins.recognise(data, name)
    if len(found) == 1:
        return found[0]
    known = ", ".join(plugins.names(IMPORTERS))
    if not data.strip():
        message = f"{name} is empty"
    elif found:
        message = f"{name} may be {' or '.join(found)}: say with --format which"
    else:
        message = f"nothing here reads {name}: say with --format what it is, of {known}"
    raise OptionError(message)


def id_for(draft: Draft, out: Path | None, name: str) -> str:
    """Return the id of a map that nobody named: by its path, by what the source says, or by the name of its file."""
    if out is not None and is_part(out.parent.name) and is_part(out.stem):
        return f"{out.parent.name}/{out.stem}"
    family = _part(draft.title) or _part(Path(name).stem) or "device"
    return "/".join(parts_of(f"{_part(draft.maker) or 'imported'}/{family}"))


def _part(text: str) -> str:
    found = re.sub(r"_+", "-", snake(text))[:40].strip("-")
    return found if is_part(found) else ""


def check(text: str) -> Sequence[Diagnostic]:
    """Check the text of a map that is no file yet."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "map.yaml"
        path.write_text(text, encoding="utf-8", newline="\n")
        return compile_map(path).diagnostics


def check_at(text: str, out: Path) -> Sequence[Diagnostic]:
    """Check a text in the place of a map, where it finds what it extends and uses; the map itself stays as it is."""
    with tempfile.NamedTemporaryFile("w", suffix=".yaml", prefix=".", dir=out.parent, encoding="utf-8") as file:
        file.write(text)
        file.flush()
        return compile_map(Path(file.name)).diagnostics
