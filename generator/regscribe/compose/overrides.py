"""What an extension drops of its base, and what it overrides: each is found in the base, or it is an error."""

import re
from dataclasses import dataclass, field
from functools import partial

from regscribe.compose.findings import CHANGES_NOTHING, DROPS_NOTHING, NO_REASON, NO_TARGET, ComposeFindings
from regscribe.compose.patch import Patch
from regscribe.compose.tree import Location, at, edit, elements, id_of, kept, members, registers, remove, text
from regscribe.model import Override
from regscribe.source import SourceNode, SourcePlace

_KINDS = ("register", "group", "command", "program", "enum")
_TABLES = {"command": "commands", "program": "programs", "enum": "enums"}
_DROPPED = {"registers": "register", "groups": "group", "commands": "command", "programs": "program"}
_PLACES = {"errata": "where", "examples": "source"}
_WHOLE = ("notes", "waivers")
_INDEX = re.compile(r"\[[0-9]+\]")


@dataclass(slots=True)
class Changes:
    """The base while it is changed; `at_base` is where its id stands, `records` what docs show."""

    root: SourceNode
    at_base: tuple[str, SourcePlace]
    findings: ComposeFindings
    records: list[Override] = field(default_factory=list)

    def drop(self, node: SourceNode) -> None:
        """Take out what stands under `drop`."""
        for table, kind in _DROPPED.items():
            for each in elements(node.child(table)):
                self._drop_thing(kind, each)
        for table, key in _PLACES.items():
            places = node.child(table)
            if places is not None and places.elements is not None:
                self._drop_places(table, key, places.elements)
        for table in (*_PLACES, *_WHOLE):
            whole = node.child(table)
            if whole is not None and (table in _WHOLE or whole.elements is None):
                self._drop_whole(table, whole)

    def _drop_thing(self, kind: str, node: SourceNode) -> None:
        name, reason = node.child("id") or node, node.child("reason")
        self.findings.reason(NO_REASON, reason, f"the drop of {kind} `{text(name)}`")
        for location in reversed(self._locations(DROPS_NOTHING, kind, name)):
            self.root = remove(self.root, location)
        self.records.append(Override(kind, text(name), text(reason).strip(), (), name.place.span("")))

    def _drop_places(self, table: str, key: str, wanted: list[SourceNode]) -> None:
        have = [text(each.child(key)) for each in elements(self.root.child(table))]
        for each in wanted:
            if text(each) not in have:
                message = f"the base has no {table} of `{text(each)}`"
                self.findings.unknown(DROPS_NOTHING, message, each, have, self.at_base)
            self.records.append(Override(table, text(each), "", (), each.place.span("")))
        gone = {text(each) for each in wanted}
        self.root = kept(self.root, table, lambda each: text(each.child(key)) not in gone)

    def _drop_whole(self, table: str, node: SourceNode) -> None:
        if not elements(self.root.child(table)):
            message = f"the base has no {table}"
            self.findings.add(DROPS_NOTHING, message, node.place, "remove the key", self.at_base)
        self.records.append(Override(table, "all", "", (), node.place.span("")))
        self.root = kept(self.root, table, lambda _: False)

    def drop_dangling(self, before: set[str]) -> None:
        """Take out what refers to registers that the base had (their paths are `before`) and that are gone.

        These are empty groups, and examples and waivers of such registers.
        """
        root = self.root
        for number, group in reversed(list(enumerate(elements(root.child("groups"))))):
            if not elements(group.child("registers")):
                root = remove(root, ("groups", number))
        gone = before - {path for path, _ in registers(root)}
        groups = {id_of(group) for group in elements(root.child("groups"))}
        root = kept(root, "write_order", lambda node: text(node) in groups)
        root = kept(root, "examples", lambda node: not _needs(node, gone))
        self.root = kept(root, "waivers", lambda node: _INDEX.sub("", text(node.child("at"))) not in gone)

    def override(self, node: SourceNode) -> None:
        """Change what one element of `override` names."""
        kind = next(each for each in _KINDS if node.child(each))
        name, reason, new = node.child(kind) or node, node.child("reason"), node.child("set") or node
        self.findings.reason(NO_REASON, reason, f"the override of {kind} `{text(name)}`")
        locations = self._locations(NO_TARGET, kind, name)
        if not locations:
            return
        patches = [Patch(self._defaults(location)) for location in locations]
        for location, patch in zip(locations, patches, strict=True):
            self.root = edit(self.root, location, partial(patch.lay, above=new))
        self._report_idle(kind, text(name), patches)
        changed = tuple(dict.fromkeys(each for patch in patches for each in patch.changed))
        self.records.append(Override(kind, text(name), text(reason).strip(), changed, name.place.span("")))

    def _report_idle(self, kind: str, name: str, patches: list[Patch]) -> None:
        """Report the keys that changed nothing in any of the things of that name."""
        for idle in patches[0].idle:
            if all(any(idle.path == each.path for each in patch.idle) for patch in patches):
                message = f"this changes nothing: `{idle.path}` of {kind} `{name}` is so in the base already"
                advice = "remove the key"
                if idle.is_default:
                    message = f"this removes nothing: {kind} `{name}` has `{idle.path}` from the `each` around it only"
                    advice = "override the group or array that has the `each`"
                self.findings.add(CHANGES_NOTHING, message, idle.place, advice, ("in the base", idle.below))

    def _defaults(self, location: Location) -> tuple[SourceNode, ...]:
        """The `each` of the array and the group around a register, the innermost first."""
        around = (at(self.root, location[:length]) for length in range(len(location) - 1, 0, -1))
        return tuple(each for node in around if node and (each := node.child("each")))

    def _locations(self, rule: str, kind: str, node: SourceNode) -> list[Location]:
        """Where the things of a kind stand whose name `node` gives; reports `rule` where there are none."""
        known: list[tuple[str, Location]]
        if kind in _TABLES:
            known = [(name, (_TABLES[kind], name)) for name in members(self.root.child(_TABLES[kind]))]
        elif kind == "group":
            groups = elements(self.root.child("groups"))
            known = [(id_of(group), ("groups", number)) for number, group in enumerate(groups)]
        else:
            known = list(registers(self.root))
        found = [location for name, location in known if name == text(node)]
        if not found:
            message = f"the base has no {kind} `{text(node)}`"
            self.findings.unknown(rule, message, node, [name for name, _ in known], self.at_base)
        return found


def _needs(example: SourceNode, gone: set[str]) -> bool:
    """Whether an example needs a register that is gone (or a bit field of one)."""
    named = [text(example.child("register")), *members(example.child("with")), *members(example.child("writes"))]
    paths = [_INDEX.sub("", name) for name in named]
    return any(path in gone or path.rpartition(".")[0] in gone for path in paths)
