"""What was renamed between two versions: the old one is said in the words of the new one."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

INDEX = re.compile(r"\[[^\]]*\]")


@dataclass(frozen=True, slots=True)
class Renames:
    """What is called otherwise now, by its old name: paths of registers, ids of commands, groups, blocks and givens.

    `conditions` are names of conditions that are a change of their own; they count as equal wherever they stand.
    `patterns` are paths without their indices.
    """

    paths: Mapping[str, str] = field(default_factory=dict)
    commands: Mapping[str, str] = field(default_factory=dict)
    groups: Mapping[str, str] = field(default_factory=dict)
    blocks: Mapping[str, str] = field(default_factory=dict)
    givens: Mapping[str, str] = field(default_factory=dict)
    conditions: frozenset[str] = frozenset()
    patterns: Mapping[str, str] = field(default_factory=dict)

    def with_paths(self, paths: Mapping[str, str]) -> "Renames":
        """The same with paths."""
        alike = [(old, new) for old, new in paths.items() if INDEX.findall(old) == INDEX.findall(new) != []]
        patterns = {INDEX.sub("[]", old): INDEX.sub("[]", new) for old, new in alike}
        return replace(self, paths=paths, patterns=patterns)

    @property
    def now(self) -> "Renames":
        """For the new version, which has all its names already."""
        return Renames(conditions=self.conditions)

    def path(self, path: str) -> str:
        """A path, perhaps with a bit field behind it or open indices in it, as it is now."""
        if not self.paths or not path:
            return path
        if path in self.paths:
            return self.paths[path]
        pattern = INDEX.sub("[]", path)
        if pattern in self.patterns:
            indices = iter(INDEX.findall(path))
            return INDEX.sub(lambda _: next(indices, "[]"), self.patterns[pattern])
        owner, dot, part = path.rpartition(".")
        return f"{self.path(owner)}.{part}" if dot and self.path(owner) != owner else path


SAME_NAMES = Renames()
