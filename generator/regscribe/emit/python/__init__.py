"""Typed drivers: one module a map, one class a model and kind of I/O, one declaration a register.

The text is laid out as `ruff format` would lay it out (line length 120), so nothing is formatted afterwards.
"""

import re
from collections.abc import Iterable
from functools import cache

from jinja2 import Environment, PackageLoader, StrictUndefined, Template

from regscribe.emit.header import header_of
from regscribe.emit.python.classes import Classes, givens_key
from regscribe.emit.python.expressions import PROTOCOL, expression
from regscribe.emit.python.formatting import WIDTH, flat, lay, width
from regscribe.emit.python.literals import docstring, literal
from regscribe.emit.python.offer import Origin
from regscribe.emit.python.reserved_names import RUNTIME
from regscribe.emit.python.siblings import build, build_library, libraries, module_path
from regscribe.emit.words import one_line
from regscribe.model import GivenKind, Library, RegisterMap

STANDARD = (
    "from collections.abc import Collection",
    "from fractions import Fraction",
    "from typing import Self, Unpack",
)
"""What a module imports of the standard library, as far as it uses it."""

NOT_CODE = re.compile(r'"""[\s\S]*?"""|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)*\'|#[^\n]*')


def path_of(register_map: RegisterMap) -> str:
    """Where the driver of a map stands in the output tree."""
    return module_path(register_map.id)


def render(register_map: RegisterMap) -> dict[str, str]:
    """The driver module of a map and those that it imports, of its base and its libraries, as {path: text}.

    What comes with regscribe is imported from there and not made again.
    """
    installed = {module_path(map_id) for map_id in register_map.shipped}
    return {path: text for path, text in _files(build(register_map)).items() if path not in installed}


def _files(classes: Classes) -> dict[str, str]:
    register_map = classes.register_map
    below = _files(classes.below) if classes.below else {}
    shared = {module_path(library.id): _library(library) for library in libraries(register_map)}
    about = f"{one_line(register_map.title)}: drivers of {', '.join(model.name for model in register_map.models)}."
    return {**below, **shared, path_of(register_map): _module(classes, about, register_map.id)}


def _library(library: Library) -> str:
    about = f"{one_line(library.title)}: what the drivers of several maps share."
    return _module(build_library(library), about, f"{library.id}.library", protocol=library.protocol is not None)


def _module(classes: Classes, about: str, source: str, *, protocol: bool = True) -> str:
    register_map = classes.register_map
    named = classes.named.lines()
    own = [match[1] for line in named if (match := re.match(r"class (\w+)\(", line))]
    line = expression(register_map.protocol)
    offered = classes.offer.constants.get(flat(line))
    givens_elsewhere = givens_key(register_map) in classes.offer.devices
    body = _template().render(
        constants=classes.pool.lines,
        protocol=lay(line, head=f"{PROTOCOL} = ") if protocol and not offered else [],
        named=named,
        classes=classes.lines,
        stem=classes.stem,
        givens=[
            {"id": given.id, "type": "Collection[int]" if given.kind is GivenKind.CODES else "bool"}
            for given in (() if givens_elsewhere else register_map.givens)
        ],
    )
    imports = {
        *classes.imports,
        *classes.pool.imports,
        *classes.named.imports.values(),
        *([offered] if offered else []),
    }
    used = set(re.findall(r"\w+", NOT_CODE.sub("", body)))
    standard = [line for line in STANDARD if used & set(re.findall(r"[A-Z]\w+", line))]
    public = {*own, *classes.named.imported, *classes.public}
    head = [
        *docstring(about, 0, classes.cited(origin.module for origin in classes.imports)),
        "",
        header_of(source, register_map.content_hash, prefix="# ", separator="\n# "),
        "",
        *standard,
        *([""] if standard else []),
        *_siblings(origin for origin in imports if origin.name in used | public),
        *_import(used, classes.pool.hidden),
        "",
        *_all(sorted(public, key=natural)),
        *([] if body.startswith("\n") else [""]),
    ]
    return "\n".join(head) + "\n" + body


def _import(used: set[str], hidden_names: frozenset[str]) -> list[str]:
    names = [name for name in RUNTIME if name in used and name not in hidden_names]
    aliases = [name for name in RUNTIME if f"_{name}" in used and name in hidden_names]
    return [
        *(["from regscribe_runtime import (", *(f"    {name}," for name in names), ")"] if names else []),
        *(f"from regscribe_runtime import {name} as _{name}" for name in aliases),
    ]


def _siblings(origins: Iterable[Origin]) -> list[str]:
    """Imports of what other generated modules have, each name on a line of its own."""
    imports, lines = set(origins), list[str]()
    for module in sorted({origin.module for origin in imports}):
        names = sorted({origin.name for origin in imports if origin.module == module}, key=_import_order)
        whole = f"from {module} import {', '.join(names)}"
        many = [f"from {module} import (", *(f"    {name}," for name in names), ")"]
        lines += [whole] if width(whole) <= WIDTH else many
    return lines


def _import_order(name: str) -> tuple[object, ...]:
    # the order that ruff asks of imported names: constants, classes, the rest, each without regard to case
    kind = 0 if name.isupper() and len(name) > 1 else 1 if name[:1].isupper() else 2
    return kind, natural(name.lower())[1], natural(name)[1]


def natural(name: str) -> tuple[bool, list[tuple[str, int]]]:
    """The order that ruff asks of `__all__`: names in capitals first, and numbers inside names count as numbers."""
    parts = re.findall(r"\d+|\D", name)
    capitals = name.isupper() and len(name) > 1
    return not capitals, [("", int(part)) if part.isdecimal() else (part, 0) for part in parts]


def _all(names: list[str]) -> list[str]:
    return ["__all__ = [", *(f"    {literal(name)}," for name in names), "]"]


@cache
def _template() -> Template:
    environment = Environment(
        loader=PackageLoader("regscribe.emit.python", "."),
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        undefined=StrictUndefined,
        autoescape=False,  # noqa: S701 (Python, not HTML: every text of a map went through `literals`)
    )
    return environment.get_template("driver.py.j2")
