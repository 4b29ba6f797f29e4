"""The importer of inverter definitions of ha-solarman: each item of a group is a register.

Registers of a number stand lowest word first. The value is (number - offset) x scale / divide.
"""

from collections.abc import Mapping
from functools import partial

from regscribe.draft import Draft
from regscribe.importers.shared.document import Collecting, has, reads, text_of
from regscribe.importers.shared.exact import whole
from regscribe.importers.shared.read_yaml import read_yaml
from regscribe.importers.shared.tree import Node, TreeError
from regscribe.importers.solarman.items import SHOWN, Usual, item
from regscribe.model import Space
from regscribe.plugins import Likeness, Option

name = "solarman"
summary = "an inverter definition of ha-solarman"
options: tuple[Option, ...] = ()

SPACES = {3: Space.HOLDING, 4: Space.INPUT, 1: Space.COIL, 2: Space.DISCRETE}
"""Spaces by the function that reads them."""

USUAL_CODE = 3


def likeness(data: bytes, name: str) -> Likeness:  # noqa: ARG001 - the contract of importers
    """Surely, by groups with items that have a rule."""
    found = has(data, r"^parameters\s*:", r"^\s+-?\s*group\s*:", r"^\s+rule\s*:", r"^\s+registers\s*:")
    return Likeness.SURE if found else Likeness.NO


@reads
def read(data: bytes, name: str, options: Mapping[str, str]) -> Draft:  # noqa: ARG001 - as above
    """Return the registers of a definition."""
    root, doubled = read_yaml(text_of(data))
    listed = root.get("parameters")
    if listed is None:
        raise TreeError(root.line, "there is no list `parameters`", "is this an inverter definition of ha-solarman?")
    found = Collecting(name, SHOWN)
    found.doubled(doubled)
    usual = _usual(root)
    for group in listed.each:
        items = group.get("items")
        for one in items.each if items else ():
            called = one.word("name") or "unnamed"
            make = partial(item, called, found.place(one), usual)
            found.add(called, one, make, group=group.word("group") or "Registers")
    found.stated.append("registers of a number are given lowest word first, as ha-solarman reads them")
    if has(data, r"^\s+divide\s*:"):
        found.stated.append("where an item has `divide`, ha-solarman drops what is behind the point; the map does not")
    info = root.get("info")
    return found.draft(title=info.word("model") if info else "", maker=info.word("manufacturer") if info else "")


def _usual(root: Node) -> Usual:
    """What counts where an item says nothing: the function that reads it, by its own stretches or for all."""
    default = root.get("default")
    code = whole(default.word("code")) if default else None
    requests = root.get("requests")
    stretches = []
    for one in requests.each if requests else ():
        first, last = whole(one.word("start")), whole(one.word("end"))
        given = whole(one.word("mb_functioncode") or one.word("code"))
        if first is not None and last is not None and given in SPACES:
            stretches.append((first, last, SPACES[given]))
    return Usual(SPACES.get(code or USUAL_CODE, Space.HOLDING), tuple(stretches))
