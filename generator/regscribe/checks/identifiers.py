"""Identifiers: what becomes an attribute or a class of a driver must be a free, valid Python name."""

import keyword
import re
from collections.abc import Iterator

from regscribe.checks.rule import Finding, Problem, RuleScope, doubled, model_rule, register_rule
from regscribe.model import Array, Enum, Kind, Model, Register, Related, Span

RUNTIME_NAMES = frozenset(
    """
    bind chain_headers change close commands configure exception_status groups identify identity link loopback map_id
    map_sha256 model open over placed plan protocol read registers rtu run session setpoint_programs tcp wear write
    """.split()  # noqa: SIM905 (a column of quoted words is harder to keep in order)
)
"""Names that a driver has, or is to have, itself: a register of that id would hide them (a test compares the two)."""

HIDDEN = {
    "register": RUNTIME_NAMES,
    "array": RUNTIME_NAMES,
    "computed value": RUNTIME_NAMES,
    "command": frozenset({"bind", "placed", "read", "registers", "run"}),
    "bit field": frozenset({"int", "parts", "replace"}),
}
"""Names that a driver's class for registers, for commands or for a word of bit fields uses itself."""

ENUM_NAMES = frozenset({"MRO", "NAME", "VALUE"})
"""Names that `enum` refuses or uses itself, in capitals as members are written."""


def normalised(text: str) -> str:
    """Letters and digits only, in lower case, so that texts which readers mistake for each other are equal."""
    return re.sub(r"[\W_]+", "", text).lower()


def camel(name: str) -> str:
    """The class name that an id becomes: `output_type` is OutputType."""
    return "".join(part[:1].upper() + part[1:] for part in name.split("_"))


def _named(scope: RuleScope) -> Iterator[tuple[str, str, Span]]:
    """Every id that becomes an attribute: what it is, the id, where it stands; array members once."""
    for _, member in _members(scope.model.members):
        yield "array" if isinstance(member, Array) else "register", member.id, member.span
        if isinstance(member, Register):
            part = "bit field" if member.kind is Kind.FIELDS else "flag"
            yield from ((part, bits.id, member.span) for bits in member.fields)
    yield from (("group", group.id, group.span) for group in scope.model.groups)
    yield from (("command", command.id, command.span) for command in scope.model.commands)
    yield from (("computed value", computed.id, computed.span) for computed in scope.model.computed)


def _members(members: tuple[Register | Array, ...], owner: str = "") -> Iterator[tuple[str, Register | Array]]:
    """The registers and arrays of a model, those in arrays once, each with the arrays around it."""
    for member in members:
        yield owner, member
        if isinstance(member, Array):
            yield from _members(member.members, f"{owner}{member.id} ")


@model_rule("RS0410", "Id is no Python name")
def not_a_name(scope: RuleScope) -> Iterator[Finding]:
    """An id becomes an attribute of the driver, so it must be a Python identifier."""
    for what, name, span in _named(scope):
        if keyword.iskeyword(name) or keyword.issoftkeyword(name):
            yield Finding(name, span, f"{what} `{name}` has the name of a Python keyword", "give it another `id`")
        elif not re.fullmatch(r"[a-z][a-z0-9_]*", name):
            message = f"{what} `{name}` is no lower-case Python identifier"
            yield Finding(name, span, message, "give it an `id` of letters, digits and `_` that starts with a letter")


@model_rule("RS0411", "Id hides a name of the driver")
def hides_runtime(scope: RuleScope) -> Iterator[Finding]:
    """A register called `write` would replace the method `write`."""
    for what, name, span in _named(scope):
        if name in HIDDEN.get(what, ()):
            message = f"{what} `{name}` would hide the driver's own `{name}`"
            yield Finding(name, span, message, f"give it another `id`, for example `{name}_{what.split()[-1]}`")


@model_rule("RS0412", "Id used twice")
def id_twice(scope: RuleScope) -> Iterator[Finding]:
    """Two things of one id cannot both be reached from the driver."""
    named = [(f"{owner}register", one.id, one.span) for owner, one in _members(scope.model.members)]
    named += [("register", one.id, one.span) for one in scope.model.computed]
    named += [("group", group.id, group.span) for group in scope.model.groups]
    named += [("command", command.id, command.span) for command in scope.model.commands]
    for (_, first, place), (what, name, span) in doubled(named, lambda one: [(one[0], normalised(one[1]))]):
        related = Related(f"`{first}` stands here", place)
        yield Finding(name, span, f"{what} `{name}` has the id of `{first}`", "give one another `id`", related)


@model_rule("RS0413", "Name used twice", warns=True)
def name_twice(scope: RuleScope) -> Iterator[Finding]:
    """Readers tell registers apart by their names; equal names mislead them."""
    every = [one for one in scope.model.registers if not one.array or all(index <= 1 for index in one.index)]
    for first, register in doubled(every, lambda one: [(one.group, one.array, normalised(one.name))]):
        if first.span != register.span:
            related = Related(f"`{first.path}` has this name", first.span)
            yield Finding.at(register, f'is called "{register.name}" like `{first.path}`', "tell them apart", related)


@model_rule("RS0414", "Class name used twice")
def class_twice(scope: RuleScope) -> Iterator[Finding]:
    """Models and enums become classes of one module; each needs its own name."""
    taken: dict[str, tuple[str, Span]] = {}
    before = scope.register_map.models[: scope.register_map.models.index(scope.model)]
    for name, what, _, span in (one for model in before for one in _classes(model)):
        taken.setdefault(name, (what, span))
    mine = list(_classes(scope.model))
    mine += [(camel(enum.id), f"enum {enum.id}", enum.id, enum.span) for _, _, enum in enums_of(scope) if enum.id]
    for name, what, subject, span in mine:
        other, where = taken.setdefault(name, (what, span))
        if other != what:
            related = Related(f"{other} becomes {name}", where)
            message = f"{what} becomes class {name}, which {other} is already"
            yield Finding(subject, span, message, "give one another id (a model: `class`)", related)


def _classes(model: Model) -> Iterator[tuple[str, str, str, Span]]:
    """The classes of a model, sync and async: name, what becomes it, the id and the place of that."""
    for name in (model.class_name, f"Async{model.class_name}"):
        yield name, f"model {model.name}", model.name, model.span


def enums_of(scope: RuleScope) -> Iterator[tuple[Register, str, Enum]]:
    """Every enum of a model once: the first register that has it, the field if it is one's, the enum.

    Hashing enums by value would cost more than all the rest.
    """
    seen: set[int] = set()
    for register in scope.model.registers:
        own = register.enum.each if register.enum else ()
        owned = [*(("", one) for one in own), *((bits.id, bits.enum) for bits in register.fields)]
        for field, enum in owned:
            if enum and id(enum) not in seen:
                seen.add(id(enum))
                yield register, field, enum


@register_rule("RS0415", "Description repeats the name", warns=True)
def description_is_name(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A description that says no more than the name wastes a line."""
    if register.description and normalised(register.description) == normalised(register.name):
        yield "is described by its own name", "say what it does, or remove `description`"
