"""A module as others see it: what the driver of a base and the modules of libraries have to offer."""

from dataclasses import replace

from regscribe.emit.python.classes import COMMANDS, Classes, givens_key
from regscribe.emit.python.constants import Pool
from regscribe.emit.python.enum_classes import NamedClasses
from regscribe.emit.python.expressions import PROTOCOL, expression
from regscribe.emit.python.formatting import flat
from regscribe.emit.python.keys import command_key
from regscribe.emit.python.literals import camel
from regscribe.emit.python.offer import Offer, Origin, Part
from regscribe.emit.python.reserved_names import hidden
from regscribe.model import Array, Library, Manual, Model, Protocol, Register, RegisterMap


def module_path(map_id: str) -> str:
    """Where the module of a map or library stands in the output tree."""
    return f"regscribe_devices/{map_id.replace('-', '_')}.py"


def module_name(map_id: str) -> str:
    """The name under which the module of a map or library is imported."""
    return module_path(map_id).removesuffix(".py").replace("/", ".")


def build(register_map: RegisterMap) -> Classes:
    """The classes of a map's driver, with all that it can import from its base and its libraries."""
    below = build(register_map.base) if register_map.base else None
    stem, offer = camel(register_map.id.split("/")[1]), _below(register_map, below)
    named = NamedClasses(register_map, offer.named)
    _collect(named)
    pool = Pool(hidden(register_map), offer.constants)
    classes = Classes(register_map, named, pool, stem, module_name(register_map.id), offer, below)
    classes.build()
    return classes


def build_library(library: Library) -> Classes:
    """The classes of a library's module: a class for each set, as if the sets were the models of a map."""
    register_map = _as_map(library)
    named = NamedClasses(register_map)
    for enum in library.enums:
        if enum.members:
            named.declare(enum, library.id)
    _collect(named)
    stem, module = camel(library.id.split("/")[1]), module_name(library.id)
    classes = Classes(register_map, named, Pool(hidden(register_map)), stem, module, Offer())
    classes.build_library()
    return classes


def _as_map(library: Library) -> RegisterMap:
    commands = Model(name=library.id, class_name="", commands=library.commands)
    return RegisterMap(
        id=library.id,
        title=library.title,
        maker="",
        class_prefix="",
        source="",
        content_hash=library.content_hash,
        manual=Manual(""),
        models=(commands, *map(_set, library.sets)),
        protocol=library.protocol or Protocol(),
    )


def _set(model: Model) -> Model:
    """A set without its arrays: their elements would need the section that each map tells of them."""
    registers = tuple(member for member in model.members if isinstance(member, Register))
    return replace(model, name=camel(model.name), members=registers, registers=registers)


def _collect(named: NamedClasses) -> None:
    """Note all classes of values that a map needs."""
    found = [(register, model.name) for model in named.register_map.models for register in _registers(model.members)]
    for register, model in found:
        named.collect(register, model)
    for register, model in found:
        named.collect_words(register, model)


def _registers(members: tuple[Register | Array, ...]) -> list[Register]:
    return [
        register
        for member in members
        for register in (_registers(member.members) if isinstance(member, Array) else [member])
    ]


def libraries(register_map: RegisterMap) -> list[Library]:
    """The libraries of a map that have a module: something to share, and a path that no map in the chain has."""
    chain = {module_path(register_map.id)}
    base = register_map.base
    while base:
        chain.add(module_path(base.id))
        base = base.base
    return [library for library in register_map.libraries if _shares(library) and module_path(library.id) not in chain]


def _shares(library: Library) -> bool:
    return bool(library.enums or library.sets or library.commands or library.protocol)


def _below(register_map: RegisterMap, base: Classes | None) -> Offer:
    """All that a map's module may import, from its base and its libraries."""
    found = offer_of(base).renumbered(dict(register_map.renumber)) if base else Offer()
    for library in libraries(register_map):
        found = _with_library(found, offer_of(build_library(library)), library)
    return found


def _with_library(offer: Offer, own: Offer, library: Library) -> Offer:
    """What there is with a library, too; what the base has comes first."""
    parts = dict(offer.parts)
    parts[COMMANDS] = (*parts.get(COMMANDS, ()), *own.parts.get(COMMANDS, ()))
    constants = dict(own.constants)
    if library.protocol is None:
        constants = {text: origin for text, origin in constants.items() if origin.name != PROTOCOL}
    return replace(
        offer,
        named={**own.named, **offer.named},
        parts=parts,
        sets=(*offer.sets, *own.parts.get("", ())),
        commands={**own.commands, **offer.commands},
        constants={**constants, **offer.constants},
    )


def offer_of(classes: Classes) -> Offer:
    """What the driver of a map has to offer, with what it imports itself."""
    register_map, named, pool, module = classes.register_map, classes.named, classes.pool, classes.module
    own_named = {
        named.keys[content]: named.imports.get(content) or Origin(module, named.name(wanted, content))
        for wanted, variants in named.wanted.items()
        for content in variants
    }
    imported = {origin.name: origin for origin in pool.imports}
    protocol = flat(expression(register_map.protocol))
    devices = {givens_key(register_map): Origin(module, f"_{classes.stem}Device")} if register_map.givens else {}
    return Offer(
        named=own_named,
        parts=_parts(classes),
        elements=_elements(classes),
        commands={parents: origin for parents, origin in classes.commands.items() if parents},
        constants={text: imported.get(name) or Origin(module, name) for text, name in pool.names.items()}
        | {protocol: classes.offer.constants.get(protocol) or Origin(module, PROTOCOL)},
        devices=devices | dict(classes.offer.devices) if devices.keys() & classes.offer.devices.keys() else devices,
        groups=classes.groups,
        sections=classes.offer.sections,
    )


def _parts(classes: Classes) -> dict[str, tuple[Part, ...]]:
    found: dict[str, list[Part]] = {}
    for owner, shared in classes.built.items():
        for one in shared:
            items = {item.id: classes.keys(one.models[0]).of(item) for item in one.items}
            found.setdefault(owner, []).append(Part(Origin(classes.module, one.name), items))
    for owner, told in classes.told.items():
        found.setdefault(owner, []).extend(told)
    for commands in classes.built_commands:
        keys = {command.id: command_key(command) for command in commands.items}
        found.setdefault(COMMANDS, []).append(Part(Origin(classes.module, commands.name), keys))
    for owner, parts in classes.offer.parts.items():
        found.setdefault(owner, []).extend(part for part in parts if part.origin in classes.imports)
    return {owner: tuple(parts) for owner, parts in found.items()}


def _elements(classes: Classes) -> dict[str, Origin]:
    own = {classes.keys(model).element(array): origin for array, model, origin in classes.elements}
    return own | {key: origin for key, origin in classes.offer.elements.items() if origin in classes.imports}
