"""`regscribe coverage`: what maps cover, what is inferred in them and what is open."""

import sys
from collections.abc import Iterator, Sequence
from dataclasses import asdict

import click

from regscribe.cli.shared.diagnostic_text import count, findings, tally
from regscribe.cli.shared.map_arguments import find_maps
from regscribe.cli.shared.terminal import Piece, show, tell, warn
from regscribe.emit.docs_index import ADDRESSES, FACTS, coverage_text
from regscribe.evidence import MapCoverage, Remark, card, coverage
from regscribe.pipeline import compile_map
from regscribe.visible import json_text, safe


@click.command(
    name="coverage",
    epilog="Example: regscribe coverage athena/series-c --format json\n\n"
    "Exit code 0: done, 1: errors in a map (nothing is printed to standard output), 2: wrong usage.",
)
@click.argument("maps", nargs=-1, metavar="[MAP]...")
@click.option("--format", "form", type=click.Choice(["text", "json", "markdown"]), default="text", show_default=True)
def command(*, maps: tuple[str, ...], form: str) -> int:
    """Count what maps cover: addresses, facts of registers, worked examples; list what is inferred and open.

    MAP is a map file, a folder that is searched for *.yaml, or the id of a map (fdc/series-100). Without MAP: maps/.
    """
    compiled = [compile_map(path) for path in find_maps(maps)]
    found = [diagnostic for one in compiled for diagnostic in one.diagnostics]
    show(findings(found), stream=sys.stderr)
    register_maps = [one.map for one in compiled if one.map is not None]
    if len(register_maps) < len(compiled):
        warn(f"nothing was counted: {tally(found)}\n")
        return 1
    match form:
        case "json":
            plain = {"format": 1, "maps": [asdict(coverage(one)) for one in register_maps]}
            tell(json_text(plain, indent=2) + "\n")
        case "markdown":
            tell(coverage_text([card(one) for one in register_maps]))
        case _:
            show(piece for one in register_maps for piece in _text(coverage(one)))
    return 0


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
    facts = [tuple(str(value) for value in _facts(asdict(model))) for model in found.models]
    yield from _table([_heads(FACTS[1:]), *facts], left=1)
    addresses = [
        (model.name, *(str(value) for value in asdict(item).values()))
        for model in found.models
        for item in model.addresses
    ]
    yield from _table([_heads(("Model", *ADDRESSES[2:])), *addresses], left=2)
    for remark in found.remarks:
        yield f"{remark.kind}: ", "cyan"
        yield f"{_remark(remark)}\n", ""
    yield "\n", ""


def _heads(names: Sequence[str]) -> tuple[str, ...]:
    return tuple(name.lower() for name in names)


def _facts(plain: dict[str, object]) -> Iterator[object]:
    return (value for name, value in plain.items() if name != "addresses")


def _remark(remark: Remark) -> str:
    models = f" ({', '.join(remark.models)})" if remark.models else ""
    return safe(f"{', '.join(remark.at)}{models}{': ' if remark.text else ''}{remark.text}")


def _table(rows: Sequence[Sequence[str]], *, left: int) -> Iterator[Piece]:
    """Yield aligned rows, the first as heading; the first `left` columns are texts, the others numbers."""
    widths = [max(len(row[index]) for row in rows) for index in range(len(rows[0]))]
    for number, row in enumerate(rows):
        cells = (
            safe(cell).ljust(width) if index < left else cell.rjust(width)
            for index, (cell, width) in enumerate(zip(row, widths, strict=True))
        )
        yield f"{'  '.join(cells).rstrip()}\n", "bold" if number == 0 else ""
    yield "\n", ""
