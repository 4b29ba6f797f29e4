"""What is given, as arguments of a driver's constructor."""

from regscribe.emit.python.literals import exact, literal, plain
from regscribe.model import Given, GivenKind


def type_of(given: Given) -> str:
    """The type of the argument."""
    choices = ", ".join(map(literal, given.choices))
    types = {
        GivenKind.CODES: "Collection[int]",
        GivenKind.BOOLEAN: "bool",
        GivenKind.NUMBER: "float | Fraction",
        GivenKind.CHOICE: f"Literal[{choices}]",
    }
    return types[given.kind]


def default_of(given: Given) -> str:
    """The default of the argument with its equals sign; empty without one."""
    if given.default is None:
        return ""
    return f" = {literal(given.default) if isinstance(given.default, str) else plain(given.default)}"


def checked(given: Given) -> str:
    """The argument as the driver keeps it: a number exactly and within its range, a choice among its choices."""
    if given.kind is GivenKind.NUMBER:
        ends = [None if end is None else exact(end) for end in (given.low, given.high)]
        shown = [f", {end}" for end in ends] if any(ends) else []
        return f"Fact.number({literal(given.id)}, {given.id}{''.join(shown)})"
    if given.kind is GivenKind.CHOICE:
        return f"Fact.choice({', '.join([literal(given.id), given.id, *map(literal, given.choices)])})"
    return given.id
