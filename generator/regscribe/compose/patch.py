"""One mapping laid over another key by key: null removes a key, and what changes nothing is reported."""

from dataclasses import dataclass, field

from regscribe.compose.tree import cut, key_place, members, put
from regscribe.schema import inline
from regscribe.source import SourceNode, SourcePlace, shorten

_LONGEST = 160


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
            old, name = below.child(key), f"{path}{key}"
            if old is not None and old.members is not None and new.members is not None:
                below = put(below, key, self.lay(old, new, f"{name}."))
            else:
                below = self._replace(below, above, key, path)
        return below

    def _replace(self, below: SourceNode, above: SourceNode, key: str, path: str) -> SourceNode:
        """`below` with one key of `above` in place of its own, and of a default at the top."""
        new, name = members(above)[key], f"{path}{key}"
        around = () if path else self.defaults
        holder = next(filter(lambda each: each.child(key), (below, *around)), below)
        old = holder.child(key)
        removes_default = holder is not below and new.value is None
        if removes_default or _same(old, new):
            self.idle.append(IdleKey(name, key_place(above, key), key_place(holder, key), is_default=removes_default))
            return below
        self.changed.append(f"{name}: {_shown(old)} -> {_shown(new)}")
        if new.value is None:
            return cut(below, key)
        nulls = [name for name, member in members(new).items() if member.value is None]  # with nothing to remove
        return put(below, key, cut(new, *nulls) if nulls else new, above)


def _same(old: SourceNode | None, new: SourceNode) -> bool:
    if old is None:
        return new.value is None
    return type(old.value) is type(new.value) and bool(old.value == new.value)


def _shown(node: SourceNode | None) -> str:
    return "nothing" if node is None or node.value is None else shorten(inline(node.value), _LONGEST)
