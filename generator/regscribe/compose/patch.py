"""One mapping laid over another key by key: null removes a key, and what changes nothing is reported."""

from dataclasses import dataclass, field

from regscribe.compose.tree import cut, key_place, members, put
from regscribe.schema import inline
from regscribe.source import SourceNode, SourcePlace, shorten

_LONGEST = 160
_NOTHING = "nothing"


@dataclass(frozen=True, slots=True)
class IdleKey:
    """A key that changes nothing: its path, its place, and that of the equal value below.

    `is_default`: it is null, and the value below is a default, which only its own mapping can lose.
    """

    path: str
    place: SourcePlace
    below: SourcePlace
    is_default: bool = False


@dataclass(slots=True)
class Patch:
    """Lays mappings over others, and keeps what came of it: `changed` in words, and the keys that were `idle`.

    `defaults` are the keys that count where the mapping below has none of its own, the innermost first.
    """

    defaults: tuple[SourceNode, ...] = ()
    changed: list[str] = field(default_factory=list)
    idle: list[IdleKey] = field(default_factory=list)

    def lay(self, below: SourceNode, above: SourceNode, path: str = "") -> SourceNode:
        """`below` with the keys of `above`; mappings in both are merged in turn."""
        for key, new in members(above).items():
            below = self._laid(below, key, new, key_place(above, key), path)
        return below

    def _laid(self, below: SourceNode, key: str, new: SourceNode, where: SourcePlace, path: str) -> SourceNode:
        old, name = below.child(key), f"{path}{key}"
        if old is not None and old.members is not None and new.members is not None:
            return put(below, key, self.lay(old, new, f"{name}."), key_place(below, key))
        holder = below if path else self._holder(below, key)
        removes_default = holder is not below and new.value is None
        if removes_default or _same(holder.child(key), new):
            self.idle.append(IdleKey(name, where, key_place(holder, key), is_default=removes_default))
            return below
        self.changed.append(f"{name}: {_shown(holder.child(key))} -> {_shown(new)}")
        return cut(below, key) if new.value is None else put(below, key, _clean(new), where)

    def _holder(self, below: SourceNode, key: str) -> SourceNode:
        """The mapping that has the key now: the one below, else the innermost one of defaults."""
        return next((each for each in (below, *self.defaults) if each.child(key)), below)


def _same(old: SourceNode | None, new: SourceNode) -> bool:
    if old is None:
        return new.value is None
    return type(old.value) is type(new.value) and bool(old.value == new.value)


def _clean(node: SourceNode) -> SourceNode:
    """A new mapping without the keys that are null: there is nothing below to remove."""
    for key in [key for key, member in members(node).items() if member.value is None]:
        node = cut(node, key)
    return node


def _shown(node: SourceNode | None) -> str:
    return _NOTHING if node is None or node.value is None else shorten(inline(node.value), _LONGEST)
