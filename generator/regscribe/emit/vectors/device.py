"""What is true of the device as a whole: the limits of its requests, and its commands."""

import json
from typing import Any

from regscribe.model import Command, CommandStep, RegisterMap

Json = dict[str, Any]


def protocol_facts(register_map: RegisterMap) -> Json:
    """Return what a request may ask for: functions, most words or bits, and whether holes may be read along."""
    protocol = register_map.protocol
    return {
        "functions": list(protocol.functions),
        "read_words": protocol.read_words,
        "write_words": protocol.write_words,
        "read_bits": protocol.read_bits,
        "write_bits": protocol.write_bits,
        "read_holes": protocol.read_holes,
        "unit_ids": list(protocol.unit_ids),
    }


def command_facts(register_map: RegisterMap) -> list[Json]:
    """Return the commands with the requests that they send, once for the models that agree."""
    folded: dict[str, tuple[Json, list[str]]] = {}
    for model in register_map.models:
        for command in model.commands:
            fact = _command(command)
            folded.setdefault(json.dumps(fact), (fact, []))[1].append(model.name)
    return [{"id": fact["id"], "models": models, **fact} for fact, models in folded.values()]


def _command(command: Command) -> Json:
    return {"id": command.id, "danger": bool(command.danger), "steps": [_step(step) for step in command.steps]}


def _step(step: CommandStep) -> Json:
    if not step.words:
        return {"wait": step.wait}
    return {"function": step.function, "address": step.address, "words": [word & 0xFFFF for word in step.words]}
