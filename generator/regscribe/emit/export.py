"""What `regscribe export` prints: values as CSV, the whole model as JSON, a poll for collectd (docs/export.md)."""

from regscribe.emit.collectd import BAUD, EVERY, Poll, collectd_text
from regscribe.emit.document import json_text
from regscribe.emit.spreadsheet import COLUMNS, csv_text

__all__ = ["BAUD", "COLUMNS", "EVERY", "Poll", "collectd_text", "csv_text", "json_text"]
