"""Enums, bit fields and flags: codes, labels, ids and bits."""

import keyword
from collections import defaultdict
from collections.abc import Callable, Iterator
from fractions import Fraction
from itertools import combinations

from regscribe.checks.held_values import no_member
from regscribe.checks.identifiers import ENUM_NAMES, enums_of, normalised
from regscribe.checks.rule import Finding, RuleScope, model_rule, register_rule
from regscribe.model import BitField, Enum, Kind, Member, Register, WireType, show


def _finding(register: Register, field: str, enum: Enum, message: str, help_text: str) -> Finding:
    where = f"`{register.path}.{field}`" if field else f"`{register.path}`"
    span = enum.span if enum.span.file else register.span
    return Finding(register.path, span, f"the enum of {where} {message}", help_text)


@register_rule(
    "RS0440", "Enum code outside the type", "A code that the word cannot spell can never be read or written."
)
def code_outside_type(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Compare the codes with the type of the base view."""
    if register.enum is None or not register.base.type.is_integer or register.base.type is WireType.STRING:
        return
    low, high = register.base.type.minimum, register.base.type.maximum
    outside = [member.code for member in register.enum.members if not low <= member.code <= high]
    if outside:
        codes = ", ".join(map(str, outside))
        message = f"has enum codes {codes}, outside {register.base.type} ({low} to {high})"
        yield Finding.at(register, message, "correct the codes or the type")


def _label(member: Member) -> str:
    return " ".join(member.label.casefold().split())


def _together(enum: Enum, key: Callable[[Member], str]) -> Iterator[tuple[str, list[Member]]]:
    """Members of an enum that share a key, in the order of the first."""
    groups: defaultdict[str, list[Member]] = defaultdict(list)
    for member in enum.members:
        groups[key(member)].append(member)
    yield from ((name, members) for name, members in groups.items() if len(members) > 1)


def _codes(members: list[Member]) -> str:
    return ", ".join(str(member.code) for member in members)


@model_rule("RS0441", "Label used twice in an enum", "Two codes of one meaning: one of them was misread.")
def label_twice(scope: RuleScope) -> Iterator[Finding]:
    """Compare labels without case and blanks."""
    for register, field, enum in enums_of(scope):
        for label, members in _together(enum, _label):
            message = f'has the label "{label}" for codes {_codes(members)}'
            yield _finding(register, field, enum, message, "correct a label, or say what tells them apart")


@model_rule("RS0442", "Enum members of one id", "Labels that differ in signs only become one Python name.")
def member_id_twice(scope: RuleScope) -> Iterator[Finding]:
    """Compare ids without case and `_`; equal labels are RS0441's."""
    for register, field, enum in enums_of(scope):
        for name, members in _together(enum, lambda member: normalised(member.id)):
            if len({_label(member) for member in members}) == len(members):
                message = f"gives codes {_codes(members)} one id, {name.upper()}"
                yield _finding(register, field, enum, message, "give one of them an `id`: {label: ..., id: ...}")


@register_rule(
    "RS0443", "Default is no member of the enum", "The device leaves the factory with a code that has a meaning."
)
def default_no_member(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Look for the default among the codes of the register, and for its parts among those of the fields."""
    for what, value in register.beginnings:
        problem = no_member(register, value)
        if problem:
            yield Finding.at(register, f"has {what} {problem}", f"correct the {what}, or add the member")


@model_rule("RS0444", "Enum without members", "A model on which no code is valid cannot have the register.")
def no_members(scope: RuleScope) -> Iterator[Finding]:
    """Find enums that lost all members on this model."""
    for register, field, enum in enums_of(scope):
        if not enum.members:
            help_text = "give it members for this model, or the register an `except`"
            yield _finding(register, field, enum, "has no members", help_text)


@model_rule(
    "RS0454", "Cells and columns of an enum differ", "A cell without a column, or the reverse, says nothing certain."
)
def cells_of_columns(scope: RuleScope) -> Iterator[Finding]:
    """Count the cells of each member that has some."""
    for register, field, enum in enums_of(scope):
        for member in enum.members:
            if member.cells and len(member.cells) != len(enum.columns):
                message = f"has {len(member.cells)} cells for code {member.code}, but {len(enum.columns)} columns"
                yield _finding(register, field, enum, message, "give one cell for each of `columns`")


@model_rule("RS0445", "Member id is no Python name", "A member becomes an attribute of an IntEnum class.")
def member_no_name(scope: RuleScope) -> Iterator[Finding]:
    """Refuse what is no identifier, a keyword, or a name that `enum` uses itself."""
    checks: tuple[Callable[[str], bool], ...] = (keyword.iskeyword, lambda name: name.upper() in ENUM_NAMES)
    for register, field, enum in enums_of(scope):
        for member in enum.members:
            if not member.id.isidentifier() or member.id.startswith("_") or any(check(member.id) for check in checks):
                message = f"has member id {member.id} for code {member.code}, which Python cannot use"
                yield _finding(register, field, enum, message, "give the member another `id`")


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
