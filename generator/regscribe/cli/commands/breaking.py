"""`regscribe breaking`: what changed between two versions of maps, and what it breaks."""

import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import click

from regscribe.breaking import RULES, report
from regscribe.breaking.change import Change, Level, Verdict, verdict_of
from regscribe.breaking.compare import Comparison, compare
from regscribe.checks import NOTHING_WAIVED
from regscribe.cli.shared.changes_text import as_json, as_text
from regscribe.cli.shared.ci_formats import as_concise, as_gitlab, as_junit
from regscribe.cli.shared.compiled_maps import compiled
from regscribe.cli.shared.completion_values import complete_map
from regscribe.cli.shared.diagnostic_text import findings
from regscribe.cli.shared.earlier_maps import Earlier, earlier_maps
from regscribe.cli.shared.exit_codes import USAGE
from regscribe.cli.shared.map_arguments import find_maps
from regscribe.cli.shared.output import show, tell, warn
from regscribe.cli.shared.report_formats import as_github, as_sarif
from regscribe.model import Diagnostic, RegisterMap, Severity, Span, Waiver
from regscribe.pipeline import Compiled, compile_map
from regscribe.source import display_name

FORMS = ("text", "concise", "json", "github", "gitlab", "junit", "sarif", "markdown")

VERDICTS = [verdict.word for verdict in Verdict if verdict]


@click.command(
    epilog="Example: regscribe breaking maps/ --against git:HEAD~1 --fail-on minor\n\n"
    "Exit code 0: nothing asks for as much as --fail-on, 1: something does, 2: wrong usage, or a map with errors.",
)
@click.argument("paths", nargs=-1, metavar="[MAP]...", shell_complete=complete_map)
@click.option("--against", required=True, metavar="git:REF|FOLDER|FILE", help="The earlier version.")
@click.option(
    "--level",
    type=click.Choice([one.value for one in Level]),
    default=Level.API.value,
    show_default=True,
    help="What counts: bytes and addresses; drivers too; texts too.",
)
@click.option(
    "--fail-on",
    type=click.Choice(VERDICTS),
    default="major",
    show_default=True,
    help="The least verdict that ends with exit code 1.",
)
@click.option("--format", "form", type=click.Choice(FORMS), default="text", show_default=True)
def command(*, paths: tuple[str, ...], against: str, level: str, fail_on: str, form: str) -> int:
    """Say what changed between two versions of maps, what it breaks, and which version number it asks for.

    MAP is a map file, a folder of maps, or the id of a map (fdc/series-100). Without MAP: maps/. Versions are compared
    by what they mean; order, comments and the split into files are no change. docs/breaking.md tells more.
    """
    files, wanted = find_maps(paths), Level(level)
    with earlier_maps(against, paths, files) as earlier:
        found = _compared(files, earlier)
    shown = [change for change in found.changes if change.effects.counts(wanted)]
    shown.sort(key=lambda change: change.effects.at(wanted), reverse=True)  # those of one effect stay by place
    for waiver in found.idle:
        show(findings([_idle(waiver)]), stream=sys.stderr)
    _print(form, found, shown, wanted)
    return int(verdict_of(found.changes, wanted) >= Verdict[fail_on.upper()])


def _compared(files: Sequence[Path], earlier: Earlier) -> Comparison:
    """The changes of maps against those of the earlier version, with places as people know them."""
    news = _compiled(files)
    olds = [_named(each, earlier) for each in map(compile_map, earlier.paths)]
    before, after = _maps(olds), _maps(news)
    if earlier.restricted:
        ids = {one.id for one in after}
        before = [one for one in before if one.id in ids]
    found = compare(before, after, alone=earlier.alone)
    return replace(found, changes=tuple(_renamed(change, earlier) for change in found.changes))


def _compiled(files: Sequence[Path]) -> list[Compiled]:
    return [compiled(path) for path in files]


def _maps(made: Sequence[Compiled]) -> list[RegisterMap]:
    """The maps; where one has errors, all errors are told and the command ends with code 2."""
    errors = [each for one in made for each in one.diagnostics if each.severity is Severity.ERROR]
    if errors:
        show(findings(errors), stream=sys.stderr)
        files = ", ".join(dict.fromkeys(display_name(one.path) for one in made if one.map is None))
        warn(f"nothing was compared: {files} cannot be compiled\n")
        raise click.exceptions.Exit(USAGE)
    return [one.map for one in made if one.map is not None]


def _named(made: Compiled, earlier: Earlier) -> Compiled:
    """A compiled map of the earlier version whose diagnostics have the names of files that people know."""
    found = tuple(replace(each, span=_span(each.span, earlier), related=()) for each in made.diagnostics)
    return replace(made, path=Path(earlier.name(str(made.path))), diagnostics=found)


def _renamed(change: Change, earlier: Earlier) -> Change:
    was = _span(change.was, earlier) if change.was else None
    return replace(change, place=_span(change.place, earlier), was=was)


def _span(span: Span, earlier: Earlier) -> Span:
    return replace(span, file=earlier.name(span.file))


def _idle(waiver: Waiver) -> Diagnostic:
    message = f"nothing at `{waiver.at}` is a change by {waiver.rule} against this version"
    help_text = "remove the waiver once the change is released, or correct `at`"
    return Diagnostic(NOTHING_WAIVED.id, message, waiver.span, help_text, Severity.WARNING)


def _print(form: str, found: Comparison, shown: Sequence[Change], level: Level) -> None:
    match form:
        case "json":
            tell(as_json(found, shown, level))
        case "markdown":
            tell(report.markdown(shown, level))
        case "concise":
            tell(as_concise(report.diagnostics(shown, level)))
        case "github":
            tell(as_github(report.diagnostics(shown, level)))
        case "gitlab":
            tell(as_gitlab(report.diagnostics(shown, level)))
        case "junit":
            tell(as_junit(report.diagnostics(shown, level)))
        case "sarif":
            tell(as_sarif(report.diagnostics(shown, level), {rule.id: rule for rule in RULES}))
        case _:
            show(as_text(found, shown, level))
