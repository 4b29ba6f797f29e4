"""What helps to find a key in the reference of the map language: contents, an index by task, and the known units."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from regscribe.model.units import UNITS

Schema = Mapping[str, Any]
SUBJECTS = ("a value", "a number", "a word", "a register", "a manual", "a device")
BY_TASK, FILE, KNOWN_UNITS = "By task", "The file", "Known units"


def contents(headings: Iterable[str]) -> Iterator[str]:
    """Yield the contents: what to read first, then all sections in their order."""
    yield f"- {_link(BY_TASK)}: which key says what a manual says; with examples in the [recipes](recipes.md)"
    yield f"- {_link(FILE)}: the keys at the top of a map"
    yield f"- {_link(KNOWN_UNITS)}: units that need no declaration"
    yield f"- All sections: {', '.join(map(_link, headings))}\n"


def tasks(schema: Schema, heading: Callable[[str], str]) -> Iterator[str]:
    """Yield the index by task: what keys are for (`x-task` in the schema), by what it is said of."""
    found: dict[str, list[str]] = {subject: [] for subject in SUBJECTS}
    for name, definition in {"": schema, **schema["$defs"]}.items():
        for key, details in definition.get("properties", {}).items():
            for task in details.get("x-task", ()):
                subject, _, rest = task.partition(" that ")
                section = _anchor(heading(name) if name else FILE)
                found[subject].append(f"- that {rest}: [`{key}`](#{section})")
    yield f"## {BY_TASK}\n"
    yield "What a manual says, and the key that says it.\n"
    for subject in SUBJECTS:
        yield f"**{subject[:1].upper()}{subject[1:]}**\n"
        yield "\n".join(found[subject]) + "\n"


def known_units() -> Iterator[str]:
    """Yield the units that need no declaration, by quantity."""
    yield f"## {KNOWN_UNITS}\n"
    yield "What `unit` takes as it stands (`%` and `‰` in quotes); all others are declared under [units](#unit).\n"
    yield "\n".join(f"- {name}: {', '.join(f'`{one}`' for one in symbols)}" for name, symbols in UNITS.items()) + "\n"


def _link(heading: str) -> str:
    return f"[{heading}](#{_anchor(heading)})"


def _anchor(heading: str) -> str:
    return heading.lower().replace(" ", "-")
