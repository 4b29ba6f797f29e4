"""Bit fields and flags of a word."""

from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations

from regscribe.checks.identifiers import normalised
from regscribe.checks.rule import Finding, RuleScope, register_rule
from regscribe.model import BitField, Kind, Register, show


def _where(bits: BitField) -> str:
    return f"`{bits.id}` (bit {bits.low})" if bits.width == 1 else f"`{bits.id}` (bits {bits.low}..{bits.high})"


@register_rule("RS0450", "Bit fields overlap", "One bit has one meaning: a row of the bit table was misread.")
def bits_overlap(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Compare the fields of a word in pairs (there are 64 at most)."""
    for one, other in combinations(register.fields, 2):
        if one.low <= other.high and other.low <= one.high:
            message = f"has bit fields {_where(one)} and {_where(other)} that overlap"
            yield Finding.at(register, message, "correct the bits of one of them")


@register_rule("RS0451", "Bit outside the word", "A bit beyond the word's width can never be read.")
def bit_outside_word(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Compare each field with the width of the base view."""
    for bits in register.fields:
        if bits.low < 0 or bits.high >= register.bits:
            message = f"has bit field {_where(bits)} in a word of bits 0..{register.bits - 1}"
            yield Finding.at(register, message, "correct the bits or the type")


@register_rule("RS0452", "Enum wider than its bit field", "A code that the bits cannot spell never occurs.")
def enum_wider_than_field(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Compare the codes of each field's enum with its width."""
    for bits in register.fields:
        outside = [m.code for m in bits.enum.members if not 0 <= m.code < 1 << bits.width] if bits.enum else []
        if outside:
            codes = ", ".join(map(str, outside))
            message = f"has bit field {_where(bits)} with codes {codes}, outside 0..{(1 << bits.width) - 1}"
            yield Finding.at(register, message, "correct the codes or the bits")


@register_rule("RS0453", "Bit fields of one name", "Two bits of one id or label cannot be told apart.")
def bits_of_one_name(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Compare ids and labels of the fields of a word."""
    for one, other in combinations(register.fields, 2):
        same_label = one.label and one.label.casefold() == other.label.casefold()
        if normalised(one.id) == normalised(other.id) or same_label:
            message = f'has bit fields {_where(one)} and {_where(other)} both called "{other.label}"'
            yield Finding.at(register, message, "correct one of them")


@register_rule(
    "RS0655",
    "Default with bits that mean nothing",
    "A driver writes no bit that has no name, so it could never write this default.",
)
def default_of_no_name(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Compare the bits of a default with the flags; a device may be delivered with more of them set."""
    if register.kind is not Kind.FLAGS or not isinstance(register.default, Fraction):
        return
    unnamed = int(register.default) & ~sum(((1 << bits.width) - 1) << bits.low for bits in register.fields)
    if 0 <= register.default < 1 << register.bits and unnamed:
        bits = ", ".join(str(bit) for bit in range(register.bits) if unnamed >> bit & 1)
        message = f"has default {show(register.default)}, but no flag at bit {bits}"
        yield Finding.at(register, message, "name the bits, or give the value as `delivered`")
