"""`regscribe coverage`: what maps cover, what is inferred in them and what is open."""

from collections.abc import Iterator, Sequence
from dataclasses import asdict

import click

from regscribe.cli.shared.compiled_maps import compiled_maps
from regscribe.cli.shared.completion_values import complete_map
from regscribe.cli.shared.diagnostic_text import count
from regscribe.cli.shared.map_arguments import find_maps
from regscribe.cli.shared.output import Piece, print_json, show, tell
from regscribe.emit.docs_index import ADDRESSES, FACTS, coverage_text
from regscribe.evidence.coverage import coverage
from regscribe.evidence.coverage_values import MapCoverage, Remark, counts
from regscribe.evidence.index_row import card
from regscribe.visible import safe


@click.command(
    epilog="Example: regscribe coverage athena/series-c --format json\n\n"
    "Exit code 0: done, 1: errors in a map (nothing is printed to standard output), 2: wrong usage.",
)
@click.argument("maps", nargs=-1, metavar="[MAP]...", shell_complete=complete_map)
@click.option("--format", "form", type=click.Choice(["text", "json", "markdown"]), default="text", show_default=True)
def command(*, maps: tuple[str, ...], form: str) -> None:
    """Count what maps cover: addresses, facts of registers, worked examples; list what is inferred and open.

    MAP is a map file, a folder that is searched for *.yaml, or the id of a map (fdc/series-100). Without MAP: maps/.
    """
    register_maps = compiled_maps(find_maps(maps), nothing="nothing was counted")
    match form:
        case "json":
            print_json(maps=[asdict(coverage(one)) for one in register_maps])
        case "markdown":
            tell(coverage_text([card(one) for one in register_maps]))
        case _:
            show(piece for one in register_maps for piece in _text(coverage(one)))


def _text(found: MapCoverage) -> Iterator[Piece]:
    yield f"{safe(found.id)}: {safe(found.title)}\n", "bold"
    sums = (
        count(found.examples, "worked example"),
        f"{found.errata} errata",
        count(found.waivers, "waiver"),
        count(found.overrides, "override"),
        count(found.givens, "given"),
    )
    yield f"{', '.join(sums)}\n\n", ""
    facts = [(model.name, *map(str, counts(model))) for model in found.models]
    yield from _table([FACTS[1:], *facts], left=1)
    addresses = [
        (model.name, item.space, *map(str, counts(item))) for model in found.models for item in model.addresses
    ]
    yield from _table([("Model", *ADDRESSES[2:]), *addresses], left=2)
    for remark in found.remarks:
        yield f"{remark.kind}: ", "cyan"
        yield f"{_remark(remark)}\n", ""
    yield "\n", ""


def _remark(remark: Remark) -> str:
    models = f" ({', '.join(remark.models)})" if remark.models else ""
    return safe(f"{', '.join(remark.at)}{models}{': ' if remark.text else ''}{remark.text}")


def _table(rows: Sequence[Sequence[str]], *, left: int) -> Iterator[Piece]:
    """Yield aligned rows, the first as heading; the first `left` columns are texts, the others numbers."""
    rows = [[name.lower() for name in rows[0]], *rows[1:]]
    widths = [max(len(row[index]) for row in rows) for index in range(len(rows[0]))]
    for number, row in enumerate(rows):
        cells = (
            safe(cell).ljust(width) if index < left else cell.rjust(width)
            for index, (cell, width) in enumerate(zip(row, widths, strict=True))
        )
        yield f"{'  '.join(cells).rstrip()}\n", "bold" if number == 0 else ""
    yield "\n", ""
