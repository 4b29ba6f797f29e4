"""The groups of a map as one class: each group has the members that any model has."""

from collections.abc import Iterable, Mapping

from regscribe.emit.python.formatting import call, lay
from regscribe.emit.python.literals import literal
from regscribe.emit.words import one_line
from regscribe.model import Group, RegisterMap

Content = Mapping[str, tuple[str, tuple[str, ...], int | None]]
"""Title, members and place in the write order of each group by its id.

Members are ids of registers, or of arrays for all that is in them.
"""


def groups_of(register_map: RegisterMap) -> Content:
    """The groups of all models together, each thing where the model that has it has it."""
    every = {one.id: one for model in register_map.models for one in model.groups}
    order = _merged([group.id for group in model.groups] for model in register_map.models)
    members = {
        name: _merged(_first_parts(one) for model in register_map.models for one in model.groups if one.id == name)
        for name in order
    }
    return {name: (one_line(every[name].name), tuple(members[name]), every[name].order) for name in order}


def _merged(orders: Iterable[Iterable[str]]) -> list[str]:
    """All names of several orders in one: each new name behind the one that it follows."""
    merged: dict[str, None] = {}
    for order in orders:
        behind: dict[str, list[str]] = {}
        last = ""
        for name in order:
            if name in merged:
                last = name
            else:
                behind.setdefault(last, []).append(name)
        if behind:
            merged = dict.fromkeys(new for known in ("", *merged) for new in (known, *behind.get(known, ())) if new)
    return list(merged)


def _first_parts(group: Group) -> dict[str, None]:
    return dict.fromkeys(path.split("[")[0] for path in group.members)


def groups_body(groups: Content, homes: Mapping[str, str]) -> list[str]:
    """The declarations; `homes` are the classes that declare the members."""
    body: list[str] = []
    for name, (title, members, order) in groups.items():
        place = None if order is None else str(order)
        declared = (f"{homes[member]}.{member}" for member in members)
        body += lay(call("Group", literal(title), *declared, order=place), head=f"{name} = ", depth=1)
    return body
