"""The earlier version of maps: a file, a folder, or a commit of the repository that the maps are in."""

import os
import subprocess
import tarfile
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

from regscribe.cli.shared.output import refuse
from regscribe.files import MOST_BYTES
from regscribe.map_files import ENDINGS, LIBRARY, LOCAL, MAP, kind_of
from regscribe.visible import safe

GIT = "git:"

OF_A_HOOK = frozenset({"GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE", "GIT_PREFIX"})
"""Variables by which git tells its hooks where they run; they would hide the repository of the maps."""


@dataclass(frozen=True, slots=True)
class Earlier:
    """Files of the earlier version.

    `restricted`: only maps count that the later version has. `alone`: one map each, a pair whatever their ids are.
    Places in `folder` are shown as those of `shown`.
    """

    paths: Sequence[Path] = field(default=())
    restricted: bool = False
    alone: bool = False
    folder: str = ""
    shown: str = ""

    def name(self, file: str) -> str:
        """The name of a file as people know it: `HEAD~1:maps/acme/oven.yaml`."""
        return f"{self.shown}{file.removeprefix(self.folder)}" if self.folder and file.startswith(self.folder) else file


@contextmanager
def earlier_maps(against: str, arguments: Sequence[str], paths: Sequence[Path]) -> Iterator[Earlier]:
    """The version to hold maps against: `git:REF`, a folder of maps, or one map. Raises click.UsageError.

    `arguments` are what the user named, `paths` the maps that these are.
    """
    folders = [Path(one) for one in arguments or [str(LOCAL)] if os.path.isdir(one)]  # noqa: PTH112 (Path.is_dir raises for names that are too long)
    if against.startswith(GIT):
        with _commit(against.removeprefix(GIT), folders, paths) as earlier:
            yield earlier
    elif os.path.isdir(against):  # noqa: PTH112 (as above)
        found = maps_below(Path(against))
        if not found:
            refuse(f"--against {against}: there is no map (*.yaml) in this folder")
        yield Earlier(found, restricted=not folders)
    elif os.path.isfile(against):  # noqa: PTH113 (as above)
        if kind_of(against) == LIBRARY:
            refuse(f"{against} is a library: name a map that uses it")
        if len(paths) != 1:
            refuse(f"--against {against} is one map: name the one map to compare with it, not {len(paths)}")
        yield Earlier([Path(against)], alone=True)
    else:
        refuse(f"--against {against[:200]}: there is no such file or folder; a commit is written git:REF")


def maps_below(folder: Path) -> list[Path]:
    """All maps below a folder, sorted; hidden folders are left alone."""
    found = sorted(folder.rglob(f"*{ENDINGS[MAP]}"))
    inside = [path for path in found if not any(part.startswith(".") for part in path.relative_to(folder).parts)]
    return [path for path in inside if kind_of(path.name) == MAP]


@contextmanager
def _commit(ref: str, folders: Sequence[Path], paths: Sequence[Path]) -> Iterator[Earlier]:
    """The maps of a commit, in a folder that is there as long as the block runs."""
    if not ref or ref.startswith("-"):
        refuse(f"--against git:{ref}: write a commit, for example git:HEAD~1 or git:v1.2.0")
    start = folders[0] if folders else paths[0].parent
    top = Path(_git(start, "rev-parse", "--show-toplevel", failing=f"{start} is in no git repository"))
    commit = _git(
        top,
        *("rev-parse", "--verify", "--quiet", "--end-of-options", f"{ref}^{{commit}}"),
        failing=f"the repository {top} has no commit `{ref}` (a shallow clone lacks old ones: fetch it first)",
    )
    with tempfile.TemporaryDirectory(prefix="regscribe-") as name:
        root = Path(name).resolve()
        _extract(top, commit, root)
        found: list[Path] = []
        for folder in folders:
            found += maps_below(root / _inside(folder, top))
        named = [path for path in paths if not any(_is_below(path, folder) for folder in folders)]
        found += [there for path in named if (there := root / _inside(path, top)).is_file()]
        yield Earlier(list(dict.fromkeys(found)), folder=f"{root}/", shown=f"{ref}:")


def _is_below(path: Path, folder: Path) -> bool:
    return path.resolve().is_relative_to(folder.resolve())


def _inside(path: Path, top: Path) -> Path:
    """The path from the top of the repository."""
    whole = path.resolve()
    if not whole.is_relative_to(top.resolve()):
        refuse(f"{path} is not in the repository {top}: compare it with a file or a folder")
    return whole.relative_to(top.resolve())


def _git(folder: Path, *arguments: str, failing: str) -> str:
    """What a git command prints. Raises click.UsageError with `failing` where it fails."""
    try:
        command = ["git", "-C", str(folder), *arguments]
        done = subprocess.run(command, capture_output=True, check=False, env=_surroundings())  # noqa: S603 (the user's own git, without a shell)
    except OSError as error:
        refuse(f"git cannot be run ({error.strerror}): compare with a file or a folder")
    if done.returncode:
        said = safe(done.stderr.decode(errors="replace").strip()[:200])
        refuse(f"{failing}{f': {said}' if said else ''}")
    return os.fsdecode(done.stdout).rstrip("\n")


def _surroundings() -> dict[str, str]:
    """The environment of git, as it is outside of hooks."""
    return {name: value for name, value in os.environ.items() if name not in OF_A_HOOK}


def _extract(top: Path, commit: str, root: Path) -> None:
    """Write the YAML files of a commit below `root`; links and all that is no plain file are left out."""
    command = ["git", "-C", str(top), "archive", "--format=tar", commit]
    out, unheard = subprocess.PIPE, subprocess.DEVNULL
    with subprocess.Popen(command, stdout=out, stderr=unheard, env=_surroundings()) as process:  # noqa: S603 (as above)
        assert process.stdout is not None  # noqa: S101 (it is a pipe)
        try:
            with tarfile.open(fileobj=process.stdout, mode="r|") as archive:
                for member in archive:
                    _write(archive, member, root)
        except tarfile.TarError as error:
            refuse(f"git archive gave nothing that can be read: {error}")
    if process.returncode:
        refuse(f"git archive of {commit} failed with code {process.returncode}")


def _write(archive: tarfile.TarFile, member: tarfile.TarInfo, root: Path) -> None:
    name = PurePosixPath(member.name)
    wanted = member.isreg() and name.suffix == ENDINGS[MAP] and member.size <= MOST_BYTES
    if not wanted or name.is_absolute() or ".." in name.parts:
        return
    data = archive.extractfile(member)
    if data is not None:
        path = root.joinpath(*name.parts)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data.read())
