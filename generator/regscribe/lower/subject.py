"""What a condition or an example asks about: a register or one bit field of it, and its codes by name."""

from dataclasses import dataclass
from fractions import Fraction

from regscribe.lower.enums import codes_named, enum_at, fields_of, tables_of
from regscribe.lower.labels import id_of
from regscribe.lower.node import ZERO, Value
from regscribe.lower.rules import DIVIDED, SEVERAL_CODES, UNKNOWN_FIELD, UNKNOWN_MEMBER
from regscribe.lower.scope import Scope
from regscribe.lower.texts import unknown
from regscribe.lower.tree import TreeNode

_SCALES = ("type", "multiply", "add", "decimals")
"""Keys by which the number of a bit field is another than that of its bits."""


@dataclass(frozen=True, slots=True)
class Subject:
    """A register as the map names it, and a bit field of it with its first and last bit ("" for the whole register)."""

    name: str
    entry: TreeNode
    field: str = ""
    bits: tuple[int, int] | None = None

    @property
    def path(self) -> str:
        """The path of the register, or `path.field`."""
        return f"{self.entry.path}.{self.field}" if self.field else self.entry.path


def subject_of(node: Value, key: str, scope: Scope) -> Subject | None:
    """The subject that the key of `node` names; RS0301, RS0302 or RS0303 and None where there is none."""
    entry = scope.find(key)
    if entry is not None:
        return Subject(key, entry)
    register, dot, field = key.rpartition(".")
    owner = scope.find(register) if dot else None
    if owner is None:
        scope.missing(node, register if dot and not field.endswith("]") and "]." not in key else key, at_key=True)
        return None
    known = {each.id: (each.low, each.high) for each in fields_of(owner, scope.at(owner))}
    fields = owner.settings.child("fields")
    stated = fields.child(field) if fields else None
    if stated and any(stated.child(key) for key in _SCALES):
        message = f"`{field}` of `{register}` is a number with a sign or a scale, which no condition asks for"
        node.report(UNKNOWN_FIELD, message, remedy="ask for the bits in another field without them", at_key=True)
    if field not in known:
        unknown(node, UNKNOWN_FIELD, "bit field", field, known, of=register, at_key=True)
    return Subject(register, owner, field, known.get(field))


def subject_at(node: Value | None, scope: Scope) -> str:
    """The register, or `register.field`, that a value names; empty where it is absent or names none."""
    subject = subject_of(node, node.text(), scope) if node else None
    return subject.path if subject else ""


def code_of_text(node: Value, subject: Subject, scope: Scope) -> Fraction:
    """The code of an enum member, or what a special value is, by its id; RS0305 where there is none."""
    text = node.text()
    here = scope.at(subject.entry)
    tables = tables_of(subject.entry, here, subject.field)
    codes = codes_named(tables, text)
    if codes:
        if len(tables) > 1:
            _one_meaning(node, subject, codes)
        return Fraction(next(iter(codes)))
    known = list(dict.fromkeys(member.id.lower() for table in tables for member in enum_at(table, here, "").members))
    settings = subject.entry.settings
    for _, special in settings.items_of("special"):
        name = id_of(special).lower()
        if name == text.lower() and not subject.field:
            means = special.child("means")
            if means is not None:
                return means.number()
            if "range_decimals" in settings and special.key_number():
                message = f"`{text}` of `{subject.entry.id}` is divided as the range is, so it is no one number"
                remedy = "ask for a value, or for the register that holds the decimals as well"
                node.report(DIVIDED, message, remedy=remedy)
            return special.key_number()
        known.append(name)
    where = f"{subject.name}.{subject.field}".removesuffix(".")
    unknown(node, UNKNOWN_MEMBER, "member or special value", text, known, of=where)
    return ZERO


def _one_meaning(node: Value, subject: Subject, codes: dict[int, set[str]]) -> None:
    """Report a name of an enum by case that says no single code, or a code that is called otherwise in a case."""
    names = {name for ids in codes.values() for name in ids}
    if len(codes) > 1 or len(names) > 1:
        means = "; ".join(f"{code} is {' or '.join(sorted(ids))}" for code, ids in sorted(codes.items()))
        message = f"`{node.text()}` of `{subject.path}` depends on its case: {means}"
        node.report(SEVERAL_CODES, message, remedy="write the code, and in a condition test what decides the case too")
