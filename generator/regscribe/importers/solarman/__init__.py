"""The importer of inverter definitions of ha-solarman: each item of a group is a register.

Registers of a number stand lowest word first. The value is (number - offset) x scale / divide.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial

from regscribe.draft import Draft
from regscribe.importers.shared.document import Collecting, has, reads, text_of
from regscribe.importers.shared.exact import whole
from regscribe.importers.shared.read_yaml import read_yaml
from regscribe.importers.shared.tree import Node, TreeError
from regscribe.importers.solarman.items import SHOWN, Usual, item
from regscribe.model import Space
from regscribe.plugins import Likeness, Option, OptionError

name = "solarman"
summary = "an inverter definition of ha-solarman"
options = (Option("mod", "number of the variant of the device, as its entry in Home Assistant has it.", "0", "N"),)

SPACES = {3: Space.HOLDING, 4: Space.INPUT, 1: Space.COIL, 2: Space.DISCRETE}
"""Spaces by the function that reads them."""

USUAL_CODE = 3
MOST_DIGITS = 4
VARIANTS = r"\bscale\s*:\s*\[|\bregisters\s*:\s*\[\s*\["
INHERITED = frozenset({"code", "update_interval"})
"""Keys of a group that count for its items."""


def likeness(data: bytes, name: str) -> Likeness:  # noqa: ARG001 - the contract of importers
    """Surely, by groups with items that have a rule."""
    found = has(data, r"^parameters\s*:", r"^\s+-?\s*group\s*:", r"^\s+rule\s*:", r"^\s+registers\s*:")
    return Likeness.SURE if found else Likeness.NO


@reads
def read(data: bytes, name: str, options: Mapping[str, str]) -> Draft:
    """Return the registers of a definition. Raises OptionError for a --mod that is no number."""
    mod = options.get("mod", "") or "0"
    if not mod.isdecimal():
        message = f"--mod {mod}: write the number of a variant, from 0"
        raise OptionError(message)
    root, doubled = read_yaml(text_of(data))
    listed = root.get("parameters")
    if listed is None:
        raise TreeError(root.line, "there is no list `parameters`", "is this an inverter definition of ha-solarman?")
    found = Collecting(name, SHOWN)
    found.doubled(doubled)
    usual = replace(_usual(root), mod=int(mod[:MOST_DIGITS]))
    for group in listed.each:
        items = group.get("items")
        outer = {key: one for key, one in (group.members or {}).items() if key in INHERITED}
        for one in items.each if items else ():
            called = one.word("name") or "unnamed"
            make = partial(item, called, found.place(one), usual)
            found.add(called, one, make, group=group.word("group") or "Registers", outer=outer)
    if has(data, VARIANTS):
        found.stated.append(f"lists of scales and registers are of variants of the device: taken is {mod} (--mod)")
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
