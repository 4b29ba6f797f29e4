"""Evidence for a map: it is held against other transcriptions, and what it covers is counted. Nothing here prints."""

from regscribe.evidence.compare import compare_maps, compare_table
from regscribe.evidence.coverage import coverage
from regscribe.evidence.coverage_values import Addresses, MapCoverage, ModelCoverage, Remark, counts
from regscribe.evidence.differences import CellDifference, Comparison, Location
from regscribe.evidence.index_row import card
from regscribe.evidence.table import Table, TableError, read

__all__ = [
    "Addresses",
    "CellDifference",
    "Comparison",
    "Location",
    "MapCoverage",
    "ModelCoverage",
    "Remark",
    "Table",
    "TableError",
    "card",
    "compare_maps",
    "compare_table",
    "counts",
    "coverage",
    "read",
]
