"""Evidence for a map: it is held against other transcriptions, and what it covers is counted. Nothing here prints."""

from regscribe.evidence.card import card
from regscribe.evidence.compare import compare_maps, compare_table
from regscribe.evidence.coverage import coverage
from regscribe.evidence.result import Comparison, Difference, Place
from regscribe.evidence.statement import Addresses, MapCoverage, ModelCoverage, Remark
from regscribe.evidence.table import Table, TableError, read

__all__ = [
    "Addresses",
    "Comparison",
    "Difference",
    "MapCoverage",
    "ModelCoverage",
    "Place",
    "Remark",
    "Table",
    "TableError",
    "card",
    "compare_maps",
    "compare_table",
    "coverage",
    "read",
]
