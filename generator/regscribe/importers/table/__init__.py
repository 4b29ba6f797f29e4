"""The importer of tables as people have them: CSV of any dialect, workbooks, tables of a PDF, text from a clipboard.

`read` finds the header, says what each column is, decides for the table as a whole what only the whole shows (the base
of addresses, whether scales divide), and makes a register of each row, or says why none can be made (docs/import.md).
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import PurePath

from regscribe.draft import Draft, refused
from regscribe.importers.table.archive import is_workbook
from regscribe.importers.table.choices import OPTIONS, choices
from regscribe.importers.table.drafting import draft_of
from regscribe.importers.table.grid import RULE, TableError
from regscribe.importers.table.header import find
from regscribe.importers.table.sources import grids_of, is_pdf, sample
from regscribe.plugins import Likeness

name = "table"
summary = "a table of registers: CSV, XLSX, PDF, or text from a clipboard"
options = OPTIONS

TREES = (".yaml", ".yml", ".json", ".toml", ".conf")
"""Endings of files that are no table, whatever a line of them looks like."""

ENDINGS = (".csv", ".tsv", ".txt", ".xlsx", ".xlsm", ".pdf", ".tab", ".xls", ".ods")


def likeness(data: bytes, name: str) -> Likeness:
    """Perhaps: a file of such an ending, a workbook, a PDF, or a text with a header that names registers."""
    if not data.strip() or PurePath(name.lower()).suffix in TREES:
        return Likeness.NO
    if PurePath(name.lower()).suffix in ENDINGS or is_workbook(data) or is_pdf(data):
        return Likeness.PERHAPS
    try:
        return Likeness.PERHAPS if find(sample(data, name)) is not None else Likeness.NO
    except TableError:
        return Likeness.NO


def read(data: bytes, name: str, options: Mapping[str, str]) -> Draft:
    """Return the registers of the table, and of each row what was taken, lost or left out. Raises OptionError."""
    chosen = choices(options)
    try:
        grids, stated = grids_of(data, name, chosen)
        draft = draft_of(grids, chosen, name)
    except TableError as error:
        return refused(name, str(error).removeprefix(f"{name}: "), line=error.line, rule=RULE)
    return replace(draft, stated=(*stated, *draft.stated))


__all__: Sequence[str] = ["likeness", "name", "options", "read", "summary"]
