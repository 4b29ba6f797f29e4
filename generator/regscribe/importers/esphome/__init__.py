"""The importer of ESPHome's component modbus_controller: each sensor, number, select, switch or text is a register.

Filters make a scale in their order. Nothing is executed: what a lambda does with a number is named, and the number raw.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import partial

from regscribe.draft import Draft
from regscribe.files import OneLine
from regscribe.importers.esphome.items import MAKERS, SHOWN
from regscribe.importers.shared.document import Collecting, chosen, has, reads, text_of
from regscribe.importers.shared.exact import whole
from regscribe.importers.shared.read_yaml import read_yaml
from regscribe.importers.shared.tree import Node, TreeError
from regscribe.plugins import Likeness, Option

name = "esphome"
summary = "sensors and others of ESPHome's modbus_controller"
options = (Option("controller", "id of the modbus_controller; needed where there are several.", metavar="ID"),)

COMPONENT = "modbus_controller"
GROUPS = {
    "sensor": "Sensors",
    "binary_sensor": "Binary sensors",
    "number": "Numbers",
    "select": "Selects",
    "switch": "Switches",
    "text_sensor": "Texts",
    "output": "Outputs",
}
ELSEWHERE = ("packages", "<<")
VARIABLE = re.compile(r"\$(?:\{(\w+)\}|(\w+))")


def likeness(data: bytes, name: str) -> Likeness:  # noqa: ARG001 - the contract of importers
    """Surely, by an item of the platform or the component itself."""
    if has(data, rf"^[\s-]*platform\s*:\s*{COMPONENT}\b", r"^\s+(- )?address\s*:"):
        return Likeness.SURE
    return Likeness.PERHAPS if has(data, rf"^{COMPONENT}\s*:") else Likeness.NO


@reads
def read(data: bytes, name: str, options: Mapping[str, str]) -> Draft:
    """Return the registers of one controller. Raises OptionError where it is not clear which."""
    root, doubled = read_yaml(text_of(data))
    root = substituted(root)
    items = list(_items(root))
    if not items:
        message = f"there is no item of the platform {COMPONENT}"
        raise TreeError(root.line, message, "is it in a package or an included file? import that")
    owners = {one.word("modbus_controller_id"): None for _, one in items}
    controller = chosen("controller", options.get("controller", ""), [*owners], "controller")
    own = _controller(root, controller)
    found = Collecting(name, SHOWN)
    found.doubled(doubled)
    every = _seconds(own.word("update_interval") if own else "") or USUAL_SECONDS
    for platform, item in items:
        if item.word("modbus_controller_id") == controller:
            called = item.word("name") or item.word("id") or "unnamed"
            make = partial(MAKERS[platform], called, found.place(item), every)
            found.add(called, item, make, group=GROUPS[platform])
    for key in ELSEWHERE:
        if root.get(key):
            found.stated.append(f"what stands in other files is not read: {key}")
    unit = whole(own.word("address")) if own else None
    head = {"protocol": OneLine(default_unit=unit)} if unit and 0 < unit <= 247 else {}  # noqa: PLR2004 - the last id
    esphome = root.get("esphome")
    return found.draft(title=esphome.word("name") if esphome else "", head=head)


USUAL_SECONDS = 60
"""Seconds between two polls where the controller says nothing."""


def _items(root: Node) -> Iterator[tuple[str, Node]]:
    for platform in GROUPS:
        listed = root.get(platform)
        for item in listed.each if listed else ():
            if item.word("platform") == COMPONENT:
                yield platform, item


def _controller(root: Node, controller: str) -> Node | None:
    """The controller of that id; the only one where items name none."""
    listed = root.get(COMPONENT)
    every = listed.each if listed else ()
    return next((one for one in every if one.word("id") == controller), every[0] if len(every) == 1 else None)


def _seconds(text: str) -> int:
    """Seconds of an interval (`30s`, `1min`); 0 where it is none of whole seconds."""
    found = re.fullmatch(r"(\d{1,6})\s*(s|sec|min|h)", text.strip())
    return int(found[1]) * {"s": 1, "sec": 1, "min": 60, "h": 3600}[found[2]] if found else 0


def substituted(root: Node) -> Node:
    """Return a document with the values of its `substitutions` in their places; others stay as they are written."""
    table = root.get("substitutions")
    values = {key: one.text for key, one in ((table and table.members) or {}).items() if one.is_scalar}
    return _put(root, values) if values else root


def _put(node: Node, values: Mapping[str, str]) -> Node:
    if node.members is not None:
        return replace(node, members={key: _put(one, values) for key, one in node.members.items()})
    if node.elements is not None:
        return replace(node, elements=tuple(_put(one, values) for one in node.elements))
    text = VARIABLE.sub(lambda found: values.get(found[1] or found[2], found[0]), node.text)
    return replace(node, text=text)
