"""`regscribe generate`: compile maps to drivers, docs, vectors and tests."""

import shlex
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter

import click

from regscribe.cli.shared.completion_values import complete_map
from regscribe.cli.shared.diagnostic_text import count, report
from regscribe.cli.shared.failure import unwritten
from regscribe.cli.shared.map_arguments import find_maps
from regscribe.cli.shared.map_builds import Made, make_all
from regscribe.cli.shared.output import detail, raised_as, refuse, tell, tell_done
from regscribe.cli.shared.standard_input import is_stdin
from regscribe.emit import build_cache
from regscribe.emit.build_cache import BuildRecord
from regscribe.emit.docs_index import render_index
from regscribe.emit.header import origin_of
from regscribe.emit.templates import Templates
from regscribe.emit.write import Report, UnwrittenFilesError, WriteError, write
from regscribe.model import Diagnostic
from regscribe.visible import safe_lines


@dataclass(slots=True)
class Build:
    """One run: the record of each map, the texts to write, and the maps that have warnings."""

    templates: Templates | None = None
    entries: dict[Path, BuildRecord] = field(default_factory=dict)
    rendered: dict[str, str] = field(default_factory=dict)
    diagnostics: list[Diagnostic] = field(default_factory=list)
    noisy: set[Path] = field(default_factory=set)
    failed: bool = False

    def take(self, made: Made) -> None:
        """Add a map that was compiled and rendered."""
        self.diagnostics += made.diagnostics
        if made.entry is None:
            self.failed = True
            return
        self.rendered |= made.files
        self.entries[made.path] = made.entry
        if made.diagnostics:
            self.noisy.add(made.path)


@click.command(
    epilog="Example: regscribe generate maps/acme/oven.yaml --out build/\n\n"
    "Exit code 0: done, 1: errors in a map, or with --check a difference, 2: wrong usage.",
)
@click.argument("maps", nargs=-1, metavar="[MAP]...", shell_complete=complete_map)
@click.option("--check", is_flag=True, help="Write nothing; show what would change and exit 1 if anything would.")
@click.option("--out", type=click.Path(path_type=Path), default=Path("generated"), show_default=True, metavar="DIR")
@click.option(
    "--templates",
    "folder",
    type=click.Path(path_type=Path, exists=True, file_okay=False),
    metavar="DIR",
    help="Templates of your own: each *.j2 below DIR is rendered for every map (docs/templates.md).",
)
@click.option(
    "--project",
    metavar="NAME",
    help="Write DIR/pyproject.toml, with which pip installs the drivers as NAME, unless there is one.",
)
def command(*, maps: tuple[str, ...], check: bool, out: Path, folder: Path | None, project: str | None) -> int:
    """Compile maps to typed drivers, reference docs, test vectors and tests.

    MAP is a map file, a folder that is searched for *.yaml, or the id of a map (fdc/series-100). Without MAP all of
    maps/ is compiled, and files generated from maps that are gone are removed.

    Nothing is written unless every map is free of errors; only files that differ are written. The index of the
    reference docs, with the coverage of each map, is left as it is by a run that leaves out maps which have references.
    """
    started = perf_counter()
    if project is not None:
        _check_project(project, check=check)
    paths = find_maps(maps)
    templates = Templates(folder) if folder else None
    if templates and not templates.names:
        refuse(f"--templates {folder}: there is no template (*.j2) in this folder")
    known = build_cache.Cache(out, "") if check else build_cache.load(out, templates.contents() if templates else ())
    with raised_as(click.ClickException, WriteError), unwritten(UnwrittenFilesError):
        build = _build(paths, known, templates)
        report(build.diagnostics, failed=build.failed, nothing="nothing was written")
        written = _write(build, out, check=check, whole=not maps)
    if not check:
        _remember(build, known, whole=not maps)
    tell(safe_lines(written.diff))
    tell_done(safe_lines(_summary(build, written, out, seconds=perf_counter() - started, check=check)))
    if project is not None:
        _start_project(project, out)
    return int(check and bool(written.written or written.removed))


def _check_project(name: str, *, check: bool) -> None:
    if check:
        refuse("--project writes a file, and with --check nothing is written: leave one of them out")
    from regscribe.cli.shared.project_file import check_name  # noqa: PLC0415 - yaml, which a build without change spares

    check_name(name)


def _start_project(name: str, out: Path) -> None:
    from regscribe.cli.shared.project_file import start_project  # noqa: PLC0415 - as above
    from regscribe.files import UnwrittenError  # noqa: PLC0415 - as above

    with unwritten(UnwrittenError):
        new = start_project(name, out)
    if new:
        tell_done(safe_lines(f"{out / 'pyproject.toml'} is new: pip install -e {shlex.quote(str(out))}\n"))


def _build(paths: Sequence[Path], known: build_cache.Cache, templates: Templates | None) -> Build:
    """Compile and render every map that `known` does not show to be unchanged. Raises click.UsageError for `-`."""
    if any(map(is_stdin, paths)):
        refuse("a map from standard input has no name that `generate` could put into the files: name its file")
    entries = {path: known.unchanged(path) for path in paths}
    changed = [path for path, entry in entries.items() if entry is None]
    made = dict(zip(changed, make_all(changed, templates), strict=True))
    build = Build(templates)
    for path, entry in entries.items():
        detail(f"{'compiled' if entry is None else 'unchanged'}: {path}")
        if entry is None:
            build.take(made[path])
        else:
            build.entries[path] = entry
    return build


def _write(build: Build, out: Path, *, check: bool, whole: bool) -> Report:
    """Write all texts; a run over the whole of maps/ owns all of `out`."""
    ids = {entry.id for entry in build.entries.values()}
    return write(
        build.rendered | _index(build, out, whole=whole),
        out,
        check=check,
        kept=[name for name in _makers(build) if name not in build.rendered],
        owned=lambda origin: whole or origin in ids,
    )


def _makers(build: Build) -> dict[str, Path]:
    """Return the map that makes each file; WriteError where two make one, unless it is shared and of equal content."""
    makers: dict[str, Path] = {}
    for path, entry in build.entries.items():
        for name, content in entry.files.items():
            other = build.entries[makers.setdefault(name, path)]
            if other is not entry and (other.id == entry.id or other.files[name] != content):
                message = f"{makers[name]} and {path} both make {name}: give one of them another id"
                message += ", or put {maker} and {family} into the template's path" if build.templates else ""
                raise WriteError(message)
    return makers


def _index(build: Build, out: Path, *, whole: bool) -> dict[str, str]:
    """Render the index of the reference docs, unless `out` has references of maps that are not of this run."""
    pages = () if whole else (out / "docs").rglob("*.md")
    others = {origin_of(page) for page in pages} - {entry.id for entry in build.entries.values()} - {None}
    return {} if others else render_index(entry.card for entry in build.entries.values())


def _remember(build: Build, known: build_cache.Cache, *, whole: bool) -> None:
    """Record the maps of this run; those with warnings are left out, so that the next run shows the warnings again."""
    if whole:
        known.entries.clear()
    for path, entry in build.entries.items():
        known.entries.pop(build_cache.key(path), None)
        if path not in build.noisy:
            known.entries[build_cache.key(path)] = entry
    known.save()


def _summary(build: Build, report: Report, out: Path, *, seconds: float, check: bool) -> str:
    all_counts = [entry.counts for entry in build.entries.values()]
    made = [
        count(len(build.entries), "map"),
        count(sum(counts.models for counts in all_counts), "model"),
        count(sum(counts.registers for counts in all_counts), "register"),
        count(sum(counts.enums for counts in all_counts), "enum"),
    ]
    files = count(len(report.written) + len(report.unchanged), "file")
    verbs = ("to write", "to remove") if check else ("written", "removed")
    done = f"{len(report.written)} {verbs[0]}, {len(report.unchanged)} unchanged, {len(report.removed)} {verbs[1]}"
    return f"{', '.join(made)}; {files} in {out}: {done}; {seconds:.2f} s\n"
