"""Removes what refers to dropped registers: empty groups, and examples and waivers of registers that are gone."""

import re

from regscribe.compose.tree import edit, elements, id_of, kept, members, registers, text
from regscribe.source import SourceNode

_INDEX = re.compile(r"\[[0-9]+\]")


def without_dangling(root: SourceNode, before: set[str]) -> SourceNode:
    """The map without what refers to registers that it had (their paths are `before`) and has no more."""
    for number, group in reversed(list(enumerate(elements(root.child("groups"))))):
        if not elements(group.child("registers")):
            root = edit(root, ("groups", number), lambda _: None)
    gone = before - {path for path, _ in registers(root)}
    groups = {id_of(group) for group in elements(root.child("groups"))}
    root = kept(root, "write_order", lambda node: text(node) in groups)
    root = kept(root, "examples", lambda node: not _about(node, gone))
    return kept(root, "waivers", lambda node: _INDEX.sub("", text(node.child("at"))) not in gone)


def _about(example: SourceNode, gone: set[str]) -> bool:
    """Whether an example needs a register that is gone (or a bit field of one)."""
    named = [text(example.child("register")), *members(example.child("with")), *members(example.child("writes"))]
    paths = [_INDEX.sub("", name) for name in named]
    return any(path in gone or path.rpartition(".")[0] in gone for path in paths)
