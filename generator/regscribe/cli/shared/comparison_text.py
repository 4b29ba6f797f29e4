"""A comparison as text for people, and as JSON and CSV for programs."""

import csv
import io
from collections.abc import Iterable, Iterator
from dataclasses import asdict, replace

from regscribe.cli.shared.diagnostic_text import count
from regscribe.cli.shared.output import Piece
from regscribe.evidence.differences import CellDifference, Comparison, Location
from regscribe.visible import cell, json_text, safe

HEADER = ("what", "model", "space", "address", "id", "name", "column", "ours", "theirs", "line")


def as_text(found: Comparison) -> Iterator[Piece]:
    """Yield the rows of one side only, the cells that differ by register, and the counts; models are folded."""
    yield f"{found.ours} against {safe(found.theirs)}: {count(found.matched, 'row')} held together in ", "bold"
    yield f"{safe(', '.join(found.columns))}\n", "bold"
    for note in found.notes:
        yield f"note: {safe(note)}\n", ""
    for title, places in ((found.ours, found.only_ours), (found.theirs, found.only_theirs)):
        if places:
            yield f"\n{count(len(places), 'row')} only in {safe(title)}:\n", "bold yellow"
            folded: dict[Location, list[str]] = {}
            for place in places:
                folded.setdefault(replace(place, model=""), []).append(place.model)
            yield from ((f"  {_place(place, models)}\n", "") for place, models in folded.items())
    number = len(found.differences)
    cells = f"{count(number, 'cell')} {'differs' if number == 1 else 'differ'}"
    if found.differences:
        yield f"\n{cells}:\n", "bold yellow"
        yield from _differences(found.differences)
    if found.equal:
        yield "\nnothing differs\n", "bold green"
        return
    columns = ", ".join(f"{column} {number}" for column, number in found.counts.items())
    rows = f"{count(len(found.only_ours), 'row')} only in {found.ours}, {len(found.only_theirs)} only in "
    yield f"\n{rows}{safe(found.theirs)}; {': '.join(filter(None, (cells, columns)))}\n", "bold red"


def _differences(differences: Iterable[CellDifference]) -> Iterator[Piece]:
    """Yield each register once with all its differences; models that differ in the same way share the lines."""
    by_place: dict[Location, list[CellDifference]] = {}
    for difference in differences:
        by_place.setdefault(difference.place, []).append(difference)
    alike: dict[tuple[Location, tuple[tuple[str, str, str], ...]], list[str]] = {}
    for place, own in by_place.items():
        cells = tuple((one.column, one.ours, one.theirs) for one in own)
        alike.setdefault((replace(place, model=""), cells), []).append(place.model)
    for (place, cells), models in alike.items():
        yield f"  {_place(place, models)}\n", ""
        for column, ours, theirs in cells:
            yield f"    {safe(column)}: ", "cyan"
            yield f"{_cell(ours)} against {_cell(theirs)}\n", ""


def _cell(text: str) -> str:
    return safe(f"`{text}`") if text else "nothing"


def _place(place: Location, models: Iterable[str]) -> str:
    parts = (f"{place.space} {place.address}".strip(), place.id, f"“{place.name}”" if place.name else "")
    line = f" (line {place.line})" if place.line else ""
    return safe(f"{', '.join(models)}: {' '.join(part for part in parts if part)}{line}")


def as_json(found: Comparison) -> str:
    """Return one JSON object with everything; models are not folded."""
    plain = {
        "format": 1,
        "ours": found.ours,
        "theirs": found.theirs,
        "equal": found.equal,
        "columns": list(found.columns),
        "matched": found.matched,
        "counts": found.counts,
        "only_ours": [_plain(place) for place in found.only_ours],
        "only_theirs": [_plain(place) for place in found.only_theirs],
        "differences": [
            {**_plain(one.place), "column": one.column, "ours": one.ours, "theirs": one.theirs}
            for one in found.differences
        ],
        "notes": list(found.notes),
    }
    return json_text(plain, indent=2) + "\n"


def _plain(place: Location) -> dict[str, str | int | None]:
    return {**asdict(place), "line": place.line or None}


def as_csv(found: Comparison) -> str:
    r"""Return a row for each row of one side only and for each cell that differs; `\n` ends each line."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(HEADER)
    for what, places in (("only_ours", found.only_ours), ("only_theirs", found.only_theirs)):
        writer.writerows(_csv_row(what, place, ("", "", "")) for place in places)
    for one in found.differences:
        writer.writerow(_csv_row("differs", one.place, (one.column, cell(one.ours), cell(one.theirs))))
    return buffer.getvalue()


def _csv_row(what: str, place: Location, sides: tuple[str, str, str]) -> tuple[str | int, ...]:
    texts = map(cell, (place.model, place.space, place.address, place.id, place.name))
    return (what, *texts, *sides, place.line or "")
