"""What the generated driver calls the classes of a register's values."""

from typing import Any

from regscribe.emit.python.enum_classes import NamedClasses, enum_content, special_content, specials, word_content
from regscribe.emit.python.library_modules import libraries, offered
from regscribe.emit.python.literals import camel
from regscribe.model import Kind, Register, RegisterMap

Json = Any


def named_classes(register_map: RegisterMap) -> NamedClasses:
    """Return the classes of a map's driver."""
    named = NamedClasses(register_map, offered(libraries(register_map)))
    named.collect_all()
    return named


def python_names(register: Register, named: NamedClasses) -> dict[str, Json]:
    """Return under `python` what is not called after its id: by `word`, `special`, or the id of an enum behind `enum `.

    An id of several enums, in cases, has an empty name: which of them is meant, it does not tell.
    """
    found: dict[str, str] = {}
    for enum in (*(register.enum.each if register.enum else ()), *(part.enum for part in register.fields)):
        if enum and enum.members:
            key, name = f"enum {enum.id}", named.name(enum.id, enum_content(enum))
            found[key] = name if found.get(key, name) == name else ""
    if register.kind in {Kind.FLAGS, Kind.FIELDS}:
        found["word"] = named.name(register.id, word_content(register))
    if specials(register):
        found["special"] = named.name(f"{register.id}_special", special_content(register))
    usual = {"word": camel(register.id), "special": camel(f"{register.id}_special")}
    other = {key: name for key, name in found.items() if name != (usual.get(key) or camel(key.removeprefix("enum ")))}
    return {"python": other} if other else {}
