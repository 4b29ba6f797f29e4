"""No cell, however large or repetitive, takes a parser long: patterns see the beginning of a text alone."""

from collections.abc import Callable

import pytest

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.access import parse_access
from regscribe.importers.table.cells.addresses import Column, parse_addresses
from regscribe.importers.table.cells.enums import parse_codes
from regscribe.importers.table.cells.ranges import parse_range
from regscribe.importers.table.cells.scales import parse_scale
from regscribe.importers.table.cells.spaces import parse_spaces
from regscribe.importers.table.cells.types import Dialect, parse_order, parse_type
from regscribe.importers.table.cells.units import parse_unit

PARSERS: dict[str, Callable[[str], object]] = {
    "address": lambda text: parse_addresses([Column("Address", (text, "1"))]).cells[0],
    "space": lambda text: parse_spaces([text]).cells[0],
    "type": lambda text: parse_type(text, Dialect()),
    "size": lambda text: parse_type("signed", Dialect(), size=text),
    "order": parse_order,
    "scale": parse_scale,
    "range": parse_range,
    "codes": parse_codes,
    "unit": parse_unit,
    "access": parse_access,
}


@pytest.mark.parametrize("parser", PARSERS)
@pytest.mark.parametrize("piece", ["-", "1.", "0 ", "x*", "(", "0=", "1-", "a_", "/R", "0x"])
def test_a_cell_of_a_megabyte_is_not_understood_and_soon_done(parser: str, piece: str) -> None:
    found = PARSERS[parser](piece * (1_000_000 // len(piece)))
    assert found is None or isinstance(found, Unclear)
