"""Addresses in every notation: which one, and from what it counts, is decided once for the whole column."""

from collections.abc import Sequence
from dataclasses import replace

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.address_pairs import together
from regscribe.importers.table.cells.address_rule import LAST, Rule
from regscribe.importers.table.cells.address_rules import decide
from regscribe.importers.table.cells.address_values import Address, AddressColumn, Column, Reading
from regscribe.importers.table.cells.bits import Bits, from_0
from regscribe.importers.table.cells.notations import Printed, printed, space_of
from regscribe.importers.table.cells.spaces import REGIONS
from regscribe.model import Space

__all__ = ["Address", "AddressColumn", "Column", "base_words", "parse_addresses"]

Read = Printed | Unclear | None


def base_words() -> tuple[str, ...]:
    """The words that `base` of `parse_addresses` takes."""
    return ("0", "1", "modicon", "hex", "decimal")


def parse_addresses(
    columns: Sequence[Column], *, spaces: Sequence[Space | None] = (), words: Sequence[bool] = (), base: str = ""
) -> AddressColumn:
    """Read one column of addresses, or several of the same registers (hexadecimal and decimal, or one apart).

    `spaces` are those that other columns say, row by row, and `words` whether its type takes whole words, which no bit
    does. `base` is what the user says: `0` or `1` (from what the numbers count), `modicon` (40001 is the first
    holding register), `hex` or `decimal`, several joined by commas.
    """
    said = {word.strip().casefold() for word in base.split(",")}
    first, *others = [_one_column(column, spaces, words, said) for column in columns]
    for other in others:
        first = together(first, other)
    rule = first.rule
    option = "" if others else _words(rule)
    return AddressColumn(rule.notation, rule.evidence, first.cells, assumed=rule.assumed, words=option)


def _words(rule: Rule) -> str:
    if rule.notation == "regions":
        return ""
    return "modicon" if rule.regions else f"{rule.base},hex" if rule.digits == 16 else str(rule.base)  # noqa: PLR2004 - hex


def _one_column(column: Column, spaces: Sequence[Space | None], words: Sequence[bool], said: set[str]) -> Reading:
    read: list[Read] = [printed(text) if text.strip(" -\t\n") else None for text in column.texts]
    if any(isinstance(one, Printed) and one.region is not None for one in read):
        read = [one.as_region if isinstance(one, Printed) else one for one in read]
    every = [one for one in read if isinstance(one, Printed)]
    if every and all(one.has_point_zero for one in every):  # numbers of a spreadsheet, no bits
        read = [replace(one, bits=None) if isinstance(one, Printed) else one for one in read]
    bits = from_0([one.bits if isinstance(one, Printed) else None for one in read])
    read = [_with_bits(one, each) for one, each in zip(read, bits.cells, strict=True)]
    beside = [*spaces, *[None] * (len(read) - len(spaces))]
    typed = [*words, *[False] * (len(read) - len(words))]
    rule = decide(read, column.header, beside, said, typed)
    rule = replace(rule, evidence="; ".join(filter(None, (rule.evidence, bits.evidence))))
    cells = tuple(
        _address(one, rule, space, text, of_words=of_words) if isinstance(one, Printed) else one
        for one, space, text, of_words in zip(read, beside, column.texts, typed, strict=False)
    )
    numbers = tuple(one.number(rule.digits) if isinstance(one, Printed) and rule.reads(one) else None for one in read)
    return Reading(column.header, column.texts, rule, cells, numbers)


def _with_bits(one: Read, bits: Bits | Unclear | None) -> Read:
    if not isinstance(one, Printed) or isinstance(bits, Unclear):
        return bits if isinstance(one, Printed) and isinstance(bits, Unclear) else one
    return replace(one, bits=bits)


def _address(one: Printed, rule: Rule, beside: Space | None, text: str, *, of_words: bool) -> Address | Unclear:
    """The address of one cell by the rule of its column."""
    if not rule.reads(one):
        return Unclear(f"{quoted(text)} has letters, and the other addresses are decimal")
    if why := rule.doubt(one):
        return Unclear(f"{quoted(text)} {why}")
    number, space = one.number(rule.digits), space_of(one, by_function=bool(rule.by_function))
    if (of := rule.modicon(one)) is not None:
        space, number = REGIONS[of[0]], of[1]
    if space and beside and space is not beside:
        return Unclear(f"{quoted(text)} is an address of {space} registers, and another column says {beside}")
    if of_words and beside is None and space is not None and space.is_bits:
        return Unclear(f"{quoted(text)} is an address of a {space}, which is one bit, and its type takes whole words")
    at = number - rule.base_of(one)
    if not 0 <= at <= LAST:
        return Unclear(f"{quoted(text)} is {at} as a wire address, which goes from 0 to {LAST}")
    count = one.end(rule.digits) - one.number(rule.digits) + 1 if one.last else 0
    return Address(at, space, count, one.bits)
