"""What `regscribe export` prints: the table of all values as CSV and the whole model as JSON (docs/export.md)."""

from regscribe.emit.document import json_text
from regscribe.emit.spreadsheet import COLUMNS, csv_text

__all__ = ["COLUMNS", "csv_text", "json_text"]
