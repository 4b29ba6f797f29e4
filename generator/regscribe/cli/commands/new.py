"""`regscribe new`: start a map from a commented skeleton."""

import keyword
import re
from importlib.resources import files
from pathlib import Path
from shutil import copyfileobj
from string import Template

import click

from regscribe.cli.shared.terminal import tell
from regscribe.shipped import shipped
from regscribe.visible import safe

WORD = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")
"""A maker or a family: it becomes a folder, a file and a Python module."""

SCHEMA = "map.schema.json"


@click.command(name="new", epilog="Example: regscribe new acme/oven-3")
@click.argument("map_id", metavar="MAKER/FAMILY")
@click.option("--dir", "folder", type=click.Path(path_type=Path), default=Path("maps"), show_default=True)
def command(*, map_id: str, folder: Path) -> int:
    """Start a map: a commented skeleton that passes `regscribe check`.

    Nothing is overwritten. If there is no schema beside the folder, a copy of it is put there, so that an editor can
    complete and explain the keys.
    """
    maker, family = _parts(map_id)
    path = folder / maker / f"{family}.yaml"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("x", encoding="utf-8") as file:
            file.write(_skeleton(maker, family, schema=_schema_for(folder)))
    except FileExistsError:
        message = f"{path} exists; nothing was changed. Choose another name or edit that map"
        raise click.UsageError(message) from None
    except OSError as error:
        message = f"cannot write {path}: {error.strerror}; choose another folder with --dir"
        raise click.ClickException(message) from None
    tell(safe(f"{path} is ready to be filled in; then: regscribe check {path}") + "\n")
    return 0


def _parts(map_id: str) -> tuple[str, str]:
    parts = map_id.split("/")
    if len(parts) != 2:  # noqa: PLR2004 - maker and family
        message = f"`{map_id}` is no map id: write MAKER/FAMILY, for example acme/oven-3"
        raise click.UsageError(message)
    for part in parts:
        if not WORD.fullmatch(part) or keyword.iskeyword(part):
            message = (
                f"`{part}` in `{map_id}` becomes a Python module: write lower-case letters, digits and single "
                "hyphens, a letter first, and no keyword of Python"
            )
            raise click.UsageError(message)
    return parts[0], parts[1]


def _skeleton(maker: str, family: str, *, schema: str) -> str:
    text = files("regscribe.cli").joinpath("skeleton.yaml").read_text(encoding="utf-8")
    title = family.replace("-", " ").title()
    maker_name = maker.replace("-", " ").title()
    prefix = re.sub(r"[^A-Za-z0-9]", "", maker_name)
    return Template(text).substitute(
        id=f"{maker}/{family}", title=title, maker=maker_name, prefix=prefix, schema=schema
    )


def _schema_for(folder: Path) -> str:
    """Return the path of the schema as seen from the map; put a copy into `folder` if there is none to point to."""
    if (folder.parent / "schema" / SCHEMA).is_file():
        return f"../../schema/{SCHEMA}"
    origin = shipped().parent / "schema" / SCHEMA
    if origin.is_file() and not (folder / SCHEMA).exists():
        with origin.open("rb") as source, (folder / SCHEMA).open("xb") as target:
            copyfileobj(source, target)
    return f"../{SCHEMA}"
