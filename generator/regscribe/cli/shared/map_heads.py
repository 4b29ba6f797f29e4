"""The head of a new map: its id, what it is called, and where the schema lies that explains its keys to an editor."""

import keyword
import re
from importlib.resources import files
from pathlib import Path
from shutil import copyfileobj
from string import Template

from regscribe.cli.shared.output import refuse
from regscribe.map_files import data_folder
from regscribe.map_format import formatted
from regscribe.source import parse

WORD = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*")
"""A maker or a family: it becomes a folder, a file and (with an `n` before a digit) a Python module."""

SCHEMA = "map.schema.json"


def parts_of(map_id: str) -> tuple[str, str]:
    """Return maker and family. Raises click.UsageError for what is no id of a map."""
    parts = map_id.split("/")
    if len(parts) != 2:  # noqa: PLR2004 - maker and family
        refuse(f"`{map_id}` is no map id: write MAKER/FAMILY, for example acme/oven-3")
    for part in parts:
        if not is_part(part):
            refuse(
                f"`{part}` in `{map_id}` becomes a Python module: write lower-case letters, digits and single "
                "hyphens, and no keyword of Python"
            )
    return parts[0], parts[1]


def is_part(text: str) -> bool:
    """Whether a text can be a maker or a family."""
    return bool(WORD.fullmatch(text)) and not keyword.iskeyword(text)


def head_of(map_id: str, *, title: str = "", maker: str = "") -> dict[str, object]:
    """Return the keys `format` and `map` of a map of this id."""
    first, family = parts_of(map_id)
    named = maker or first.replace("-", " ").title()
    plain = re.sub(r"[^A-Za-z0-9]", "", first.replace("-", " ").title())
    prefix = "N" * plain[0].isdigit() + plain
    return {
        "format": 1,
        "map": {
            "id": map_id,
            "title": title or family.replace("-", " ").title(),
            "maker": named,
            "class_prefix": prefix,
        },
    }


def skeleton(map_id: str, schema: str) -> str:
    """Return the commented skeleton of a map, which refers to the schema at this path."""
    template = Template(files("regscribe.cli").joinpath("skeleton.yaml").read_text(encoding="utf-8"))
    names = head_of(map_id)["map"]
    assert isinstance(names, dict)  # noqa: S101 - tells the type checker what head_of makes
    text = template.substitute(
        id=map_id, title=names["title"], maker=names["maker"], prefix=names["class_prefix"], schema=schema
    )
    document, _ = parse(text, name=map_id)
    return formatted(document) if document else text


def schema_for(folder: Path) -> str:
    """Return the path of the schema as seen from a map in `folder`/maker; put a copy there if there is none."""
    if (folder.parent / "schema" / SCHEMA).is_file():
        return f"../../schema/{SCHEMA}"
    origin = data_folder("schema") / SCHEMA
    if origin.is_file() and not (folder / SCHEMA).exists():
        with origin.open("rb") as source, (folder / SCHEMA).open("xb") as target:
            copyfileobj(source, target)
    return f"../{SCHEMA}"
