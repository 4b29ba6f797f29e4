"""All rules of the compiler with their examples, for `explain` and for the tests."""

from importlib.resources import files

from regscribe import checks, lower, schema, source
from regscribe.model import Rule

ROOMS = {"source": source, "schema": schema, "lower": lower, "checks": checks}
"""The phases that have rules, in their order."""


def all_rules() -> tuple[Rule, ...]:
    """Every rule, sorted by id."""
    return tuple(sorted((rule for room in ROOMS.values() for rule in room.RULES), key=lambda rule: rule.id))


def room_of(rule_id: str) -> str:
    """The phase that reports a rule. Raises KeyError if there is no such rule."""
    for name, room in ROOMS.items():
        if any(rule.id == rule_id for rule in room.RULES):
            return name
    raise KeyError(rule_id)


def examples(rule_id: str) -> tuple[str | None, str | None]:
    """A map against the rule and the same map put right; None where the rule has no such file."""
    folder = files("regscribe") / room_of(rule_id) / "examples"
    bad, good = (folder / f"{rule_id}.{kind}.yaml" for kind in ("bad", "good"))
    return (bad.read_text("utf-8") if bad.is_file() else None, good.read_text("utf-8") if good.is_file() else None)
