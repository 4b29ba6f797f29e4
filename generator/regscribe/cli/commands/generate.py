"""`regscribe generate`: compile maps to drivers, docs, vectors and tests."""

import sys
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter

import click

from regscribe.cli.shared.diagnostic_text import count, findings, tally
from regscribe.cli.shared.map_by_id import find_maps
from regscribe.cli.shared.terminal import show, tell, warn
from regscribe.emit import build_cache, docs_index, render
from regscribe.emit.build_cache import BuildRecord, Counts
from regscribe.emit.templates import Templates
from regscribe.emit.write import Report, WriteError, origin_of, with_package_files, write
from regscribe.model import Diagnostic, RegisterMap
from regscribe.visible import safe_lines


@dataclass(slots=True)
class Build:
    """One run: what is known of each map, the texts to write, and the maps that have warnings."""

    templates: Templates | None = None
    entries: dict[Path, BuildRecord] = field(default_factory=dict)
    rendered: dict[str, str] = field(default_factory=dict)
    diagnostics: list[Diagnostic] = field(default_factory=list)
    noisy: set[Path] = field(default_factory=set)
    failed: bool = False


@click.command(
    name="generate",
    epilog="Example: regscribe generate maps/acme/oven.yaml --out build/\n\n"
    "Exit code 0: done, 1: errors in a map, or with --check a difference, 2: wrong usage.",
)
@click.argument("maps", nargs=-1, metavar="[MAP]...")
@click.option("--check", is_flag=True, help="Write nothing; show what would change and exit 1 if anything would.")
@click.option("--out", type=click.Path(path_type=Path), default=Path("generated"), show_default=True, metavar="DIR")
@click.option(
    "--templates",
    "folder",
    type=click.Path(path_type=Path, exists=True, file_okay=False),
    metavar="DIR",
    help="Templates of your own: each *.j2 below DIR is rendered for every map (docs/templates.md).",
)
def command(*, maps: tuple[str, ...], check: bool, out: Path, folder: Path | None) -> int:
    """Compile maps to typed drivers, reference docs, test vectors and tests.

    MAP is a map file, a folder that is searched for *.yaml, or the id of a map (fdc/series-100). Without MAP all of
    maps/ is compiled, and files generated from maps that are gone are removed.

    Nothing is written unless every map is free of errors; only files that differ are written. The index of the
    reference docs, with the coverage of each map, is left as it is by a run that leaves out maps which have references.
    """
    started = perf_counter()
    paths = find_maps(maps)
    templates = _templates(folder)
    known = build_cache.Cache(out, "") if check else build_cache.load(out, templates.contents() if templates else ())
    try:
        build = _build(paths, known, templates)
    except WriteError as error:
        raise click.ClickException(str(error)) from None
    show(findings(build.diagnostics), stream=sys.stderr)
    if build.failed:
        warn(f"nothing was written: {tally(build.diagnostics)}\n")
        return 1
    try:
        report = _write(build, out, check=check, whole=not maps)
    except WriteError as error:
        raise click.ClickException(str(error)) from None
    if not check:
        _remember(build, known, whole=not maps)
    tell(safe_lines(report.diff))
    tell(safe_lines(_summary(build, report, out, seconds=perf_counter() - started, check=check)))
    return int(check and bool(report.written or report.removed))


def _templates(folder: Path | None) -> Templates | None:
    templates = Templates(folder) if folder else None
    if templates and not templates.names:
        message = f"--templates {folder}: there is no template (*.j2) in this folder"
        raise click.UsageError(message)
    return templates


def _build(paths: Iterable[Path], known: build_cache.Cache, templates: Templates | None) -> Build:
    """Compile and render every map that `known` does not show to be unchanged."""
    build = Build(templates)
    for path in paths:
        entry = known.unchanged(path)
        if entry is None:
            _compile(path, build)
        else:
            build.entries[path] = entry
    return build


def _compile(path: Path, build: Build) -> None:
    from regscribe.evidence.index_row import card  # noqa: PLC0415 - a build without change needs neither
    from regscribe.pipeline import compile_map  # noqa: PLC0415 - 150 ms that a build without change does not need

    compiled = compile_map(path)
    build.diagnostics += compiled.diagnostics
    build.failed |= compiled.map is None
    if compiled.map is None or build.failed:
        return
    files = render(compiled.map)
    if build.templates:
        files |= build.templates.render(compiled.map, {*with_package_files(files), docs_index.PATH})
    build.rendered |= files
    hashes = {name: build_cache.digest(text.encode()) for name, text in files.items()}
    counts = _counts(compiled.map)
    sources = {build_cache.key(source): known for source, known in compiled.files}
    sources |= {build_cache.key(source): build_cache.NOTHING for source in compiled.empty}
    build.entries[path] = BuildRecord(compiled.map.id, sources, hashes, counts, card(compiled.map))
    if compiled.diagnostics:
        build.noisy.add(path)


def _counts(register_map: RegisterMap) -> Counts:
    registers = {register.path: register for model in register_map.models for register in model.registers}
    enums = {register.enum.id for register in registers.values() if register.enum}
    enums |= {part.enum.id for register in registers.values() for part in register.fields if part.enum}
    return Counts(len(register_map.models), len(registers), len(enums))


def _write(build: Build, out: Path, *, check: bool, whole: bool) -> Report:
    """Write what was rendered, unless two maps claim one file; a run over the whole of maps/ owns all of `out`.

    What maps share, such as the module of a library or of a base, each of them makes with the same content.
    """
    makers: dict[str, Path] = {}
    for path, entry in build.entries.items():
        for name, content in entry.files.items():
            other = build.entries[makers.setdefault(name, path)]
            if other is not entry and (other.id == entry.id or other.files[name] != content):
                message = f"{makers[name]} and {path} both make {name}: give one of them another id"
                message += ", or put {maker} and {family} into the template's path" if build.templates else ""
                raise WriteError(message)
    ids = {entry.id for entry in build.entries.values()}
    return write(
        build.rendered | _index(build, out, whole=whole),
        out,
        check=check,
        kept=[name for name in makers if name not in build.rendered],
        owned=lambda origin: whole or origin in ids,
    )


def _index(build: Build, out: Path, *, whole: bool) -> dict[str, str]:
    """Render the index, unless there are references of maps that are not of this run: then theirs is left as it is."""
    pages = () if whole else (out / "docs").rglob("*.md")
    others = {origin_of(page) for page in pages} - {entry.id for entry in build.entries.values()} - {None}
    return {} if others else docs_index.render_index(entry.card for entry in build.entries.values())


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
