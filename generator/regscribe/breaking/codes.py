"""What single codes mean: enums, special values and faults, code by code."""

from collections.abc import Hashable, Iterator
from typing import NamedTuple

from regscribe.breaking.change import Difference, Effects
from regscribe.breaking.facts import EXACT, B, C, Fact, H, N, compared, judged, text
from regscribe.breaking.pairs import Pairs, paired
from regscribe.breaking.plain import plain
from regscribe.breaking.renames import SAME_NAMES, Renames
from regscribe.breaking.rules import (
    CODE_ADDED,
    CODE_MEANING,
    CODE_REMOVED,
    CODE_RENAMED,
    EXISTENCE,
    FAULT_ADDED,
    FAULT_REMOVED,
    SPECIAL,
)
from regscribe.emit.words import condition_words, one_line, sentinel_words, special_words
from regscribe.model import Access, Enum, Member, Register, Sentinel, Special, show

MEMBER_FACTS: tuple[Fact[Member], ...] = (
    Fact(("when",), "condition of the code", judged(EXISTENCE, N, H), lambda one: condition_words(one.when)),
    text("label"),
    text("description"),
    text("cells"),
)
"""Facts of a member; `code` pairs them, `id` is judged with all others."""

ENUM_FACTS: tuple[Fact[Enum], ...] = (
    text("invalid", "invalid codes"),
    text("description", "description of the codes"),
    text("columns", "columns of the codes"),
    text("other", "label of other codes"),
)
"""Facts of an enum; `members` and `cases` are compared one by one, `id` is that of a class of the driver."""

SPECIAL_FACTS: tuple[Fact[Special], ...] = (
    Fact(("id",), "name of the special value", judged(SPECIAL, N, B)),
    Fact(("means",), "meaning of the special value", judged(SPECIAL, N, B), special_words),
    text("label"),
)
"""Facts of a special value; `code` pairs them."""

SENTINEL_FACTS: tuple[Fact[Sentinel], ...] = (
    Fact(("id",), "name of the fault", judged(CODE_RENAMED, N, B)),
    text("label"),
)
"""Facts of a fault code; `stored`, `high` and `when` pair them."""


class Coded(NamedTuple):
    """A difference in codes; those in one enum have one cause."""

    difference: Difference
    cause: Hashable = None


def member_words(member: Member) -> str:
    """A code as `3 HEATING "Heating"`, with its condition."""
    return f"{member.code} {_name_words(member)}"


def _name_words(member: Member) -> str:
    when = "" if member.when.always else f" while {condition_words(member.when)}"
    return f'{member.id} "{one_line(member.label)}"{when}'


def enum_differences(
    old: Enum | None, new: Enum | None, access: Access, renames: Renames, *, same_kind: bool = False
) -> Iterator[Coded]:
    """What differs between the codes of two versions; where one has none, another kind of value tells it already."""
    if old is None or new is None:
        if old is not new and same_kind:
            came = Difference(CODE_ADDED, "meaning of the number", Effects(N, H), "none", "codes")
            went = Difference(CODE_REMOVED, "meaning of the number", Effects(H, B), "codes", "none")
            yield Coded(came if old is None else went)
        return
    conditions = [plain(case.when, renames) for case in old.cases]
    if conditions != [plain(case.when, renames.now) for case in new.cases]:
        words = [", ".join(condition_words(case.when) for case in enum.cases) or "always" for enum in (old, new)]
        yield Coded(Difference(CODE_MEANING, "cases of the codes", Effects(H, B), *words))
    if len(old.cases) != len(new.cases):
        return
    pairs = [(one.then, other.then) for one, other in zip(old.cases, new.cases, strict=True)] or [(old, new)]
    for one, other in pairs:
        for found in _members(one, other, access, renames):
            yield Coded(found, ("enum", new.span if not new.cases else other.span, one.id))


def _members(old: Enum, new: Enum, access: Access, renames: Renames) -> Iterator[Difference]:
    yield from compared(ENUM_FACTS, old, new, renames)
    pairs = _member_pairs(old, new, renames)
    for mine, theirs in pairs.both:
        yield from _renamed(mine, theirs, old, new)
        for found in compared(MEMBER_FACTS, mine, theirs, renames):
            if found.what != "label" or mine.id == theirs.id:  # else the new name says it
                yield found._replace(what=f"{found.what} of code {theirs.code}")
    retired = dict(new.invalid)
    for one in pairs.removed:
        effects = Effects(C, C) if one.code in retired else Effects(H, B)
        yield Difference(CODE_REMOVED, "code", effects, member_words(one), retired.get(one.code, "none"))
    for one in pairs.added:
        effects = Effects(N, H if access.readable else C)
        yield Difference(CODE_ADDED, "code", effects, "none", member_words(one))


def _member_pairs(old: Enum, new: Enum, renames: Renames) -> Pairs[Member]:
    """Members by code and condition; then by code, where the condition alone differs; then by name."""
    olds = {id(one) for one in old.members}

    def key(member: Member) -> Hashable:
        return member.code, plain(member.when, renames if id(member) in olds else renames.now)

    return paired(old.members, new.members, key, [lambda one: one.code, lambda one: one.id])


def _renamed(mine: Member, theirs: Member, old: Enum, new: Enum) -> Iterator[Difference]:
    """Another name at a code: a new meaning if one of the names stands elsewhere too. Another code of a name is one."""
    if mine.code != theirs.code:
        words = member_words(mine), member_words(theirs)
        yield Difference(CODE_MEANING, f"code of {theirs.id}", Effects(B, N), *words)
    if mine.id == theirs.id:
        return
    moved = mine.id in {one.id for one in new.members} or theirs.id in {one.id for one in old.members}
    rule, effects = (CODE_MEANING, Effects(B, B)) if moved else (CODE_RENAMED, Effects(N, B))
    yield Difference(rule, f"name of code {mine.code}", effects, _name_words(mine), _name_words(theirs))


def special_differences(old: Register, new: Register) -> Iterator[Difference]:
    """What differs between special values."""
    one, other = ({special.code: special for special in each.specials} for each in (old, new))
    for code in one.keys() | other.keys():
        if code in one and code in other:
            for found in compared(SPECIAL_FACTS, one[code], other[code]):
                yield found._replace(what=f"{found.what} {show(code)}")
        elif code in one:
            yield Difference(SPECIAL, "special value", Effects(N, B), special_words(one[code]), "none")
        else:
            yield Difference(SPECIAL, "special value", Effects(N, C), "none", special_words(other[code]))


def sentinel_differences(
    old: tuple[Sentinel, ...], new: tuple[Sentinel, ...], renames: Renames = SAME_NAMES
) -> Iterator[Difference]:
    """What differs between fault codes."""
    one = {_fault(sentinel, renames): sentinel for sentinel in old}
    other = {_fault(sentinel, renames.now): sentinel for sentinel in new}
    for key, sentinel in one.items():
        if key not in other:
            yield _apart(sentinel, gone=True)
            continue
        yield from compared(SENTINEL_FACTS, sentinel, other[key], renames)
    yield from (_apart(sentinel, gone=False) for key, sentinel in other.items() if key not in one)


def _fault(sentinel: Sentinel, renames: Renames) -> Hashable:
    return plain(sentinel.stored), plain(sentinel.high), plain(sentinel.when, renames)


def _apart(sentinel: Sentinel, *, gone: bool) -> Difference:
    words = sentinel_words(sentinel, EXACT)
    if gone:
        return Difference(FAULT_REMOVED, "fault", Effects(N, B), words, "none")
    return Difference(FAULT_ADDED, "fault", Effects(N, H), "none", words)
