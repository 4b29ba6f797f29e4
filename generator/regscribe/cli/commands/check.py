"""`regscribe check`: report what is wrong in maps."""

from pathlib import Path

import click

from regscribe.cli.shared.ci_formats import as_concise, as_gitlab, as_junit
from regscribe.cli.shared.compiled_maps import compiled
from regscribe.cli.shared.completion_values import complete_map
from regscribe.cli.shared.diagnostic_text import count, findings, tally
from regscribe.cli.shared.map_arguments import find_maps
from regscribe.cli.shared.output import show, tell, tell_done
from regscribe.cli.shared.report_formats import as_github, as_json, as_sarif
from regscribe.cli.shared.standard_input import STDIN
from regscribe.pipeline import has_errors
from regscribe.source import display_name

FORMS = ("text", "concise", "json", "github", "gitlab", "junit", "sarif")


@click.command(
    epilog="Example: regscribe check maps/ --format github\n\n"
    "Exit code 0: no error (warnings do not count, unless --strict), 1: findings, 2: wrong usage.",
)
@click.argument("paths", nargs=-1, metavar="[PATH]...", shell_complete=complete_map)
@click.option("--format", "form", type=click.Choice(FORMS), default="text", show_default=True)
@click.option(
    "--stdin-filename",
    "stdin_name",
    type=click.Path(path_type=Path),
    default=Path(STDIN),
    metavar="FILE",
    help="The file that standard input (`-`) counts as: what it builds on is looked for from there.",
)
@click.option("--strict", is_flag=True, help="Let warnings count as findings, too.")
def command(*, paths: tuple[str, ...], form: str, stdin_name: Path, strict: bool) -> int:
    """Report what is wrong in maps.

    PATH is a map file, a folder that is searched for *.yaml, the id of a map (fdc/series-100), or - for standard input.
    Without PATH: maps/.
    """
    maps = find_maps(paths, libraries=True)
    repeated = [diagnostic for path in maps for diagnostic in compiled(path, name=stdin_name).diagnostics]
    first = {(one.rule, one.span, one.message): one for one in reversed(repeated)}  # each map repeats its library's
    found = list(first.values())[::-1]
    match form:
        case "json":
            tell(as_json(found))
        case "concise":
            tell(as_concise(found))
        case "github":
            tell(as_github(found))
        case "gitlab":
            tell(as_gitlab(found))
        case "junit":
            tell(as_junit(found, map(display_name, maps)))
        case "sarif":
            from regscribe.checks import catalogue  # noqa: PLC0415 - 7 ms for the texts of rules, which only SARIF shows

            tell(as_sarif(found, {rule.id: rule for rule in catalogue.all_rules()}))
        case _:
            show(findings(found))
            tell_done(f"{count(len(maps), 'map')} checked: {tally(found)}\n")
    return int(has_errors(found) or (strict and bool(found)))
