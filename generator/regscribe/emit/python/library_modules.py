"""Modules of libraries: enums, flags and words that the drivers of several maps have in common."""

from regscribe.emit.python.enum_classes import NamedClasses, Origin
from regscribe.model import Library, Manual, RegisterMap
from regscribe.model.identifiers import module_names


def module_path(map_id: str) -> str:
    """Where the module of a map or library stands in the output tree."""
    return f"regscribe_devices/{'/'.join(module_names(map_id))}.py"


def libraries(register_map: RegisterMap) -> list[tuple[Library, NamedClasses]]:
    """The libraries of a map that have a module, with the classes in it."""
    found = [(library, library_classes(library)) for library in register_map.libraries]
    own = module_path(register_map.id)
    return [(library, named) for library, named in found if named.wanted and module_path(library.id) != own]


def library_classes(library: Library) -> NamedClasses:
    """The classes of a library: its enums, and those that the registers of its sets need."""
    as_map = RegisterMap(
        id=library.id,
        title=library.title,
        maker="",
        class_prefix="",
        source="",
        content_hash=library.content_hash,
        manual=Manual(""),
        models=library.sets,
    )
    named = NamedClasses(as_map)
    for enum in library.enums:
        named.declare(enum, library.id)
    named.collect_all()
    return named


def offered(found: list[tuple[Library, NamedClasses]]) -> dict[str, Origin]:
    """The classes that a driver may import from its libraries, by key; the first library that has one counts."""
    every: dict[str, Origin] = {}
    for library, named in found:
        module = module_path(library.id).removesuffix(".py").replace("/", ".")
        every = named.offered_by(module) | every
    return every
