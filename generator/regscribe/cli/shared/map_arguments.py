"""Which map files the arguments of a command name: a file, a folder of them, or the id of a map."""

import os
from collections.abc import Iterable, Sequence
from pathlib import Path

from regscribe.cli.shared.output import refuse
from regscribe.cli.shared.standard_input import is_stdin
from regscribe.map_files import ENDINGS, IMPORT, LIBRARY, LOCAL, MAP, file_of, files_below, ids_in, kind_of, shipped
from regscribe.model.nearest import nearest


def find_maps(arguments: Sequence[str], *, libraries: bool = False) -> list[Path]:
    """Return the files that the arguments name, each once, in a stable order; without arguments all of maps/.

    `-` is standard input, and stays `-`. Libraries are among them if `libraries` is set. Raises click.UsageError for
    what is neither a file, a folder with maps, nor the id of a map, and for a library where none is asked for.
    """
    if not arguments and not LOCAL.is_dir():
        refuse("there is no folder maps/ here: name a map file, a folder or a map id")
    kinds = (MAP, LIBRARY) if libraries else (MAP,)
    found: list[Path] = []
    for argument in arguments or [str(LOCAL)]:
        found += _files_below(Path(argument), kinds) if _is_folder(argument) else [_file_of(argument, kinds)]
    return list({os.path.realpath(path): path for path in found}.values())


def find_map(argument: str) -> Path:
    """Return the one file that the argument names. Raises click.UsageError if that is none or a folder."""
    if _is_folder(argument):
        refuse(f"{argument} is a folder: name one map in it")
    return _file_of(argument, (MAP,))


def _is_folder(argument: str) -> bool:
    return bool(argument) and os.path.isdir(argument)  # noqa: PTH112 - Path.is_dir raises for names that are too long


def _file_of(argument: str, kinds: Sequence[str]) -> Path:
    if is_stdin(argument):
        return Path(argument)
    if kind_of(argument) == IMPORT:
        refuse(f"{argument} is the mapping of an import and no map: name the map")
    if kind_of(argument) not in kinds:
        refuse(f"{argument} is a library: nothing is made of it alone, name a map that uses it")
    if argument and os.path.exists(argument):  # noqa: PTH110 - as above
        return Path(argument)
    found = file_of(argument, kinds)
    if found is None:
        known: list[str] = []
        for folder in (LOCAL, shipped()):
            ids = ids_in([folder])
            known += [*ids, *(f"{folder / map_id}{ENDINGS[MAP]}" for map_id in ids)]
        meant = did_you_mean(argument, sorted(known))
        refuse(f"there is no map `{argument[:200]}`: neither a file nor a map id{meant}")
    return found


def _files_below(folder: Path, kinds: Sequence[str]) -> list[Path]:
    """All maps below `folder`; UsageError if there is none."""
    found = files_below(folder, kinds)
    if not found:
        refuse(f"there is no map (*.yaml) in the folder {folder}")
    return found


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """The end of a message about an unknown name: `; did you mean `x`?`, or nothing."""
    meant = nearest(name, known)
    return f"; did you mean `{meant}`?" if meant else ""
