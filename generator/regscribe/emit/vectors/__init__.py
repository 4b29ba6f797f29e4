"""Test vectors of a map as JSON for any language, and the pytest module that runs them against the Python driver."""

import json
from typing import Any

from regscribe.emit.header import FORMAT, header
from regscribe.emit.vectors.computed import computed_values
from regscribe.emit.vectors.content import surroundings
from regscribe.emit.vectors.sent_values import transmissions
from regscribe.emit.vectors.situations import both_sides
from regscribe.emit.vectors.test_module import module_text
from regscribe.emit.vectors.vector_sets import once_for_models, vector_sets
from regscribe.emit.vectors.worked import worked_examples
from regscribe.model import Command, CommandStep, Condition, Given, Model, Protocol, RegisterMap
from regscribe.model.identifiers import module_names

Json = dict[str, Any]
SCHEMA = "vectors.schema.json"
WIDTH = 150

__all__ = ["document", "dumps", "render"]


def render(register_map: RegisterMap) -> dict[str, str]:
    """Return `vectors/<maker>/<family>.json` and `tests/<maker>/test_<maker>__<family>.py` of a map, as path and text.

    The maker stands in the name of the module, too: pytest refuses a second module of one name, unless in a package.
    """
    maker, family = register_map.id.split("/")
    package, module = module_names(register_map.id)
    return {
        f"vectors/{maker}/{family}.json": dumps(document(register_map)) + "\n",
        f"tests/{package}/test_{package}__{module}.py": module_text(register_map),
    }


def dumps(value: Any, indent: int = 0) -> str:  # noqa: ANN401 (any JSON value)
    """Return `value` as JSON text, folded to lines of about `WIDTH` characters; keys stay in their order."""
    compact = json.dumps(value, ensure_ascii=False)
    if len(compact) + indent <= WIDTH or not isinstance(value, (dict, list)):
        return compact
    pad = " " * (indent + 1)
    if isinstance(value, dict):
        lines = [f"{pad}{json.dumps(key, ensure_ascii=False)}: {dumps(one, indent + 1)}" for key, one in value.items()]
        return "{\n" + ",\n".join(lines) + "\n" + " " * indent + "}"
    return "[\n" + ",\n".join(pad + dumps(one, indent + 1) for one in value) + "\n" + " " * indent + "]"


def document(register_map: RegisterMap) -> Json:
    """Return the vectors of a map as JSON values; `schema/vectors.schema.json` documents each key."""
    commands = (
        (model.name, _command(register_map, model, command))
        for model in register_map.models
        for command in model.commands
    )
    return {
        "$schema": f"../../../schema/{SCHEMA}",
        "generated": header(register_map),
        "format": FORMAT,
        "map": register_map.id,
        "title": register_map.title,
        "sha256": register_map.content_hash,
        "models": [model.name for model in register_map.models],
        "protocol": _protocol(register_map.protocol),
        "commands": once_for_models(commands, "id"),
        "givens": [_given(given) for given in register_map.givens],
        "sets": vector_sets(register_map),
        "transmissions": transmissions(register_map),
        "examples": worked_examples(register_map),
        **_computed(register_map),
    }


def _computed(register_map: RegisterMap) -> Json:
    """Return the vectors of what is computed; nothing where nothing is."""
    found = computed_values(register_map)
    return {"computed": found} if found else {}


def _protocol(protocol: Protocol) -> Json:
    """Return what a request may ask for: functions, most words or bits, and whether holes may be read along."""
    return {
        "functions": list(protocol.functions),
        "read_words": protocol.read_words,
        "write_words": protocol.write_words,
        "read_bits": protocol.read_bits,
        "write_bits": protocol.write_bits,
        "read_holes": protocol.read_holes,
        "unit_ids": list(protocol.unit_ids),
    }


def _command(register_map: RegisterMap, model: Model, command: Command) -> Json:
    steps = [_step(step) | _existence(register_map, model, step.when) for step in command.steps]
    exists = _existence(register_map, model, command.when)
    return {"id": command.id, "danger": bool(command.danger), **exists, "steps": steps}


def _existence(register_map: RegisterMap, model: Model, when: Condition) -> Json:
    """Return both sides of the condition of a command or a step; nothing where it has none."""
    sides = both_sides(register_map, model, when)
    return {"existence": [surroundings(one) | {"exists": exists} for one, exists in sides]} if sides else {}


def _step(step: CommandStep) -> Json:
    if not step.words:
        return {"wait": step.wait}
    found: Json = {
        "function": step.function,
        **step.space.facts(step.address),
        "words": [word & 0xFFFF for word in step.words],
    }
    more = {key: text for key in ("block", "argument") if (text := getattr(step, key))}
    return found | more


def _given(given: Given) -> dict[str, str]:
    register = {"register": given.register} if given.register else {}
    return {"id": given.id, "kind": given.kind.value, **register, "description": given.description}
