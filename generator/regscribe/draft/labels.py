"""Codes and bits with labels, as the keys `enum` and `flags` of a map have them."""

from collections.abc import Mapping
from typing import Any

from regscribe.checks.identifiers import normalised
from regscribe.files import OneLine
from regscribe.model.identifiers import label_id

UNUSABLE = frozenset({"mro", "name", "value"})
"""Ids of members that Python's enums need themselves."""


def labelled(labels: Mapping[int, str], what: str = "code") -> OneLine:
    """Return codes with their labels; where a label alone gives no id, or one that is taken, with an id as well."""
    taken: set[str] = set()
    found: dict[Any, Any] = {}
    for code, text in labels.items():
        label = " ".join(text.split()) or f"{what} {code}"
        usual = label_id(label)
        name = usual if usual and usual not in UNUSABLE else f"{what}_{str(code).replace('-', 'minus_')}"
        if normalised(name) in taken:
            name = f"{name}_{str(code).replace('-', 'minus_')}"
        while normalised(name) in taken:
            name = f"{name}_again"
        taken.add(normalised(name))
        found[code] = label if name == usual else OneLine({"label": label, "id": name})
    return OneLine(found)


def described(name: str, text: str) -> dict[str, str]:
    """Return the key `description` for a text; none where it is empty or repeats the name."""
    plain = " ".join(text.split())
    return {"description": plain} if plain and normalised(plain) != normalised(name) else {}
