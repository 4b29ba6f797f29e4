"""All rules of the compiler with their examples, for `explain` and for the tests."""

from importlib.resources import files
from importlib.resources.abc import Traversable

from regscribe import breaking, checks, compose, lower, schema, source
from regscribe.model import Rule

ROOMS = {"source": source, "schema": schema, "lower": lower, "checks": checks, "compose": compose} | {
    "breaking": breaking
}
"""The phases that have rules, and the room that compares versions."""

MAIN = "example/controller.yaml"
"""In an example of several files: the map that is compiled. The folder of the example is its `maps` folder."""

Example = tuple[tuple[str, str], ...]
"""The files of an example: name and text of each, the map that is compiled first."""


def all_rules() -> tuple[Rule, ...]:
    """Every rule, sorted by id."""
    return tuple(sorted((rule for room in ROOMS.values() for rule in room.RULES), key=lambda rule: rule.id))


def room_of(rule_id: str) -> str:
    """The phase that reports a rule. Raises KeyError if there is no such rule."""
    for name, room in ROOMS.items():
        if any(rule.id == rule_id for rule in room.RULES):
            return name
    raise KeyError(rule_id)


def examples(rule_id: str) -> tuple[Example | None, Example | None]:
    """A map against the rule and the same map put right; None where the rule has no such example.

    An example is a file `RS0401.bad.yaml`, or a folder `RS0501.bad/` where it takes several files.
    """
    folder = files("regscribe") / room_of(rule_id) / "examples"
    return _example(folder, f"{rule_id}.bad"), _example(folder, f"{rule_id}.good")


def _example(folder: Traversable, name: str) -> Example | None:
    one, several = folder / f"{name}.yaml", folder / name
    if one.is_file():
        return ((MAIN, one.read_text("utf-8")),)
    found = dict(_files(several, "")) if several.is_dir() else {}
    return tuple(sorted(found.items(), key=lambda file: (file[0] != MAIN, file[0]))) or None


def _files(folder: Traversable, prefix: str) -> list[tuple[str, str]]:
    found = []
    for entry in folder.iterdir():
        name = f"{prefix}{entry.name}"
        found += [(name, entry.read_text("utf-8"))] if entry.is_file() else _files(entry, f"{name}/")
    return found
