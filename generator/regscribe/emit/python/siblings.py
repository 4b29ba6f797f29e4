"""A module as others see it: what the driver of a base and the modules of libraries have to offer."""

import re
from dataclasses import replace

from regscribe.emit.header import header_of
from regscribe.emit.python.classes import COMMANDS, Classes, givens_key
from regscribe.emit.python.keys import command_key
from regscribe.emit.python.layout import flat
from regscribe.emit.python.literals import camel, docstring, literal
from regscribe.emit.python.named import NamedClasses, enum_body, enum_key
from regscribe.emit.python.names import free, hidden, reserved
from regscribe.emit.python.offer import Offer, Origin, Part
from regscribe.emit.python.pool import Pool
from regscribe.emit.python.protocol import PROTOCOL, protocol_call
from regscribe.emit.text import one_line
from regscribe.model import Array, Library, Register, RegisterMap


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
    for model in register_map.models:
        for register in _registers(model.members):
            named.collect(register, model.name)
    for model in register_map.models:
        for register in _registers(model.members):
            named.collect_words(register, model.name)
    pool = Pool(hidden(register_map), offer.constants)
    classes = Classes(register_map, named, pool, stem, module_name(register_map.id), offer, below)
    classes.build()
    return classes


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
    return [library for library in register_map.libraries if library.enums and module_path(library.id) not in chain]


def library_module(library: Library) -> str:
    """The module of a library: its enums."""
    lines: list[str] = []
    names = _library_names(library)
    for enum in library.enums:
        if enum.id in names:
            opening, *body = enum_body(enum, f"{enum.id.replace('_', ' ').capitalize()}.")
            lines += ["", "", f"class {names[enum.id]}({opening}):", *body]
    head = [
        *docstring(f"{one_line(library.title)}: what the drivers of several maps share.", 0),
        "",
        header_of(f"{library.id}.library", library.content_hash, prefix="# ", separator="\n# "),
        "",
        "from regscribe.runtime import Choice",
        "",
        "__all__ = [",
        *(f"    {literal(name)}," for name in sorted(names.values(), key=natural)),
        "]",
    ]
    return "\n".join([*head, *lines]) + "\n"


def _library_names(library: Library) -> dict[str, str]:
    """The class of each enum; of two ids with one name, only the first has one."""
    names: dict[str, str] = {}
    for enum in library.enums:
        name = free(camel(enum.id), reserved(), "Value")
        if enum.members and name not in names.values():
            names[enum.id] = name
    return names


def natural(name: str) -> tuple[bool, list[tuple[str, int]]]:
    """The order that ruff asks of `__all__`: names in capitals first, and numbers inside names count as numbers."""
    parts = re.findall(r"\d+|\D", name)
    capitals = name.isupper() and len(name) > 1
    return not capitals, [("", int(part)) if part.isdecimal() else (part, 0) for part in parts]


def _below(register_map: RegisterMap, base: Classes | None) -> Offer:
    """All that a map's module may import, from its base and its libraries."""
    named: dict[str, Origin] = {}
    for library in libraries(register_map):
        names = _library_names(library)
        module = module_name(library.id)
        named |= {enum_key(enum): Origin(module, names[enum.id]) for enum in library.enums if enum.id in names}
    if base is None:
        return Offer(named=named)
    offer = offer_of(base).renumbered(dict(register_map.renumber))
    return replace(offer, named=named | dict(offer.named))


def offer_of(classes: Classes) -> Offer:
    """What the driver of a map has to offer, with what it imports itself."""
    register_map, named, pool, module = classes.register_map, classes.named, classes.pool, classes.module
    own_named = {
        named.keys[content]: named.imports.get(content) or Origin(module, named.name(wanted, content))
        for wanted, variants in named.wanted.items()
        for content in variants
    }
    imported = {origin.name: origin for origin in pool.imports}
    protocol = flat(protocol_call(register_map.protocol))
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
    for commands in classes.built_commands:
        items = {command.id: command_key(command) for command in commands.items}
        found.setdefault(COMMANDS, []).append(Part(Origin(classes.module, commands.name), items))
    for owner, parts in classes.offer.parts.items():
        found.setdefault(owner, []).extend(part for part in parts if part.origin in classes.imports)
    return {owner: tuple(parts) for owner, parts in found.items()}


def _elements(classes: Classes) -> dict[str, Origin]:
    own = {classes.keys(model).element(array): origin for array, model, origin in classes.elements}
    return own | {key: origin for key, origin in classes.offer.elements.items() if origin in classes.imports}
