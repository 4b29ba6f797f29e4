"""What a named condition compiles to, in Markdown: its tests in words, and where the tested registers stand."""

from collections.abc import Iterator

from regscribe.emit.markdown.escape import escape
from regscribe.emit.words import condition_words
from regscribe.model import Condition, Model, Register, RegisterMap
from regscribe_runtime.values.terms import parts_of


def condition_text(register_map: RegisterMap, name: str) -> str:
    """What a condition means on each model that uses it; empty if none of their registers does."""
    said: dict[str, list[str]] = {}
    for model in register_map.models:
        found = next((one for one in _conditions(model) if one.name == name), None)
        if found is not None:
            said.setdefault(_told(found, model), []).append(model.name)
    alike = len(said) == 1 and len(next(iter(said.values()))) == len(register_map.models)
    return "\n\n".join(text if alike else f"{escape(', '.join(models))}: {text}" for text, models in said.items())


def _told(condition: Condition, model: Model) -> str:
    places = {one.path: f"{one.base.space.value} {one.address}" for one in model.registers if not one.block}
    asked = [f"`{path}`: {places[path]}" for path in condition.registers if path in places]
    where = f" ({', '.join(asked)})" if asked else ""
    return f"Holds when {escape(condition_words(condition, model))}{where}."


def _conditions(model: Model) -> Iterator[Condition]:
    for register in model.registers:
        yield from (part for part in parts_of(_conditional(register)) if isinstance(part, Condition))
    for command in model.commands:
        yield from (command.when, *(step.when for step in command.steps))


def _conditional(register: Register) -> tuple[object, ...]:
    """All of a register that may depend on conditions."""
    return (
        register.when,
        register.writable,
        register.scale,
        register.range,
        register.valid,
        register.unit,
        register.partial,
        register.default_cases,
        register.delivered_cases,
        register.sentinels,
        register.views,
    )
