"""Typed drivers: one module a map, one class a model and kind of I/O, one declaration a register.

The text is laid out as `ruff format` would lay it out (line length 120), so nothing is formatted afterwards.
"""

import re
from functools import cache

from jinja2 import Environment, PackageLoader, StrictUndefined, Template

from regscribe.emit.header import header
from regscribe.emit.python.classes import Classes
from regscribe.emit.python.layout import Call, call, group, lay, mapping
from regscribe.emit.python.literals import camel, docstring, literal
from regscribe.emit.python.named import NamedClasses
from regscribe.emit.python.names import RUNTIME, hidden
from regscribe.emit.python.pool import Pool
from regscribe.emit.text import one_line
from regscribe.model import Array, GivenKind, Protocol, Register, RegisterMap

NOT_CODE = re.compile(r'"""[\s\S]*?"""|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)*\'|#[^\n]*')
MARGIN_SECONDS = 0.5
"""Added to the manual's longest latency for the frames themselves and for a gateway."""
SHORTEST_TIMEOUT = 1.0


def path_of(register_map: RegisterMap) -> str:
    """Where the driver of a map stands in the output tree."""
    maker, family = register_map.id.replace("-", "_").split("/")
    return f"regscribe_devices/{maker}/{family}.py"


def render(register_map: RegisterMap) -> dict[str, str]:
    """The driver module of a map, as {path: text}."""
    stem = camel(register_map.id.split("/")[1])
    named, pool = NamedClasses(register_map), Pool(hidden(register_map))
    for model in register_map.models:
        for register in _registers(model.members):
            named.collect(register, model.name)
    for model in register_map.models:
        for register in _registers(model.members):
            named.collect_words(register, model.name)
    classes = Classes(register_map, named, pool, stem)
    classes.build()
    return {path_of(register_map): _module(register_map, classes)}


def _registers(members: tuple[Register | Array, ...]) -> list[Register]:
    return [
        register
        for member in members
        for register in (_registers(member.members) if isinstance(member, Array) else [member])
    ]


def _module(register_map: RegisterMap, classes: Classes) -> str:
    named = classes.named.lines()
    names = [match[1] for line in named if (match := re.match(r"class (\w+)\(", line))]
    body = _template().render(
        constants=classes.pool.lines,
        protocol=lay(_protocol(register_map.protocol), head="_PROTOCOL = "),
        named=named,
        classes=classes.lines,
        stem=classes.stem,
        givens=[
            {"id": given.id, "type": "Collection[int]" if given.kind is GivenKind.CODES else "bool"}
            for given in register_map.givens
        ],
    )
    used = set(re.findall(r"\w+", NOT_CODE.sub("", body)))
    head = [
        *docstring(f"{one_line(register_map.title)}: drivers of {', '.join(m.name for m in register_map.models)}.", 0),
        "",
        header(register_map, prefix="# ", separator="\n# "),
        "",
        *(["from collections.abc import Collection"] if "Collection" in used else []),
        *(["from typing import Self, Unpack"] if "Self" in used else []),
        *([""] if "Collection" in used or "Self" in used else []),
        *_import(used, classes.pool.hidden),
        "",
        *_all(sorted({*names, *classes.public, f"{classes.stem}Groups"}, key=_natural)),
    ]
    return "\n".join(head) + "\n" + body


def _import(used: set[str], hidden_names: frozenset[str]) -> list[str]:
    names = [name for name in RUNTIME if name in used and name not in hidden_names]
    aliases = [name for name in RUNTIME if f"_{name}" in used and name in hidden_names]
    return [
        "from regscribe.runtime import (",
        *(f"    {name}," for name in names),
        ")",
        *(f"from regscribe.runtime import {name} as _{name}" for name in aliases),
    ]


def _all(names: list[str]) -> list[str]:
    return ["__all__ = [", *(f"    {literal(name)}," for name in names), "]", ""]


def _natural(name: str) -> tuple[bool, list[tuple[str, int]]]:
    # the order that ruff asks of __all__: names in capitals first, and numbers inside names count as numbers
    parts = re.findall(r"\d+|\D", name)
    capitals = name.isupper() and len(name) > 1
    return not capitals, [("", int(part)) if part.isdecimal() else (part, 0) for part in parts]


def _protocol(protocol: Protocol) -> Call:
    serial = protocol.serial
    return call(
        "Protocol",
        functions=group([str(code) for code in protocol.functions]),
        read_words=str(protocol.read_words),
        write_words=str(protocol.write_words),
        read_bits=str(protocol.read_bits),
        read_holes=str(protocol.read_holes),
        unit_ids=group([str(unit) for unit in protocol.unit_ids]),
        exceptions=mapping(
            [(str(one.code), group([literal(one.name), literal(one_line(one.meaning))])) for one in protocol.exceptions]
        ),
        timeout=str(timeout(protocol)),
        baud=str(serial.default_baud) if serial.default_baud else None,
        format=literal(serial.default_format) if serial.default_format else None,
        modes=group([literal(mode) for mode in serial.modes]),
    )


def timeout(protocol: Protocol) -> float:
    """Seconds after which no good answer can come: the longest latency of a full request and a margin."""
    words = max(protocol.read_words, protocol.write_words)
    longest = max((one.maximum + one.maximum_per_word * words for one in protocol.latencies), default=0)
    return max(SHORTEST_TIMEOUT, float(longest) / 1000 + MARGIN_SECONDS)


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
