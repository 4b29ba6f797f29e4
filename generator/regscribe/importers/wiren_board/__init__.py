"""The importer of templates of Wiren Board's wb-mqtt-serial: parameters and channels are registers.

A value is scale x number + offset. A condition over a parameter that is a register becomes `when`; over one that is
only a setting of the template it asks a given, which whoever opens the device states.
"""

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

from regscribe.draft import Draft
from regscribe.draft.numbers import plain
from regscribe.files import OneLine
from regscribe.importers.shared.document import Collecting, has, reads, text_of
from regscribe.importers.shared.exact import number, whole
from regscribe.importers.shared.read_json import read_json
from regscribe.importers.shared.reading import LeftOutError
from regscribe.importers.shared.tree import Node, TreeError
from regscribe.importers.wiren_board.channels import SHOWN, Context, channel, setup
from regscribe.importers.wiren_board.conditions import Reference
from regscribe.model.identifiers import label_id
from regscribe.plugins import Likeness, Option

name = "wiren-board"
summary = "a template of Wiren Board's wb-mqtt-serial"
options: tuple[Option, ...] = ()

JINJA = ("{%", "{{", "{#")
MODBUS = frozenset({"", "modbus", "modbus-tcp"})
LIMITS = {"max_read_registers": ("read_words", 125), "max_write_registers": ("write_words", 123)}
TAKEN = frozenset({"name", "id", "channels", "parameters", "setup", "groups", "translations", "protocol", *LIMITS})


def likeness(data: bytes, name: str) -> Likeness:  # noqa: ARG001 - the contract of importers
    """Surely, by a device_type and a device with channels."""
    found = has(data, r'"device_type"\s*:', r'"device"\s*:', r'"(channels|parameters)"\s*:')
    return Likeness.SURE if found else Likeness.NO


@reads
def read(data: bytes, name: str, options: Mapping[str, str]) -> Draft:  # noqa: ARG001 - as above
    """Return the registers of a template."""
    text = text_of(data)
    mark = min((text.index(one) for one in JINJA if one in text), default=None)
    if mark is not None:
        message = f"a template of Jinja (`{text[mark : mark + 2]}`), from which templates are made"
        raise TreeError(
            text.count("\n", 0, mark) + 1, message, "import the .json that wb-mqtt-serial's build makes of it"
        )
    root, doubled = read_json(text)
    device = root.get("device")
    if device is None or device.members is None:
        raise TreeError(root.line, "there is no `device`", "is this a template of wb-mqtt-serial?")
    if device.word("protocol") not in MODBUS:
        raise TreeError(device.line, f"the device speaks {device.word('protocol')}, not Modbus", "only Modbus is read")
    found = Collecting(name, SHOWN)
    found.doubled(doubled)
    said = _english(device)
    context = Context(_groups(device, said), said, _references(device))
    for own, parameter in _parameters(device):
        if parameter.get("address"):
            called = said.get(parameter.word("title"), parameter.word("title")) or own
            make = partial(channel, called, found.place(parameter), context, own)
            found.add(called, parameter, make, group=context.group(parameter, "Parameters"))
    _channels(found, device, context)
    told = ", ".join(key for key in device.members if key not in TAKEN)
    found.stated += [f"how the device is asked is no fact of a map: {told}"] if told else []
    title = said.get(device.word("name"), device.word("name"))
    return found.draft(title=title, head=_head(device, context))


def _channels(found: Collecting, device: Node, context: Context) -> None:
    listed = device.get("channels")
    for one in listed.each if listed else ():
        called = context.said.get(one.word("name"), one.word("name")) or "unnamed"
        make = partial(channel, called, found.place(one), context, "")
        found.add(called, one, make, group=context.group(one, "Channels"))
    written = device.get("setup")
    for one in written.each if written else ():
        called = context.said.get(one.word("title"), one.word("title")) or "unnamed"
        found.add(called, one, partial(setup, called, found.place(one), context), group="Setup")
    nested = device.get("subdevices")
    for one in nested.each if nested else ():
        why = LeftOutError("subdevice", "a device inside the device, of which channels choose one, is not taken over")
        found.left_out(one.word("device_type") or one.word("title") or "subdevice", one, why)


def _parameters(device: Node) -> Iterator[tuple[str, Node]]:
    """The parameters with their ids: members of a mapping, or a list."""
    listed = device.get("parameters")
    if listed is None:
        return
    if listed.members is not None:
        yield from listed.members.items()
    else:
        yield from ((one.word("id"), one) for one in listed.each)


def _references(device: Node) -> dict[str, Reference]:
    """What a condition may ask, by the id of the parameter; two of one register are the first of them."""
    found: dict[str, Reference] = {}
    by_place: dict[tuple[str, str], Reference] = {}
    for own, parameter in _parameters(device):
        plain_id = label_id(own) or "parameter"
        if parameter.get("address"):
            place = parameter.word("reg_type"), parameter.word("address")
            found[own] = by_place.setdefault(place, Reference(plain_id))
        else:
            title = parameter.word("title") or own
            found[own] = Reference(plain_id, title, number(parameter.word("default")), given=True)
    return found


def _english(device: Node) -> dict[str, str]:
    """The texts in English, by the names that stand for them."""
    listed = device.get("translations")
    english = listed.get("en") if listed else None
    return {key: one.text for key, one in ((english and english.members) or {}).items()}


def _groups(device: Node, said: Mapping[str, str]) -> dict[str, str]:
    listed = device.get("groups")
    every = listed.each if listed else ()
    return {one.word("id"): said.get(one.word("title"), one.word("title")) for one in every}


def _head(device: Node, context: Context) -> dict[str, Any]:
    head: dict[str, Any] = {}
    limits = {key: most for word, (key, top) in LIMITS.items() if (most := whole(device.word(word))) and 0 < most < top}
    if limits:
        head["protocol"] = {"limits": limits}
    asked = [one for one in context.references.values() if one.given and one.id in context.asked]
    if asked:
        head["givens"] = {one.id: _given(one) for one in asked}
    return head


def _given(one: Reference) -> OneLine:
    default = {} if one.default is None else {"default": plain(one.default)}
    reason = "a setting of the template, in no register"
    return OneLine({"type": "number", **default, "description": one.title, "reason": reason})
