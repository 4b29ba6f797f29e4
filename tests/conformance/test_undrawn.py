"""What the picture of addresses does not draw is named under it, and in its words for those who do not see it."""

import pytest

from regscribe.emit import markdown
from regscribe.emit.markdown import alt_text

from .suite import Json, diagnose, whole_map

SETPOINT: Json = {"at": 0, "name": "Setpoint"}
LEFT_OUT = {
    "records of files (Total)": {"at": 7, "name": "Total", "space": "file", "file": 4},
    "FIFO queues (First; Last)": {"at": 1, "name": "First", "space": "queue", "queue": 12, "access": "r"},
    "device identification (Maker)": {"at": 0, "name": "Maker", "space": "identification", "access": "r", "length": 5},
    "registers of 32 bits (Enron) (Flow)": {"at": 5001, "name": "Flow", "space": "enron", "type": "uint32"},
}
LAST: Json = {"at": 2, "name": "Last", "space": "queue", "queue": 12, "access": "r"}


@pytest.mark.parametrize("words", LEFT_OUT)
def test_what_the_address_map_leaves_out_is_named_under_it(words: str) -> None:
    more = [LAST] if "queue" in LEFT_OUT[words].values() else []
    register_map, found = diagnose(whole_map({"registers": [SETPOINT, LEFT_OUT[words], *more]}))
    assert register_map is not None, found
    (page,) = (text for path, text in markdown.render(register_map).items() if path.endswith("case.md"))
    line = next(line for line in page.splitlines() if line.startswith("Not in the picture"))
    assert line == f"Not in the picture: {words}."
    assert alt_text.addresses(register_map).endswith(f"Not in the picture: {words}.")


def test_where_all_is_drawn_nothing_is_named() -> None:
    register_map, _ = diagnose(whole_map({"registers": [SETPOINT]}))
    assert register_map is not None
    assert alt_text.undrawn(register_map) == ""
