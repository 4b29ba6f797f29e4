"""One mapping laid over another key by key: null removes a key, and what changes nothing is reported."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from regscribe.compose.tree import cut, key_place, members, put
from regscribe.schema import inline
from regscribe.source import Node, Place, shorten

_LONGEST = 160
_NOTHING = "nothing"


@dataclass(slots=True)
class Patch:
    """What came of it: `changed` in words, and for each idle key its path, its place and that of the value below."""

    changed: list[str] = field(default_factory=list)
    idle: list[tuple[str, Place, Place]] = field(default_factory=list)

    def lay(self, below: Node, above: Node, path: str = "") -> Node:
        """`below` with the keys of `above`; mappings in both are merged in turn."""
        for key, new in members(above).items():
            old, name, where = below.child(key), f"{path}{key}", key_place(above, key)
            if old is not None and old.members is not None and new.members is not None:
                below = put(below, key, self.lay(old, new, f"{name}."), key_place(below, key))
            elif _same(old, new):
                self.idle.append((name, where, key_place(below, key)))
            else:
                self.changed.append(f"{name}: {_shown(old)} -> {_shown(new)}")
                below = cut(below, key) if new.value is None else put(below, key, _clean(new), where)
        return below


def _same(old: Node | None, new: Node) -> bool:
    if old is None:
        return new.value is None
    return type(old.value) is type(new.value) and bool(old.value == new.value)


def _clean(node: Node) -> Node:
    """A new mapping without the keys that are null: there is nothing below to remove."""
    for key in _null_keys(node):
        node = cut(node, key)
    return node


def _null_keys(node: Node) -> Iterator[str]:
    return (key for key, member in members(node).items() if member.value is None)


def _shown(node: Node | None) -> str:
    return _NOTHING if node is None or node.value is None else shorten(inline(node.value), _LONGEST)
