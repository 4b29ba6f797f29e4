"""The importer of Telegraf's input plug-in modbus, in all of its three styles: each field is a register."""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import NamedTuple

from regscribe.dialects.telegraf import TABLES
from regscribe.draft import Draft
from regscribe.importers.shared.document import Collecting, chosen, has, reads, text_of
from regscribe.importers.shared.exact import whole
from regscribe.importers.shared.read_toml import read_toml
from regscribe.importers.shared.reading import Keys
from regscribe.importers.shared.tree import Node, TreeError
from regscribe.importers.telegraf.fields import SHOWN, field_of, field_of_list
from regscribe.importers.telegraf.processors import Scaling, scaled, scalings
from regscribe.plugins import Likeness, Option

name = "telegraf"
summary = "[[inputs.modbus]] of Telegraf, in the styles metric, request and register"
options = (
    Option("device", "name of the input; needed where there are several.", metavar="NAME"),
    Option("unit", "slave id; needed where there are several.", metavar="N"),
)

BLOCKS = ("metric", "request")
NO_UNIT = "0"
MOST_WORDS = 125


class Field(NamedTuple):
    """A field in the file: its keys, its block, the unit id, and in the style register the list that it is in."""

    node: Node
    block: Node
    unit: str
    table: str = ""


def likeness(data: bytes, name: str) -> Likeness:  # noqa: ARG001 - the contract of importers
    """Surely, by the head of the table."""
    return Likeness.SURE if has(data, r"^\s*\[\[\s*inputs\s*\.\s*modbus\s*(\.\s*\w+\s*)?\]\]") else Likeness.NO


@reads
def read(data: bytes, name: str, options: Mapping[str, str]) -> Draft:
    """Return the registers of one input and slave id. Raises OptionError where it is not clear which."""
    root, doubled = read_toml(text_of(data))
    inputs = _inputs(root)
    one = inputs[chosen("device", options.get("device", ""), [*inputs], "input")]
    fields = list(_fields(one))
    if not fields:
        raise TreeError(one.line, "the input has no field", "are they in another file?")
    unit = chosen("unit", options.get("unit", ""), [*dict.fromkeys(field.unit for field in fields)], "slave id")
    found = Collecting(name, SHOWN)
    found.doubled(doubled)
    location = one.word("string_register_location")
    behind = scalings(root)
    for field in fields:
        if field.unit == unit:
            _add(found, field, location, behind)
    _told(found, one, root)
    return found.draft(title=one.word("name"), head=_head(one, unit))


def _inputs(root: Node) -> dict[str, Node]:
    top = root.get("inputs")
    listed = top.get("modbus") if top else None
    named: dict[str, Node] = {}
    for number, one in enumerate(listed.each if listed else (), start=1):
        word = one.word("name") or f"input {number}"
        named[word if word not in named else f"{word} {number}"] = one
    if not named:
        raise TreeError(1, "there is no [[inputs.modbus]]", "importers read the input plug-in modbus only")
    return named


def _fields(one: Node) -> Iterator[Field]:
    for style in BLOCKS:
        blocks = one.get(style)
        for block in blocks.each if blocks else ():
            listed = block.get("fields")
            unit = _unit(block)
            yield from (Field(node, block, unit) for node in (listed.each if listed else ()))
    for table in TABLES:
        listed = one.get(table)
        yield from (Field(node, one, _unit(one), table) for node in (listed.each if listed else ()))


def _unit(block: Node) -> str:
    number = whole(block.word("slave_id"))
    return NO_UNIT if number is None else str(number)


def _add(found: Collecting, field: Field, location: str, behind: Sequence[Scaling]) -> None:
    called = field.node.word("name")
    keys = Keys(field.node)
    if keys.truth("omit") if field.node.word("omit").lower() in {"true", "false"} else False:
        return
    group = field.node.word("measurement") or field.block.word("measurement") or "Registers"
    make = field_of_list if field.table else field_of
    point = partial(make, called or "unnamed", found.place(field.node), field.block, field.table, location)
    found.add(called or "unnamed", field.node, lambda keys: scaled(point(keys), group, called, behind), group=group)


def _told(found: Collecting, one: Node, root: Node) -> None:
    """Tell what of the input, and of processors behind it, no map has."""
    processors = root.get("processors")
    if others := ", ".join(key for key in (processors.members if processors else None) or {} if key != "scale"):
        found.stated.append(f"what processors do with values is not taken over: {others}")
    taken = {"name", "slave_id", "string_register_location", "workarounds", *BLOCKS, *TABLES}
    told = ", ".join(key for key in one.members or {} if key not in taken)
    if told:
        found.stated.append(f"where the device answers and how it is polled is no fact of a map: {told}")


def _head(one: Node, unit: str) -> dict[str, object]:
    protocol: dict[str, object] = {}
    if 0 < int(unit) <= 247:  # noqa: PLR2004 - the last unit id
        protocol["default_unit"] = int(unit)
    around = one.get("workarounds")
    most = whole(around.word("max_word_registers_per_request")) if around else None
    if most and 0 < most < MOST_WORDS:
        protocol["limits"] = {"read_words": most}
    return {"protocol": protocol} if protocol else {}
