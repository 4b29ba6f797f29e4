"""Which map files an argument names: a file, a folder of them, or an id looked up in maps/ and among those shipped."""

import os
import re
from collections.abc import Iterable, Sequence
from difflib import get_close_matches
from pathlib import Path

import click

from regscribe.shipped import shipped

ID = re.compile(r"[\w-]+(/[\w-]+)+")
"""What may be the id of a map: names, and no step upwards."""

LIBRARY = ".library.yaml"
"""How the file of a library ends."""

LOCAL = Path("maps")
"""Where maps are looked for when no argument names one."""


def find_maps(arguments: Sequence[str], *, libraries: bool = False) -> list[Path]:
    """Return the files that the arguments name, each once, in a stable order; without arguments all of maps/.

    Files that only hold names for maps are among them with `libraries`. Raises click.UsageError for what is neither a
    file, a folder with maps, nor the id of a map, and for a library where none is asked for.
    """
    if not arguments and not LOCAL.is_dir():
        message = "there is no folder maps/ here: name a map file, a folder or a map id"
        raise click.UsageError(message)
    found = (path for argument in arguments or [str(LOCAL)] for path in _maps_of(argument, libraries=libraries))
    return list({os.path.realpath(path): path for path in found}.values())


def find_map(argument: str) -> Path:
    """Return the one file that the argument names. Raises click.UsageError if that is none or a folder."""
    if argument and os.path.isdir(argument):  # noqa: PTH112 - Path.is_dir raises for names that are too long
        message = f"{argument} is a folder: name one map in it"
        raise click.UsageError(message)
    return _maps_of(argument)[0]


def _maps_of(argument: str, *, libraries: bool = False) -> list[Path]:
    path = Path(argument)
    if argument and os.path.isdir(argument):  # noqa: PTH112 - as above
        return _maps_below(path, libraries=libraries)
    if argument.endswith(LIBRARY) and not libraries:
        message = f"{argument} is a library: nothing is made of it alone, name a map that uses it"
        raise click.UsageError(message)
    if argument and os.path.exists(argument):  # noqa: PTH110 - as above
        return [path]
    for folder in (LOCAL, shipped()):
        for ending in (".yaml", LIBRARY) if libraries else (".yaml",):
            by_id = f"{folder / argument}{ending}"
            if ID.fullmatch(argument) and os.path.isfile(by_id):  # noqa: PTH113 - as above
                return [Path(by_id)]
    message = f"there is no map `{argument[:200]}`: neither a file nor a map id{_meant(argument)}"
    raise click.UsageError(message)


def _maps_below(folder: Path, *, libraries: bool) -> list[Path]:
    """All *.yaml below `folder`, sorted; hidden folders and links to folders are left alone."""
    maps: list[Path] = []
    for root, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith(".")]
        shown = [name for name in names if name.endswith(".yaml") and not name.startswith(".")]
        maps += [Path(root, name) for name in shown if libraries or not name.endswith(LIBRARY)]
    if not maps:
        message = f"there is no map (*.yaml) in the folder {folder}"
        raise click.UsageError(message)
    return sorted(maps)


def _meant(argument: str) -> str:
    near = get_close_matches(argument, sorted(_known()), n=1)
    return f"; did you mean `{near[0]}`?" if near else ""


def _known() -> Iterable[str]:
    for folder in (LOCAL, shipped()):
        for path in (each for each in folder.glob("*/*.yaml") if not each.name.endswith(LIBRARY)):
            yield path.relative_to(folder).with_suffix("").as_posix()
            yield str(path)
