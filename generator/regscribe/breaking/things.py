"""Groups, commands, computed values, programs, blocks and givens: paired by id, then by what they are."""

from collections.abc import Hashable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple, Protocol, TypeVar

from regscribe.breaking.change import TEXT_ONLY, Difference, Effects, Found, Site
from regscribe.breaking.facts import EXACT, B, C, Fact, H, N, compared, judged, text
from regscribe.breaking.map_facts import GIVEN_FACTS
from regscribe.breaking.pairs import Pairs, paired
from regscribe.breaking.plain import plain_field
from regscribe.breaking.renames import Renames
from regscribe.breaking.rules import (
    COMMAND,
    COMPUTED,
    EXISTENCE,
    GIVEN_ADDED,
    GIVEN_REMOVED,
    MOVED_GROUP,
    PROGRAM,
    REACH,
    TEXT,
    THING_ADDED,
    THING_REMOVED,
    THING_RENAMED,
    WRITE_ORDER,
    WRITING,
)
from regscribe.emit.words import cases_words, condition_words, map_cases, range_words, term_words
from regscribe.model import Command, Computed, Given, Group, ProgramNotes, RegisterBlock, Rule, SetpointProgram, Span


class Thing(Protocol):
    """What has an id among those of its sort."""

    @property
    def id(self) -> str:
        """Its name in programs."""
        ...


T = TypeVar("T", bound=Thing)


class Apart(NamedTuple):
    """A difference of a thing: its id, where it stands and stood, and its id before."""

    id: str
    difference: Difference
    span: Span | None = None
    was: Span | None = None
    other: str = ""


def _danger(old: Command, new: Command) -> tuple[Rule, Effects]:
    if bool(old.danger) == bool(new.danger):
        return TEXT, TEXT_ONLY
    return WRITING, Effects(N, B) if new.danger else Effects(N, C)


def _steps(old: Command, new: Command) -> tuple[Rule, Effects]:
    """Other requests break those who send the old ones; another function for the same words, or a wait, does not."""
    one, other = (
        [step._replace(function=step.space.read_function, wait=0) for step in each.steps if step.words or not step.wait]
        for each in (old, new)
    )
    return COMMAND, Effects(H if one == other else B, N)


GROUP_FACTS: tuple[Fact[Group], ...] = (
    Fact(("order",), "place in the order of writing", judged(WRITE_ORDER, N, H)),
    text("name"),
    text("description"),
    text("section"),
)
"""Facts of a group; of its `members` each register tells its group."""

COMMAND_FACTS: tuple[Fact[Command], ...] = (
    Fact(("steps",), "requests", _steps),
    Fact(("arguments",), "arguments", judged(COMMAND, B, B)),
    Fact(("when",), "condition of existence", judged(EXISTENCE, H, H), lambda one: condition_words(one.when)),
    Fact(("danger",), "danger", _danger, lambda one: one.danger or "not dangerous"),
    Fact(("effects",), "what it changes besides", judged(COMMAND, H, N)),
    Fact(("group",), "group", judged(MOVED_GROUP, N, C)),
    Fact(("step_registers",), "registers of its requests", lambda _, __: (TEXT, TEXT_ONLY)),
    text("name"),
    text("description"),
    text("section"),
)
"""Facts of a command."""

COMPUTED_FACTS: tuple[Fact[Computed], ...] = (
    Fact(("term",), "formula", judged(COMPUTED, N, B), lambda one: term_words(one.term, EXACT)),
    Fact(("unit",), "unit", judged(COMPUTED, N, B), lambda one: one.unit or "no unit"),
    Fact(
        ("valid",),
        "valid results",
        judged(COMPUTED, N, H),
        lambda one: cases_words(map_cases(one.valid, range_words), EXACT) or "none",
    ),
    Fact(("when",), "condition of existence", judged(EXISTENCE, N, H), lambda one: condition_words(one.when)),
    text("name"),
    text("description"),
    text("section"),
)
"""Facts of a computed value."""

PROGRAM_FACTS: tuple[Fact[SetpointProgram], ...] = (
    Fact(("segments", "first", "programs", "final"), "segments", judged(PROGRAM, B, B)),
    Fact(("number_of_segments", "counts", "cycles", "forever", "time_unit"), "counts and times", judged(PROGRAM, H, B)),
    Fact(("holdback", "power_failure", "end", "setpoint_limits"), "settings", judged(PROGRAM, H, H)),
    Fact(("status", "segment_now", "program_now", "setpoint_now"), "what is shown", judged(PROGRAM, H, H)),
    Fact(("start", "hold", "resume", "reset", "enable", "requires"), "ways to run", judged(PROGRAM, H, H)),
    Fact(("while_running", "order"), "way of writing", judged(PROGRAM, H, H)),
    Fact(("when",), "condition of existence", judged(EXISTENCE, H, H), lambda one: condition_words(one.when)),
    text("name"),
    text("section"),
)
"""Facts of a setpoint program."""

NOTES_FACTS: tuple[Fact[ProgramNotes], ...] = (text("description"), text("inferred", "what was inferred"))
"""Facts of what is noted of a program."""

BLOCK_FACTS: tuple[Fact[RegisterBlock], ...] = (
    Fact(("given",), "given of its base", judged(REACH, N, B)),
    Fact(("chain", "ids", "number"), "place in the chain", judged(REACH, B, H)),
)
"""Facts of a block."""

FACTS: Mapping[str, Sequence[Fact[Any]]] = {
    "group": GROUP_FACTS,
    "command": COMMAND_FACTS,
    "computed value": COMPUTED_FACTS,
    "program": PROGRAM_FACTS,
    "block": BLOCK_FACTS,
    "given": GIVEN_FACTS,
}
"""The facts of each sort."""


def thing_pairs(sort: str, olds: Sequence[T], news: Sequence[T], renames: Renames) -> Pairs[T]:
    """Things of one sort: by id, then by all that is a fact of them."""
    ours = {id(one) for one in olds}

    def content(thing: T) -> Hashable:
        mine = renames if id(thing) in ours else renames.now
        members = frozenset(map(mine.path, thing.members)) if isinstance(thing, Group) else ()
        texts = {"name", "description", "section", "reason"}
        names = [name for fact in FACTS[sort] for name in fact.fields if name not in texts]
        return members, tuple(plain_field(thing, name, mine) for name in names)

    return paired(olds, news, lambda thing: thing.id, [content])


def thing_differences(sort: str, pairs: Pairs[T], renames: Renames) -> Iterator[Apart]:
    """What differs between things of one sort, and those that came and went."""
    for old, new in pairs.both:
        span, was = _span(new), _span(old)
        if old.id != new.id:
            renamed = Difference(THING_RENAMED, f"name of the {sort}", Effects(N, B), old.id, new.id)
            yield Apart(new.id, renamed, span, was, old.id)
        yield from (Apart(new.id, found, span, was) for found in compared(FACTS[sort], old, new, renames))
    for old in pairs.removed:
        rule = GIVEN_REMOVED if isinstance(old, Given) else THING_REMOVED
        gone = Difference(rule, sort, Effects(B if sort == "command" else N, B), old.id, "none")
        yield Apart(old.id, gone, was=_span(old))
    for new in pairs.added:
        needed = isinstance(new, Given) and new.default is None
        rule = GIVEN_ADDED if isinstance(new, Given) else THING_ADDED
        yield Apart(new.id, Difference(rule, sort, Effects(N, B if needed else C), "none", new.id), _span(new))


def found_at(apart: Apart, site: Site) -> Found:
    """A difference of a thing with an id, as one of the map or of a model."""
    here = site._replace(subject=apart.id, span=apart.span or site.span, was=apart.was or site.was, other=apart.other)
    return Found(here, apart.difference)


def new_ids(pairs: Pairs[T]) -> dict[str, str]:
    """What was renamed."""
    return {old.id: new.id for old, new in pairs.both if old.id != new.id}


def _span(thing: object) -> Span | None:
    found = getattr(thing, "span", None)
    return found if isinstance(found, Span) else None
