"""Where the names of a program's registers are looked up, and what they mean there."""

import re
from dataclasses import dataclass
from fractions import Fraction

from regscribe.lower.node import ZERO, Value
from regscribe.lower.rules import UNKNOWN_REGISTER
from regscribe.lower.scope import Scope
from regscribe.lower.subject import Subject, code_of_text
from regscribe.lower.texts import unknown
from regscribe.model import numbered

_ELEMENT = re.compile(r"\[(\d+)\]")


def numbers_of(node: Value, name: str, scope: Scope) -> list[int]:
    """The indices of an array's elements; RS0301 and none if there is no such array."""
    elements = [path.removeprefix(name) for path in scope.entries if path.startswith(f"{name}[")]
    numbers = sorted({int(match[1]) for element in elements if (match := _ELEMENT.match(element))})
    if not numbers:
        known = dict.fromkeys(_ELEMENT.split(path)[0] for path in scope.owners if "[" in path)
        unknown(node, UNKNOWN_REGISTER, "array", node.text(), known)
    return numbers


@dataclass(frozen=True, slots=True)
class ProgramPlace:
    """Where the names of a program's registers are looked up: in each element `prefix`, then everywhere.

    `inside` is the path of a segment, `first` the number of the first one; it comes before the element.
    """

    scope: Scope
    numbers: tuple[int, ...]
    prefix: str
    inside: str = ""
    first: int = 0

    def path(self, node: Value | None, key: str) -> str:
        """The path of the register that a key names; empty if the key is absent, or after RS0301 or RS0302."""
        name = node.child(key) if node else None
        return self.found(name, name.text()) if name else ""

    def paths(self, node: Value, *keys: str) -> dict[str, str]:
        """The paths of the registers that several keys name."""
        return {key: self.path(node, key) for key in keys}

    def found(self, node: Value, name: str, *, at_key: bool = False) -> str:
        """The path of the register of this name; RS0301 or RS0302 at `node` and an empty one if there is none."""
        candidates = (f"{prefix}{name}" for prefix in (self.inside, self.prefix, ""))
        elements = {path: [numbered(path, number, self.first) for number in self.numbers] for path in candidates}
        for path, every in elements.items():
            if self.scope.entries.keys() >= set(every):
                return path
        elsewhere = [element for every in elements.values() for element in every if element in self.scope.owners]
        if elsewhere:  # those that this model lacks come first
            self.scope.missing(node, min(elsewhere, key=self.scope.entries.__contains__), at_key=at_key)
        else:
            unknown(node, UNKNOWN_REGISTER, "register", name, self._known(), at_key=at_key)
        return ""

    def _known(self) -> list[str]:
        own = [numbered(prefix, self.numbers[0], self.first) for prefix in (self.inside, self.prefix) if prefix]
        inside = [path.removeprefix(part) for part in own for path in self.scope.owners if path.startswith(part)]
        return inside + [path for path in self.scope.owners if "[" not in path]

    def code(self, node: Value, path: str) -> int:
        """The code of a member or special value of the register at `path`."""
        return int(self._value(node, path))

    def _value(self, node: Value, path: str) -> Fraction:
        entry = self.scope.entries.get(numbered(path, self.numbers[0], self.first))
        return code_of_text(node, Subject(path, entry), self.scope) if entry else ZERO

    def values(self, node: Value | None) -> tuple[tuple[str, Fraction], ...]:
        """Paths and codes of a mapping from registers to their values."""
        found = [(self.found(value, key, at_key=True), value) for key, value in (node.items() if node else ())]
        return tuple(
            (path, value.number() if value.is_number else self._value(value, path)) for path, value in found if path
        )

    def outputs(self, node: Value) -> tuple[tuple[str, str], ...]:
        """Names and paths of outputs, without those that only other models have."""
        found = []
        for key, name in node.items_of("outputs"):
            element = numbered(f"{self.inside}{name.text()}", self.numbers[0], self.first)
            if element not in self.scope.owners or element in self.scope.entries:
                found.append((key, self.found(name, name.text())))
        return tuple(found)
