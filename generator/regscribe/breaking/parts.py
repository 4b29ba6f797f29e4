"""The parts of a word: flags and bit fields, by id, then by the bits that they have."""

from collections.abc import Iterator

from regscribe.breaking.change import Difference, Effects
from regscribe.breaking.codes import enum_differences, sentinel_differences
from regscribe.breaking.facts import B, C, Fact, H, N, compared, judged, text
from regscribe.breaking.limits import part_limits
from regscribe.breaking.pairs import Pairs, paired
from regscribe.breaking.renames import Renames
from regscribe.breaking.rules import (
    BITS,
    EXISTENCE,
    KIND,
    PART_ADDED,
    PART_REMOVED,
    RELATION,
    SCALE,
    THING_RENAMED,
    UNIT,
)
from regscribe.emit.words import bits_words, condition_words
from regscribe.model import BitField, Register

FACTS: tuple[Fact[BitField], ...] = (
    Fact(("low", "high"), "bits", judged(BITS, B, N), bits_words),
    Fact(("signed", "multiply", "add"), "scale", judged(SCALE, N, B)),
    Fact(("unit",), "unit", judged(UNIT, N, B)),
    Fact(("range",), "range", part_limits("range", written=True)),
    Fact(("valid",), "valid readings", part_limits("valid", written=False)),
    Fact(("follows",), "what sets it", judged(RELATION, H, N)),
    Fact(("when",), "condition of existence", judged(EXISTENCE, H, H), lambda one: condition_words(one.when)),
    text("label"),
    text("description"),
)
"""Facts of a part; `id` pairs them, `enum` and `sentinels` are compared code by code."""


def part_pairs(old: Register, new: Register) -> Pairs[BitField]:
    """The flags and fields of two versions: a part with the same bits and another id was renamed."""
    return paired(old.fields, new.fields, lambda one: one.id, [lambda one: (one.low, one.high)])


def part_differences(old: Register, new: Register, renames: Renames) -> Iterator[Difference]:
    """What differs between the parts of a word."""
    pairs = part_pairs(old, new)
    for mine, theirs in pairs.both:
        if mine.id != theirs.id:
            yield Difference(THING_RENAMED, f"part at bits {bits_words(theirs)}", Effects(N, B), mine.id, theirs.id)
        for found in _differences(mine, theirs, new, renames):
            yield found._replace(what=f"{found.what} of part `{theirs.id}`")
    for one in pairs.removed:
        yield Difference(PART_REMOVED, "part", Effects(H, B), _words(one), "none")
    for one in pairs.added:
        yield Difference(PART_ADDED, "part", Effects(N, C), "none", _words(one))


def _differences(mine: BitField, theirs: BitField, new: Register, renames: Renames) -> Iterator[Difference]:
    yield from compared(FACTS, mine, theirs, renames)
    if (mine.enum is None) != (theirs.enum is None):
        words = (
            "codes" if one.enum else "a number" if one.is_number or one.width > 1 else "a flag"
            for one in (mine, theirs)
        )
        yield Difference(KIND, "kind of value", Effects(N, B), *words)
    yield from (found.difference for found in enum_differences(mine.enum, theirs.enum, new.access, renames))
    yield from sentinel_differences(mine.sentinels, theirs.sentinels, renames)


def _words(part: BitField) -> str:
    return f"bits {bits_words(part)} {part.id}"
