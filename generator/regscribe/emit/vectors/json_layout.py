"""JSON that people can read: what fits on a line stands on one line, one vector a line."""

import json
from typing import Any

WIDTH = 150


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
