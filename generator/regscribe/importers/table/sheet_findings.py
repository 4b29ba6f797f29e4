"""What people should know of a sheet before they trust its values."""

import re
from collections.abc import Iterator, Sequence

from regscribe.importers.table.grid import RULE, Grid, letters
from regscribe.importers.table.sheet_structure import Structure
from regscribe.model import Diagnostic, Severity, Span

MOST_NAMED = 10

DATE = re.compile(r"\d{4}-\d\d-\d\d( \d\d:\d\d:\d\d.*)?")
"""How a date is shown: a range `1-10` or a fraction `1/2` that was typed into a spreadsheet often became one."""

ERROR = re.compile(r"#(REF!|N/A|VALUE!|NAME\?|DIV/0!|NUM!|NULL!)")


def findings_of(grid: Grid, said: Structure, sheet: str) -> tuple[Diagnostic, ...]:
    """Warnings on hidden rows and columns, formulas without a result, errors and dates in cells."""
    return tuple(_findings(grid, said, sheet))


def _findings(grid: Grid, said: Structure, sheet: str) -> Iterator[Diagnostic]:
    if said.unvalued:
        message = f"{_some(said.unvalued, 'cell')} hold a formula without a result, which nobody calculates here"
        yield _finding(grid, "formula", f"sheet {sheet}: {message}", "open the file in a spreadsheet and save it")
    shown = {row.line for row in grid.rows}
    if hidden := [str(number) for number in said.hidden_rows if number in shown]:
        message = f"sheet {sheet}: {_some(hidden, 'row')} are hidden in the sheet and are read like all others"
        yield _finding(
            grid, "hidden-rows", message, "what does not count is left out by --range, or under `skip` in a mapping"
        )
    if said.hidden_columns:
        message = f"sheet {sheet}: {_some(said.hidden_columns, 'column')} are hidden in the sheet and are read too"
        yield _finding(grid, "hidden-columns", message)
    for pattern, code, what in (
        (DATE, "date", "hold dates; a spreadsheet makes such of a range like 1-10 or a fraction like 1/2"),
        (ERROR, "error-value", "hold the error of a formula"),
    ):
        cells = [
            f"{letters(row.first + at)}{row.line}"
            for row in grid.rows
            for at, text in enumerate(row.cells)
            if pattern.fullmatch(text)
        ]
        if cells:
            yield _finding(grid, code, f"sheet {sheet}: {_some(cells, 'cell')} {what}")


def _some(names: Sequence[str], what: str) -> str:
    shown = ", ".join(names[:MOST_NAMED])
    more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
    return f"{what}s {shown}{more}"


def _finding(grid: Grid, code: str, message: str, help_text: str = "") -> Diagnostic:
    return Diagnostic(f"{RULE}/{code}", message, Span(grid.name), help_text, severity=Severity.WARNING)
