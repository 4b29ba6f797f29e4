"""What a condition or an example asks about: a register or one bit field of it, and its codes by name."""

from dataclasses import dataclass
from fractions import Fraction

from regscribe.lower.enums import code_anywhere, enum_for, fields_of
from regscribe.lower.labels import id_of
from regscribe.lower.node import ZERO, Value
from regscribe.lower.rules import DIVIDED, UNKNOWN_FIELD, UNKNOWN_MEMBER
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
    known: list[str] = []
    found = enum_for(subject.entry, scope.at(subject.entry), subject.field)
    if found is not None:
        table, enum = found
        code = code_anywhere(table, text)
        if code is not None:
            return Fraction(code)
        known = [member.id.lower() for member in enum.members]
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
