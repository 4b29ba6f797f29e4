"""The enum of a register, which may differ by case, and whose members may exist under conditions."""

from dataclasses import replace

from regscribe.lower.conditions import both, cases_of, condition, exclusive
from regscribe.lower.enums import enum_of
from regscribe.lower.node import Value
from regscribe.lower.scope import Scope
from regscribe.model import Enum


def enum_by_case(node: Value | None, scope: Scope, name: str) -> Enum | None:
    """The enum of a register; `name` is that of codes that stand at the register itself."""
    if node is None or not node.is_list:
        return enum_of(node, scope, inline_id=name, when=condition)
    places = {case.path: place for place, case in enumerate(node.elements(), start=1)}

    def make(case: Value) -> Enum:
        inline_id = f"{name}_{places[case.path]}"
        return enum_of(case.child("is"), scope, inline_id=inline_id, when=condition) or Enum(id=inline_id, members=())

    cases = exclusive(cases_of(node, scope, make))
    members = tuple(
        replace(member, when=both(case.when, member.when)) for case in cases for member in case.then.members
    )
    return Enum(id=name, members=members, span=node.key_span, cases=cases)
