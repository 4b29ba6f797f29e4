"""Where the parts of a word stand on the wire, bit by bit."""

from regscribe.export.device import Point
from regscribe.export.device.places import places_of
from regscribe.model import BitField, Kind


def is_object(point: Point) -> bool:
    """Whether a register is exported as an object of its parts: if the bits of each lie side by side on the wire."""
    if point.register.kind not in {Kind.FLAGS, Kind.FIELDS} or not point.fields:
        return False
    return None not in offsets_of(point).values()


def offsets_of(point: Point) -> dict[str, int | None]:
    """Return the place of each part's highest bit, counted from the first on the wire; None if its bits lie apart."""
    places = places_of(point)
    return {field.id: _offset(field, places) for field in point.fields}


def _offset(field: BitField, places: list[int]) -> int | None:
    where = []
    for bit in range(field.high, field.low - 1, -1):
        above, within = divmod(bit, 8)
        where.append(8 * places[len(places) - 1 - above] + 7 - within)
    return where[0] if where == list(range(where[0], where[0] + len(where))) else None
