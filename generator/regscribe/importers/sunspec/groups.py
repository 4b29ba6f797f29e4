"""Groups of SunSpec's models laid out one behind the other, with the most elements of those that are repeated."""

from dataclasses import dataclass, field, replace
from typing import Any

from regscribe.draft import Entry, Remark
from regscribe.draft.ids import Taken, free_id
from regscribe.importers.shared.exact import whole
from regscribe.importers.shared.reading import Keys, LeftOutError, refuse
from regscribe.importers.shared.tree import Node
from regscribe.importers.sunspec.points import PAD, SHOWN, register_of
from regscribe.model import Diagnostic, Span
from regscribe.model.identifiers import snake


@dataclass(slots=True)
class Scope:
    """The group that is laid out: names of its points and of those around it, and what is found on the way.

    `prefix` stands before the names of a group that is not repeated and lies in another. `repeated`: it is an element
    of several; `followed`: something stands behind it.
    """

    file: str
    group: str
    most: int
    outer: "Scope | None" = None
    prefix: str = ""
    repeated: bool = False
    followed: bool = False
    ids: dict[str, str] = field(default_factory=dict)
    taken: Taken = field(default_factory=dict)
    findings: list[Diagnostic] = field(default_factory=list)

    def find(self, name: str) -> str:
        """Return the id of a point of this group or one around. Raises LeftOutError where there is none."""
        scope: Scope | None = self
        while scope is not None:
            if name in scope.ids:
                return scope.ids[name]
            scope = scope.outer
        return refuse("sf", f"there is no point {name} in the groups around")

    def place(self, node: Node) -> Span:
        """The place of a value."""
        return Span(self.file, node.line, 1, node.line, 1)


def laid_out(group: Node, scope: Scope) -> tuple[Entry, ...]:
    """Return the entries of a model's group and of all in it; addresses count from its first point."""
    return _entries(group, scope, 0)[0]


def _entries(group: Node, scope: Scope, at: int) -> tuple[tuple[Entry, ...], int]:
    """The entries of a group from an address on, and the address behind it."""
    points, groups = group.get("points"), group.get("groups")
    every = points.each if points else ()
    for point in every:
        name = f"{scope.prefix}{point.word('name')}"
        scope.ids[point.word("name")] = free_id(snake(name), {"at": at}, scope.taken)
    entries: list[Entry] = []
    for point in every:
        if point.word("type") != PAD:
            entries.append(_point(point, scope, at))
        at += whole(point.word("size")) or 1
    inners = groups.each if groups else ()
    for number, inner in enumerate(inners, start=1):
        moved = scope.repeated or scope.followed or number < len(inners)
        found, at = _inner(inner, scope, at, moved=moved)
        entries += found
    return tuple(entries), at


def _point(point: Node, scope: Scope, at: int) -> Entry:
    name = point.word("name")
    keys = Keys(point)
    entry = Entry(name=f"{scope.prefix}{name}", place=scope.place(point), group=scope.group)
    try:
        found = register_of(keys, at, scope.ids[name], scope.find)
    except LeftOutError as why:
        return replace(entry, remarks=(why.remark,))
    if scope.prefix:
        found["name"] = f"{scope.prefix.strip('_')} {found['name']}"
    return replace(entry, keys=found, remarks=(*keys.remarks, *keys.rest(SHOWN)))


def _inner(group: Node, scope: Scope, at: int, *, moved: bool) -> tuple[tuple[Entry, ...], int]:
    """A group inside another: one that is not repeated is a part of it, with a name before those of its points.

    `moved`: something stands behind it, so that elements which a device lacks move that.
    """
    name, told = group.word("name"), group.word("count")
    count = whole(told)
    if not told or count == 1:
        part = replace(scope, prefix=f"{scope.prefix}{name}_", ids={}, outer=scope, followed=moved)
        return _entries(group, part, at)
    try:
        repeat, most = _repeat(told, count, scope, moved=moved)
    except LeftOutError as why:
        entry = Entry(name=name, place=scope.place(group), remarks=(why.remark,), group=scope.group)
        return (entry,), at
    element = Scope(scope.file, scope.group, scope.most, scope, repeated=True, findings=scope.findings)
    members, end = _entries(group, element, at)
    keys: dict[str, Any] = {
        "id": free_id(snake(f"{scope.prefix}{name}"), {"at": at}, scope.taken),
        "name": group.word("label") or name,
        "repeat": repeat,
        "stride": max(end - at, 1),
    }
    described = " ".join(group.word("desc").split())
    keys |= {"description": described} if described else {}
    remarks = () if members else (Remark("group-empty", "the group has no points"),)
    entry = Entry(
        name=name,
        place=scope.place(group),
        keys=keys if members else None,
        remarks=remarks,
        group=scope.group,
        members=members,
    )
    return (entry,), at + most * (end - at)


def _repeat(told: str, count: int | None, scope: Scope, *, moved: bool) -> tuple[Any, int]:
    """The key `repeat` of a group, and the most elements that it has."""
    if count:
        return f"1..{count}", count
    if count == 0:
        return {"from": 1, "to": {"block": "end"}, "most": scope.most}, scope.most
    packed = {"packed": True} if moved else {}
    return {"from": 1, "to": scope.find(told), "most": scope.most, **packed}, scope.most
