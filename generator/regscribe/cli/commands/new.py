"""`regscribe new`: start a map from a commented skeleton, or from a file that an importer reads."""

import keyword
import re
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path
from shutil import copyfileobj
from string import Template

import click

from regscribe import plugins
from regscribe.cli.shared.diagnostic_text import report
from regscribe.cli.shared.output import raised_as, refuse, tell
from regscribe.map_files import data_folder
from regscribe.model import Diagnostic, Severity
from regscribe.plugins import IMPORTERS, PluginError
from regscribe.visible import safe

WORD = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*")
"""A maker or a family: it becomes a folder, a file and (with an `n` before a digit) a Python module."""

SCHEMA = "map.schema.json"

HEAD = ("# yaml-language-server:", "format:", "map:")
"""Lines of the skeleton that every map begins with."""


@click.command(
    epilog="Example: regscribe new acme/oven-3\n\n"
    "Exit code 0: done, 1: the file cannot be imported or the map not written, 2: wrong usage.",
)
@click.argument("map_id", metavar="MAKER/FAMILY")
@click.option("--dir", "folder", type=click.Path(path_type=Path), default=Path("maps"), show_default=True)
@click.option(
    "--from", "origin", type=click.Path(path_type=Path), metavar="FILE", help="Begin with what this file says."
)
@click.option("--format", "form", metavar="NAME", help="The importer that reads FILE; else by the ending of its name.")
def command(*, map_id: str, folder: Path, origin: Path | None, form: str | None) -> None:
    """Start a map: a commented skeleton that passes `regscribe check`, or with --from what a file of registers says.

    FILE is a table (.csv) in the columns of `regscribe export`, or of a form that a plug-in reads (docs/plugins.md).
    Nothing is overwritten. If there is no schema beside the folder, a copy of it is put there, so that an editor can
    complete and explain the keys.
    """
    maker, family = _parts(map_id)
    path = folder / maker / f"{family}.yaml"
    imported = _imported(origin, form)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("x", encoding="utf-8") as file:
            file.write(_text(maker, family, _schema_for(folder), imported))
    except FileExistsError:
        refuse(f"{path} exists; nothing was changed. Choose another name or edit that map")
    except OSError as error:
        message = f"cannot write {path}: {error.strerror}; choose another folder with --dir"
        raise click.ClickException(message) from None
    tell(safe(f"{path} is ready to be filled in; then: regscribe check {path}") + "\n")


def _parts(map_id: str) -> tuple[str, str]:
    parts = map_id.split("/")
    if len(parts) != 2:  # noqa: PLR2004 - maker and family
        refuse(f"`{map_id}` is no map id: write MAKER/FAMILY, for example acme/oven-3")
    for part in parts:
        if not WORD.fullmatch(part) or keyword.iskeyword(part):
            refuse(
                f"`{part}` in `{map_id}` becomes a Python module: write lower-case letters, digits and single "
                "hyphens, and no keyword of Python"
            )
    return parts[0], parts[1]


def _imported(origin: Path | None, form: str | None) -> str:
    """Return the text of a map that an importer makes of a file, empty without a file; ends the command on errors."""
    if origin is None and form is not None:
        refuse("--format says how a file is read: name the file with --from")
    if origin is None:
        return ""
    with raised_as(click.ClickException, PluginError):
        text, found = _read(origin, form or origin.suffix.removeprefix(".").lower())
    report(found, failed=any(one.severity is Severity.ERROR for one in found), nothing="nothing was written")
    return text


def _read(origin: Path, form: str) -> tuple[str, Sequence[Diagnostic]]:
    known = plugins.names(IMPORTERS)
    if form not in known:
        refuse(f"nothing imports {origin}: say with --format how, as {' or '.join(known)}")
    try:
        data = origin.read_bytes()
    except OSError as error:
        refuse(f"cannot read {origin}: {error.strerror or error}")
    return plugins.read(form, data, str(origin))


def _text(maker: str, family: str, schema: str, imported: str) -> str:
    template = Template(files("regscribe.cli").joinpath("skeleton.yaml").read_text(encoding="utf-8"))
    title, maker_name = (part.replace("-", " ").title() for part in (family, maker))
    prefix = "N" * maker_name[0].isdigit() + re.sub(r"[^A-Za-z0-9]", "", maker_name)
    skeleton = template.substitute(id=f"{maker}/{family}", title=title, maker=maker_name, prefix=prefix, schema=schema)
    head = [line for line in skeleton.splitlines(keepends=True) if line.startswith(HEAD)]
    return "".join(head) + imported if imported else skeleton


def _schema_for(folder: Path) -> str:
    """Return the path of the schema as seen from the map; put a copy into `folder` if there is none to point to."""
    if (folder.parent / "schema" / SCHEMA).is_file():
        return f"../../schema/{SCHEMA}"
    origin = data_folder("schema") / SCHEMA
    if origin.is_file() and not (folder / SCHEMA).exists():
        with origin.open("rb") as source, (folder / SCHEMA).open("xb") as target:
            copyfileobj(source, target)
    return f"../{SCHEMA}"
