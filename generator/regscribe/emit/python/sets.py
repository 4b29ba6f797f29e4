"""Sets of libraries as a map uses them: the same registers, with the section and the memory that the map tells."""

from collections import Counter
from collections.abc import Iterable, Mapping

from regscribe.emit.python.literals import camel
from regscribe.emit.python.offer import Declared, Part, Telling
from regscribe.emit.words import one_line
from regscribe.model import Array, Command, Register

Item = Register | Array | Command


def told(sets: Iterable[Part], own: Mapping[str, Declared], items: Iterable[Item]) -> list[Part]:
    """The sets that a class with the declarations `own` has everything of, each with what most of its registers say."""
    groups = {item.id: item.group for item in items if isinstance(item, Register)}
    found = []
    for part in sets:
        if part.items.keys() <= own.keys():
            same = [(name, one) for name, one in part.items.items() if own[name].key == one.key]
            tellings = Counter(_telling(own[name], one, groups[name]) for name, one in same)
            found += [_with(part, telling) for telling, _ in tellings.most_common(1)]
    return found


def _telling(own: Declared, one: Declared, group: str) -> Telling:
    return Telling(
        group,
        own.section if own.section != one.section else None,
        own.persistence if own.persistence != one.persistence else None,
    )


def _with(part: Part, telling: Telling) -> Part:
    items = {name: one._replace(**words(telling)) for name, one in part.items.items()}
    return Part(part.origin, items, telling)


def words(telling: Telling) -> dict[str, str]:
    """What is told, by the keyword that tells it."""
    every = {"section": telling.section, "persistence": telling.persistence}
    return {key: text for key, text in every.items() if text is not None}


def name_of(telling: Telling) -> str:
    """What the name of a class ends in that tells this."""
    return f"In{camel(telling.group)}{camel(telling.persistence or '')}"


def about(telling: Telling, models: Iterable[str]) -> str:
    """The docstring of a class that tells this."""
    facts = ", ".join(one_line(text) for text in words(telling).values() if text)
    return f"Registers of {', '.join(models)} that other maps have, too{f' ({facts})' if facts else ''}."
