"""A first program for this device: which registers it shows is chosen by their properties, never by their names."""

import re

from regscribe.emit.markdown.context import PageContext
from regscribe.emit.markdown.escape import Md
from regscribe.model import Kind, Model, Register, show
from regscribe.model.identifiers import module_names

ADDRESS = "192.0.2.10"
"""An address that is reserved for documentation (RFC 5737)."""


def quick_start(context: PageContext) -> dict[str, tuple[Md, ...]]:
    """Return a synchronous and an asynchronous example of the map's first model."""
    model = context.map.models[0]
    module = ".".join(("regscribe_devices", *module_names(context.map.id)))
    default = context.map.default_unit
    unit = context.map.protocol.unit_ids[0] if default is None else default
    arguments = "".join(f", {given.id}=..." for given in context.map.givens)
    opened = f'{model.class_name}.tcp("{ADDRESS}", unit={unit}{arguments}) as controller:'
    return {
        "sync_lines": _code(
            f"from {module} import {model.class_name}",
            "",
            f"with {opened}",
            *(f"    {line}" for line in _body(model, wait="")),
        ),
        "async_lines": _code(
            f"from {module} import Async{model.class_name}",
            "",
            "",
            "async def main() -> None:",
            f"    async with Async{opened}",
            *(f"        {line}" for line in _body(model, wait="await ")),
        ),
    }


def _code(*lines: str) -> tuple[Md, ...]:
    """Return lines of a fenced block; nothing in an id may leave its line or end the block."""
    return tuple(Md(re.sub(r"[\r\n`]", " ", line)) for line in lines)


def _body(model: Model, *, wait: str) -> list[str]:
    lines: list[str] = []
    shown = _shown_register(model)
    group = shown.group if shown else ""
    if shown:
        lines.append(f"print({wait}controller.{shown.path}.read())")
    groups = [found.id for found in model.groups]
    if groups:
        lines.append(f"print({wait}controller.read(controller.groups.{group if group in groups else groups[0]}))")
    written = _written_register(model, group)
    if written:
        lines.append(f"{wait}controller.{written.path}.write({_default(written)})")
    return lines or ["pass"]


def _shown_register(model: Model) -> Register | None:
    """Return the register to read: a measured number, best with faults, aliases or a unit by condition."""

    def interest(register: Register) -> int:
        return bool(register.sentinels) + bool(register.aliases) + bool(register.unit_id)

    readable = [register for register in model.registers if register.access.readable]
    measured = [register for register in readable if not register.access.writable and register.kind is Kind.NUMBER]
    return max(measured or readable, key=interest, default=None)


def _written_register(model: Model, group: str) -> Register | None:
    """Return a number that may be written without harm or preparation, and has a default to write.

    Best is one of the group that was read, with a fraction, and not worn out by writing.
    """

    def fitness(register: Register) -> int:
        lasting = register.persistence in {"eeprom", "both"}
        return (register.group == group) + (register.kind is Kind.NUMBER) + (not lasting)

    return max(filter(_harmless, model.registers), key=fitness, default=None)


def _harmless(register: Register) -> bool:
    prepared = register.writable or register.unlock or register.apply or register.rescales
    special = register.danger or register.stays or register.governs
    plain = register.kind in {Kind.NUMBER, Kind.INTEGER} and register.access.writable and not register.specials
    return plain and not prepared and not special and _default(register) is not None


def _default(register: Register) -> str | None:
    default = register.default
    return None if default is None or isinstance(default, str) or "/" in show(default) else show(default)
