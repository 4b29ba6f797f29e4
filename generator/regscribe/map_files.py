"""Finds the files of maps and libraries by id: in the folder `maps/` here, then among those of regscribe itself."""

import os
import re
from collections.abc import Iterable
from pathlib import Path

import regscribe

MAP, LIBRARY = "map", "library"
ENDINGS = {MAP: ".yaml", LIBRARY: ".library.yaml"}
"""Endings of file names by kind; the kind is also the top-level key of the file."""

IMPORT, IMPORT_ENDING = "import", ".import.yaml"
"""The kind of file beside a map that says how a vendor's list is imported into it, and the ending of its name."""

LOCAL = Path("maps")
"""The folder of maps that is searched first, in the working directory."""

ID = re.compile(r"[\w-]+(/[\w-]+)+")
"""The form of a map's id: names with slashes in between, no `..`."""


def data_folder(name: str) -> Path:
    """Return a folder that comes with regscribe: in the wheel, else that of the source checkout."""
    package = Path(regscribe.__file__).parent
    wheel = package / "data" / name
    return wheel if wheel.is_dir() else package.parents[1] / name


def shipped() -> Path:
    """Return the folder of the maps that come with regscribe."""
    return data_folder("maps")


def is_file(path: Path | str) -> bool:
    """Whether there is a file; False, not an error, for a name that is too long or a folder that may not be read."""
    return os.path.isfile(path)  # noqa: PTH113 - Path.is_file raises for these


def file_of(map_id: str, kinds: Iterable[str] = (MAP,)) -> Path | None:
    """Return the file of an id in `maps/` here, else among those shipped; None if there is none."""
    paths = [folder / f"{map_id}{ENDINGS[kind]}" for folder in (LOCAL, shipped()) for kind in kinds]
    return next(filter(is_file, paths), None) if ID.fullmatch(map_id) else None


def ids_in(folders: Iterable[Path], kind: str = MAP) -> list[str]:
    """Return the ids of all files of a kind in these folders, by folder and id."""
    names = [path.relative_to(folder).as_posix() for folder in folders for path in sorted(folder.glob("*/*.yaml"))]
    return [name.removesuffix(ENDINGS[kind]) for name in names if kind_of(name) == kind]


def files_below(folder: Path, kinds: Iterable[str] = (MAP,)) -> list[Path]:
    """Return all *.yaml of these kinds below `folder`, sorted; hidden folders and links to folders are left alone."""
    maps: list[Path] = []
    for root, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith(".")]
        maps += [Path(root, name) for name in names if name.endswith(ENDINGS[MAP]) and not name.startswith(".")]
    return sorted(path for path in maps if kind_of(path.name) in kinds)


def kind_of(file: str) -> str:
    """Return the kind of a YAML file, by the ending of its name."""
    if file.endswith(IMPORT_ENDING):
        return IMPORT
    return LIBRARY if file.endswith(ENDINGS[LIBRARY]) else MAP


def folder_of(path: Path, map_id: str) -> Path:
    """Return the folder that ids count from: the one above maker/family.yaml, else the folder of the file itself."""
    parts = Path(map_id).parts
    for place in (path, path.absolute()):
        named = (*place.parts[:-1], place.name.removesuffix(ENDINGS[MAP]))
        if named[-len(parts) :] == parts and len(place.parents) >= len(parts):
            return place.parents[len(parts) - 1]
    return path.parent
