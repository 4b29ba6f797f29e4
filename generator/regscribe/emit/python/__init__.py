"""Typed drivers: one module a map, one class a model and kind of I/O, one declaration a register.

The text is laid out as `ruff format` would lay it out (line length 120), so nothing is formatted afterwards.
"""

import re
from collections.abc import Iterable, Sequence
from functools import cache
from itertools import groupby

from jinja2 import Environment, PackageLoader, StrictUndefined, Template

from regscribe.emit.header import header_of
from regscribe.emit.python.classes import Classes
from regscribe.emit.python.constants import PROTOCOL, Pool
from regscribe.emit.python.enum_classes import NamedClasses, Origin
from regscribe.emit.python.expressions import expression
from regscribe.emit.python.formatting import WIDTH, lay, width
from regscribe.emit.python.givens import checked, default_of, type_of
from regscribe.emit.python.library_modules import libraries, module_path, offered
from regscribe.emit.python.literals import camel, docstring, literal
from regscribe.emit.python.reserved_names import RUNTIME, hidden
from regscribe.emit.words import one_line
from regscribe.model import Library, RegisterMap
from regscribe.model.identifiers import module_names

STANDARD = {
    "collections.abc": ["Collection"],
    "fractions": ["Fraction"],
    "typing": ["Any", "Literal", "Self", "Unpack"],
}
"""What a module imports of the standard library, as far as it uses it."""

NOT_CODE = re.compile(r'"""[\s\S]*?"""|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)*\'|#[^\n]*')


def render(register_map: RegisterMap) -> dict[str, str]:
    """The driver module of a map and the modules of its libraries, as {path: text}.

    The module of a library that comes with regscribe is imported from there and not made again.
    """
    used = libraries(register_map)
    modules = {
        module_path(library.id): _library(library, named)
        for library, named in used
        if library.id not in register_map.shipped
    }
    named = NamedClasses(register_map, offered(used))
    named.collect_all()
    return {**modules, module_path(register_map.id): _driver(register_map, named)}


def _library(library: Library, named: NamedClasses) -> str:
    about = f"{one_line(library.title)}: named values that several drivers share."
    source = _source(f"{library.id}.library", library.content_hash)
    return _module(about, source, named, "\n".join([*named.lines(), ""]))


def _driver(register_map: RegisterMap, named: NamedClasses) -> str:
    about = f"{one_line(register_map.title)}: drivers of {', '.join(model.name for model in register_map.models)}."
    source = _source(register_map.id, register_map.content_hash)
    pool = Pool(hidden(register_map))
    classes = Classes(register_map, named, pool, camel(module_names(register_map.id)[1]))
    classes.build()
    body = _template().render(
        protocol=lay(expression(register_map.protocol), head=f"{PROTOCOL} = "),
        constants=pool.lines,
        named=named.lines(),
        classes=classes.lines,
        stem=classes.stem,
        givens=[
            {"id": given.id, "type": type_of(given), "value": checked(given), "default": default_of(given)}
            for given in register_map.givens
        ],
    )
    return _module(about, source, named, body, classes.public, pool.hidden)


def _source(origin_id: str, content_hash: str) -> str:
    """What a module comes from, as a comment."""
    whole = header_of(origin_id, content_hash, prefix="# ", separator="\n# ")
    long = any(width(line) > WIDTH for line in whole.splitlines())
    return whole.replace("; regenerate", ";\n# regenerate") if long else whole


def _module(
    about: str,
    source: str,
    named: NamedClasses,
    body: str,
    classes: Iterable[str] = (),
    hidden_names: frozenset[str] = frozenset(),
) -> str:
    own = re.findall(r"^class (\w+)\(", "\n".join(named.lines()), re.MULTILINE)
    used = set(re.findall(r"\w+", NOT_CODE.sub("", body)))
    standard = [line for module, names in STANDARD.items() for line in _import(module, sorted(used & {*names}))]
    head = [
        *docstring(about, 0),
        "",
        source,
        "",
        *standard,
        *([""] if standard else []),
        *_library_imports(named.imports.values()),
        *_import("regscribe_runtime", [name for name in RUNTIME if name in used - hidden_names]),
        *(f"from regscribe_runtime import {name} as _{name}" for name in sorted(hidden_names) if f"_{name}" in used),
        "",
        "__all__ = [",
        *(f"    {literal(name)}," for name in sorted({*own, *named.imported, *classes}, key=_natural)),
        "]",
        *([] if body.startswith("\n") else [""]),
    ]
    return "\n".join(head) + "\n" + body


def _library_imports(origins: Iterable[Origin]) -> list[str]:
    """Imports of named values from the modules of libraries."""
    lines: list[str] = []
    for module, found in groupby(sorted(set(origins)), lambda origin: origin.module):
        lines += _import(module, sorted((origin.name for origin in found), key=_import_order))
    return lines


def _import(module: str, names: Sequence[str]) -> list[str]:
    if not names:
        return []
    whole = f"from {module} import {', '.join(names)}"
    return [whole] if width(whole) <= WIDTH else [f"from {module} import (", *(f"    {name}," for name in names), ")"]


def _import_order(name: str) -> tuple[object, ...]:
    # the order that ruff asks of imported names: constants, classes, the rest, each without regard to case
    kind = 0 if name.isupper() and len(name) > 1 else 1 if name[:1].isupper() else 2
    return kind, _natural(name.lower())[1], _natural(name)[1]


def _natural(name: str) -> tuple[bool, list[tuple[str, int]]]:
    """The order that ruff asks of `__all__`: names in capitals first, and numbers inside names count as numbers."""
    parts = re.findall(r"\d+|\D", name)
    capitals = name.isupper() and len(name) > 1
    return not capitals, [("", int(part)) if part.isdecimal() else (part, 0) for part in parts]


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
