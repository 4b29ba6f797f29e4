"""What has lost what it was about: groups without registers, examples and waivers of registers that are gone."""

import re
from collections.abc import Callable

from regscribe.compose.tree import cut, edit, elements, id_of, key_place, listing, members, put, registers, text
from regscribe.source import SourceNode

_INDEX = re.compile(r"\[[0-9]+\]")


def without_orphans(root: SourceNode, before: set[str]) -> SourceNode:
    """A map that had registers of the paths `before`, less what was about those of them that it lacks now."""
    for number, group in reversed(list(enumerate(elements(root.child("groups"))))):
        if not elements(group.child("registers")):
            root = edit(root, ("groups", number), lambda _: None)
    gone = before - {path for path, _ in registers(root)}
    groups = {id_of(group) for group in elements(root.child("groups"))}
    root = _filtered(root, "write_order", lambda node: text(node) in groups)
    root = _filtered(root, "examples", lambda node: not _about(node, gone))
    return _filtered(root, "waivers", lambda node: _INDEX.sub("", text(node.child("at"))) not in gone)


def _filtered(root: SourceNode, key: str, keep: Callable[[SourceNode], bool]) -> SourceNode:
    have = root.child(key)
    if have is None:
        return root
    kept = [each for each in elements(have) if keep(each)]
    return put(root, key, listing(kept, have.place), key_place(root, key)) if kept else cut(root, key)


def _about(example: SourceNode, gone: set[str]) -> bool:
    """Whether an example needs a register that is gone (or a bit field of one)."""
    named = [text(example.child("register")), *members(example.child("with")), *members(example.child("writes"))]
    paths = [_INDEX.sub("", name) for name in named]
    return any(path in gone or path.rpartition(".")[0] in gone for path in paths)
