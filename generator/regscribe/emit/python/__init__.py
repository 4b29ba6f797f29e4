"""Typed drivers: one module a map, one class a model and kind of I/O, one declaration a register.

The text is laid out as `ruff format` would lay it out (line length 120), so nothing is formatted afterwards.
"""

import re
from collections.abc import Iterable
from functools import cache

from jinja2 import Environment, PackageLoader, StrictUndefined, Template

from regscribe.emit.header import header
from regscribe.emit.python.classes import Classes, givens_key
from regscribe.emit.python.layout import WIDTH, flat, lay, width
from regscribe.emit.python.literals import docstring, literal
from regscribe.emit.python.names import RUNTIME
from regscribe.emit.python.offer import Origin
from regscribe.emit.python.protocol import PROTOCOL, protocol_call, timeout
from regscribe.emit.python.siblings import build, libraries, library_module, module_path, natural
from regscribe.emit.text import one_line
from regscribe.model import GivenKind, RegisterMap

NOT_CODE = re.compile(r'"""[\s\S]*?"""|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)*\'|#[^\n]*')


def path_of(register_map: RegisterMap) -> str:
    """Where the driver of a map stands in the output tree."""
    return module_path(register_map.id)


def render(register_map: RegisterMap) -> dict[str, str]:
    """The driver module of a map and those that it imports, of its base and its libraries, as {path: text}."""
    return _files(build(register_map))


def _files(classes: Classes) -> dict[str, str]:
    below = _files(classes.below) if classes.below else {}
    shared = {module_path(library.id): library_module(library) for library in libraries(classes.register_map)}
    return {**below, **shared, path_of(classes.register_map): _module(classes.register_map, classes)}


def _module(register_map: RegisterMap, classes: Classes) -> str:
    named = classes.named.lines()
    own = [match[1] for line in named if (match := re.match(r"class (\w+)\(", line))]
    protocol = protocol_call(register_map.protocol)
    offered = classes.offer.constants.get(flat(protocol))
    givens_elsewhere = givens_key(register_map) in classes.offer.devices
    body = _template().render(
        constants=classes.pool.lines,
        protocol=[] if offered else lay(protocol, head=f"{PROTOCOL} = "),
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
    public = {*own, *classes.named.imported, *classes.public}
    about = f"{one_line(register_map.title)}: drivers of {', '.join(model.name for model in register_map.models)}."
    head = [
        *docstring(about, 0, classes.cited(origin.module for origin in classes.imports)),
        "",
        header(register_map, prefix="# ", separator="\n# "),
        "",
        *(["from collections.abc import Collection"] if "Collection" in used else []),
        *(["from typing import Self, Unpack"] if "Self" in used else []),
        *([""] if "Collection" in used or "Self" in used else []),
        *_import(used, classes.pool.hidden),
        *_siblings(origin for origin in imports if origin.name in used | public),
        "",
        *_all(sorted(public, key=natural)),
    ]
    return "\n".join(head) + "\n" + body


def _import(used: set[str], hidden_names: frozenset[str]) -> list[str]:
    names = [name for name in RUNTIME if name in used and name not in hidden_names]
    aliases = [name for name in RUNTIME if f"_{name}" in used and name in hidden_names]
    return [
        *(["from regscribe.runtime import (", *(f"    {name}," for name in names), ")"] if names else []),
        *(f"from regscribe.runtime import {name} as _{name}" for name in aliases),
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


def _all(names: list[str]) -> list[str]:
    return ["__all__ = [", *(f"    {literal(name)}," for name in names), "]", ""]


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


__all__ = ["path_of", "render", "timeout"]
