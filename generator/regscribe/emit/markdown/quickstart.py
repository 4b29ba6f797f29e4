"""A first program for this device: which registers it shows is chosen by their properties, never by their names."""

import re

from regscribe.emit.markdown.context import PageContext
from regscribe.emit.markdown.escape import Md
from regscribe.model import Group, Kind, Model, Register, show

ADDRESS = "192.0.2.10"
"""An address that is reserved for documentation (RFC 5737)."""


def quick_start(context: PageContext) -> dict[str, tuple[Md, ...]]:
    """Return a synchronous and an asynchronous example of the map's first model."""
    model = context.map.models[0]
    maker, _, family = context.map.id.partition("/")
    module = ".".join(("regscribe_devices", *(part.replace("-", "_") for part in (maker, family))))
    names = (model.class_name, f"Async{model.class_name}")
    arguments = "".join(f", {given.id}=..." for given in context.map.givens)
    opened = [f'{name}.tcp("{ADDRESS}", unit={_unit(context)}{arguments})' for name in names]
    return {
        "sync_lines": _code(
            f"from {module} import {names[0]}",
            "",
            f"with {opened[0]} as controller:",
            *_body(model, asynchronous=False),
        ),
        "async_lines": _code(
            f"from {module} import {names[1]}",
            "",
            "",
            "async def main() -> None:",
            f"    async with {opened[1]} as controller:",
            *(f"    {line}" for line in _body(model, asynchronous=True)),
        ),
    }


def _unit(context: PageContext) -> int:
    default = context.map.default_unit
    return default if default is not None else context.map.protocol.unit_ids[0]


def _code(*lines: str) -> tuple[Md, ...]:
    """Return lines of a fenced block; nothing in an id may leave its line or end the block."""
    return tuple(Md(re.sub(r"[\r\n`]", " ", line)) for line in lines)


def _body(model: Model, *, asynchronous: bool) -> list[str]:
    wait = "await " if asynchronous else ""
    lines: list[str] = []
    shown = shown_register(model)
    if shown:
        lines.append(f"    print({wait}controller.{shown.path}.read())")
    group = shown_group(model, shown)
    if group:
        lines.append(f"    print({wait}controller.read(controller.groups.{group.id}))")
    written = written_register(model)
    if written:
        lines.append(f"    {wait}controller.{written.path}.write({_literal(written)})")
    return lines or ["    pass"]


def shown_register(model: Model) -> Register | None:
    """Return what a user wants to see first: a measured number, best with faults, aliases or a unit by condition."""
    readable = [register for register in model.registers if register.access.readable]
    measured = [register for register in readable if not register.access.writable and register.kind is Kind.NUMBER]
    return max(measured or readable, key=_interest, default=None)


def _interest(register: Register) -> int:
    return bool(register.sentinels) + bool(register.aliases) + bool(register.unit_id)


def shown_group(model: Model, shown: Register | None) -> Group | None:
    """Return the group of the register that is shown, else the first one."""
    groups = [group for group in model.groups if shown and group.id == shown.group] or model.groups
    return groups[0] if groups else None


def written_register(model: Model) -> Register | None:
    """Return a number that may be written without harm or preparation, and has a default to write."""
    shown = shown_register(model)
    group = shown.group if shown else ""
    harmless = (register for register in model.registers if _harmless(register))
    return max(harmless, key=lambda register: _fitness(register, group), default=None)


def _fitness(register: Register, group: str) -> int:
    """Rank what is near the value that was read, a number, and not worn out by writing."""
    return (register.group == group) + (register.kind is Kind.NUMBER) + (register.persistence not in {"eeprom", "both"})


def _harmless(register: Register) -> bool:
    prepared = register.writable or register.unlock or register.apply or register.rescales or register.danger
    plain = register.kind in {Kind.NUMBER, Kind.INTEGER} and register.access.writable and not register.specials
    return plain and not prepared and isinstance(_default(register), str)


def _default(register: Register) -> str | None:
    default = register.default
    return None if default is None or isinstance(default, str) or "/" in show(default) else show(default)


def _literal(register: Register) -> str:
    return _default(register) or ""
