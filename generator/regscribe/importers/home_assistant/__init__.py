"""The importer of Home Assistant's configuration of modbus: each entity is a register, or several.

One hub and one unit id make a map. A value is scale x raw + offset; integers are int16 and the most significant word is
first where nothing else is said, as the integration takes it.
"""

from collections.abc import Iterator, Mapping

from regscribe.draft import Draft
from regscribe.files import OneLine
from regscribe.importers.home_assistant.outputs import climates, covers, switches
from regscribe.importers.home_assistant.sensors import SHOWN, binary_sensor, sensor
from regscribe.importers.shared.document import Collecting, chosen, has, reads, text_of
from regscribe.importers.shared.exact import whole
from regscribe.importers.shared.read_yaml import read_yaml
from regscribe.importers.shared.tree import Node, TreeError
from regscribe.plugins import Likeness, Option

name = "home-assistant"
summary = "`modbus:` of Home Assistant, one hub and unit id"
options = (
    Option("hub", "name of the hub; needed where there are several.", metavar="NAME"),
    Option("unit", "unit id; needed where entities have several.", metavar="N"),
)

PLATFORMS = {
    "sensors": "Sensors",
    "binary_sensors": "Binary sensors",
    "switches": "Switches",
    "lights": "Lights",
    "fans": "Fans",
    "covers": "Covers",
    "climates": "Climates",
}
"""The lists of entities, and the groups that they become."""

TAKEN = frozenset({"name", "message_wait_milliseconds", *PLATFORMS})
NO_UNIT = "0"
"""The unit id of entities that name none."""

MOST_PAUSE = 60_000


def likeness(data: bytes, name: str) -> Likeness:  # noqa: ARG001 - the contract of importers
    """Surely, by a list `modbus` with a hub in it; perhaps by a list of entities alone."""
    kinds = "|".join(PLATFORMS)
    if has(data, r"^modbus\s*:", rf"^\s+(- )?({kinds})\s*:", r"^\s+-?\s*type\s*:"):
        return Likeness.SURE
    return Likeness.PERHAPS if has(data, rf"^[\s-]*({kinds})\s*:", r"^\s+(- )?address\s*:") else Likeness.NO


@reads
def read(data: bytes, name: str, options: Mapping[str, str]) -> Draft:
    """Return the registers of one hub and unit. Raises OptionError where it is not clear which."""
    root, doubled = read_yaml(text_of(data))
    hubs = _hubs(root)
    hub = hubs[chosen("hub", options.get("hub", ""), [*hubs], "hub")]
    units = {_unit(entity): None for _, entity in _entities(hub)} or {NO_UNIT: None}
    unit = chosen("unit", options.get("unit", ""), [*units], "unit id")
    found = Collecting(name, SHOWN)
    found.doubled(doubled)
    for platform, entity in _entities(hub):
        if _unit(entity) == unit:
            _add(found, platform, entity)
    connection = ", ".join(key for key in hub.members or {} if key not in TAKEN)
    if connection:
        found.stated.append(f"where the device answers is no fact of a map: {connection}")
    found.stated.append(
        "where an entity gives no data_type it is an int16, and without a swap the most significant word is first"
    )
    return found.draft(title=hub.word("name"), head=_head(hub, unit))


def _hubs(root: Node) -> dict[str, Node]:
    """The hubs by name. Raises TreeError where there is none."""
    top = root.get("modbus") or root
    hubs = [one for one in top.each if any(one.get(platform) for platform in PLATFORMS)]
    if not hubs:
        message = "there is no hub with entities (`modbus:` with `sensors:` and the like)"
        raise TreeError(top.line, message, "is this the configuration of another integration, or only included?")
    named: dict[str, Node] = {}
    for number, hub in enumerate(hubs, start=1):
        word = hub.word("name") or f"hub {number}"
        named[word if word not in named else f"{word} {number}"] = hub
    return named


def _entities(hub: Node) -> Iterator[tuple[str, Node]]:
    for platform in PLATFORMS:
        entities = hub.get(platform)
        yield from ((platform, one) for one in (entities.each if entities else ()))


def _unit(entity: Node) -> str:
    text = entity.word("device_address") or entity.word("slave") or NO_UNIT
    number = whole(text)
    return text if number is None else str(number)


def _add(found: Collecting, platform: str, entity: Node) -> None:
    name, group = entity.word("name") or "unnamed", PLATFORMS[platform]
    if platform == "sensors":
        found.add(name, entity, lambda keys: sensor(keys, name, found.place(entity), group))
    elif platform == "binary_sensors":
        binary_sensor(found, entity, name, group)
    elif platform == "climates":
        climates(found, entity, name, group)
    elif platform == "covers":
        covers(found, entity, name, group)
    else:
        switches(found, entity, name, group)


def _head(hub: Node, unit: str) -> dict[str, object]:
    protocol: dict[str, object] = {}
    if unit.isdecimal() and 0 < int(unit) <= 247:  # noqa: PLR2004 - the last unit id
        protocol["default_unit"] = int(unit)
    pause = whole(hub.word("message_wait_milliseconds"))
    if pause and 0 < pause <= MOST_PAUSE:
        protocol["pause"] = pause
    return {"protocol": OneLine(protocol)} if protocol else {}
