"""What an extension drops of its base, and what it overrides: each is found in the base, or it is an error."""

from dataclasses import dataclass, field
from functools import partial

from regscribe.compose.findings import ComposeFindings, meant
from regscribe.compose.patch import Patch
from regscribe.compose.rules import CHANGES_NOTHING, DROPS_NOTHING, NO_REASON, NO_TARGET
from regscribe.compose.tree import Location, at, edit, elements, id_of, kept, members, registers, text
from regscribe.model import Override
from regscribe.source import SourceNode, SourcePlace

_KINDS = ("register", "group", "command", "program", "enum")
_TABLES = {"command": "commands", "program": "programs", "enum": "enums"}
_DROPPED = {"registers": "register", "groups": "group", "commands": "command", "programs": "program"}
_PLACES = {"errata": "where", "examples": "source"}
_WHOLE = ("notes", "waivers")


@dataclass(slots=True)
class Changes:
    """The base while it is changed; `base` is where its id stands, `records` what docs show."""

    root: SourceNode
    base: SourcePlace
    findings: ComposeFindings
    records: list[Override] = field(default_factory=list)

    def drop(self, node: SourceNode) -> None:
        """Take out what stands under `drop`."""
        for table, kind in _DROPPED.items():
            for each in elements(node.child(table)):
                self._drop_thing(kind, each)
        for table, key in _PLACES.items():
            wanted = node.child(table)
            if wanted is not None:
                self._drop_places(table, key, wanted)
        for table in _WHOLE:
            if node.child(table) is not None:
                self._drop_all(table, node.child(table) or node)

    def override(self, node: SourceNode) -> None:
        """Change what one element of `override` names."""
        kind = next(each for each in _KINDS if node.child(each))
        name, reason, new = node.child(kind) or node, node.child("reason"), node.child("set") or node
        self.findings.reason(NO_REASON, reason, f"the override of {kind} `{text(name)}`")
        places = self._locations(kind, text(name))
        if not places:
            self._missing(NO_TARGET, kind, name)
            return
        patches = [Patch(self._defaults(location)) for location in places]
        for location, patch in zip(places, patches, strict=True):
            self.root = edit(self.root, location, partial(patch.lay, above=new))
        self._idle(kind, text(name), patches)
        changed = tuple(dict.fromkeys(each for patch in patches for each in patch.changed))
        self.records.append(Override(kind, text(name), text(reason).strip(), changed, name.place.span("")))

    def _idle(self, kind: str, name: str, patches: list[Patch]) -> None:
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

    def _drop_thing(self, kind: str, node: SourceNode) -> None:
        name, reason = node.child("id") or node, node.child("reason")
        self.findings.reason(NO_REASON, reason, f"the drop of {kind} `{text(name)}`")
        places = self._locations(kind, text(name))
        if not places:
            self._missing(DROPS_NOTHING, kind, name)
        for location in reversed(places):
            self.root = edit(self.root, location, lambda _: None)
        self.records.append(Override(kind, text(name), text(reason).strip(), (), name.place.span("")))

    def _drop_places(self, table: str, key: str, node: SourceNode) -> None:
        if node.elements is None:
            self._drop_all(table, node)
            return
        have = [text(each.child(key)) for each in elements(self.root.child(table))]
        for each in elements(node):
            if text(each) not in have:
                message = f"the base has no {table} of `{text(each)}`"
                self.findings.add(DROPS_NOTHING, message, each.place, meant(text(each), have), self._at_base)
            self.records.append(Override(table, text(each), "", (), each.place.span("")))
        gone = {text(each) for each in elements(node)}
        self.root = kept(self.root, table, lambda each: text(each.child(key)) not in gone)

    def _drop_all(self, table: str, node: SourceNode) -> None:
        if not elements(self.root.child(table)):
            message = f"the base has no {table}"
            self.findings.add(DROPS_NOTHING, message, node.place, "remove the key", self._at_base)
        self.records.append(Override(table, "all", "", (), node.place.span("")))
        self.root = kept(self.root, table, lambda _: False)

    def _locations(self, kind: str, name: str) -> list[Location]:
        if kind in _TABLES:
            return [(_TABLES[kind], name)] if name in members(self.root.child(_TABLES[kind])) else []
        if kind == "group":
            groups = elements(self.root.child("groups"))
            return [("groups", number) for number, group in enumerate(groups) if id_of(group) == name]
        return [location for path, location in registers(self.root) if path == name]

    def _known(self, kind: str) -> list[str]:
        if kind in _TABLES:
            return list(members(self.root.child(_TABLES[kind])))
        if kind == "group":
            return [id_of(group) for group in elements(self.root.child("groups"))]
        return [path for path, _ in registers(self.root)]

    def _missing(self, rule: str, kind: str, node: SourceNode) -> None:
        message = f"the base has no {kind} `{text(node)}`"
        self.findings.add(rule, message, node.place, meant(text(node), self._known(kind)), self._at_base)

    @property
    def _at_base(self) -> tuple[str, SourcePlace]:
        return "the base", self.base
