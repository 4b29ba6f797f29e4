"""Test vectors of a map as JSON for any language, and the pytest module that runs them against the Python driver."""

from typing import Any

from regscribe.emit.header import FORMAT, header
from regscribe.emit.vectors.device import command_facts, protocol_facts
from regscribe.emit.vectors.json_layout import dumps
from regscribe.emit.vectors.sent_values import transmissions
from regscribe.emit.vectors.test_module import test_module
from regscribe.emit.vectors.vector_sets import vector_sets
from regscribe.emit.vectors.worked import worked_examples
from regscribe.model import Given, RegisterMap

SCHEMA = "vectors.schema.json"

__all__ = ["document", "render"]


def render(register_map: RegisterMap) -> dict[str, str]:
    """Return `vectors/<maker>/<family>.json` and `tests/<maker>/test_<family>.py` of a map, as path and text."""
    maker, family = register_map.id.split("/")
    module = family.replace("-", "_")
    return {
        f"vectors/{maker}/{family}.json": dumps(document(register_map)) + "\n",
        f"tests/{maker.replace('-', '_')}/test_{module}.py": test_module(register_map),
    }


def document(register_map: RegisterMap) -> dict[str, Any]:
    """Return the vectors of a map as JSON values; `schema/vectors.schema.json` documents each key."""
    return {
        "$schema": f"../../../schema/{SCHEMA}",
        "generated": header(register_map),
        "format": FORMAT,
        "map": register_map.id,
        "title": register_map.title,
        "sha256": register_map.content_hash,
        "models": [model.name for model in register_map.models],
        "protocol": protocol_facts(register_map),
        "commands": command_facts(register_map),
        "givens": [_given(given) for given in register_map.givens],
        "sets": vector_sets(register_map),
        "transmissions": transmissions(register_map),
        "examples": worked_examples(register_map),
    }


def _given(given: Given) -> dict[str, str]:
    register = {"register": given.register} if given.register else {}
    return {"id": given.id, "kind": given.kind.value, **register, "description": given.description}
