"""What a condition or an example asks about: a register or one bit field of it, and its codes by name."""

from dataclasses import dataclass
from fractions import Fraction

from regscribe.lower.enums import code_anywhere, enum_for, fields_of
from regscribe.lower.names import unknown
from regscribe.lower.node import Value, text_of
from regscribe.lower.rules import DIVIDED, UNKNOWN_FIELD, UNKNOWN_MEMBER
from regscribe.lower.scope import Scope
from regscribe.lower.tree import TreeNode
from regscribe.model.identifiers import snake


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
    if field not in known:
        unknown(node, UNKNOWN_FIELD, "bit field", field, known, of=register, at_key=True)
    return Subject(register, owner, field, known.get(field))


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
    specials = subject.entry.settings.get("special")
    for code_node in specials.values() if specials else ():
        name = _id(code_node).lower()
        if name == text.lower() and not subject.field:
            means = code_node.child("means")
            if means is not None:
                return means.number()
            _undivided(node, subject.entry, code_node)
            return code_node.key_number()
        known.append(name)
    where = f"{subject.name}.{subject.field}" if subject.field else subject.name
    unknown(node, UNKNOWN_MEMBER, "member or special value", text, known, of=where)
    return Fraction(0)


def _undivided(node: Value, entry: TreeNode, code_node: Value) -> None:
    """Report a special value that is another number with each number of decimals."""
    if "range_decimals" in entry.settings and code_node.key_number():
        message = f"`{node.text()}` of `{entry.id}` is divided as the range is, so it is no one number"
        node.report(DIVIDED, message, remedy="ask for a value, or for the register that holds the decimals as well")


def _id(node: Value) -> str:
    """The id of a special value."""
    return (text_of(node, "id") or snake(text_of(node, "label"))) if node.is_mapping else snake(node.text())
