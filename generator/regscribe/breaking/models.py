"""One model in two versions: all that has an id in it, and its registers."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from regscribe.breaking.change import Difference, Effects, Found, Site
from regscribe.breaking.facts import B, N, compared
from regscribe.breaking.map_facts import MODEL_FACTS
from regscribe.breaking.pairs import Pairs
from regscribe.breaking.register_pairs import Two, pairs_of, renamed_paths
from regscribe.breaking.registers import RegisterComparison
from regscribe.breaking.renames import Renames
from regscribe.breaking.rules import MODEL_RENAMED
from regscribe.breaking.things import NOTES_FACTS, found_at, new_ids, thing_differences, thing_pairs
from regscribe.model import Register


@dataclass(frozen=True, slots=True)
class ModelComparison:
    """Compares a model in two versions; `things` are the pairs of what has an id in it, by sort."""

    map_id: str
    two: Two
    registers: Pairs[Register]
    things: dict[str, Pairs[Any]]
    renames: Renames

    @classmethod
    def of(cls, map_id: str, two: Two, names: Renames) -> "ModelComparison":
        """Pair all that the model has."""
        registers = pairs_of(two)
        renames = names.with_paths({**names.paths, **renamed_paths(registers)})
        commands = thing_pairs("command", two.old.commands, two.new.commands, renames)
        renames = replace(renames, commands=new_ids(commands))
        groups = thing_pairs("group", two.old.groups, two.new.groups, renames)
        renames = replace(renames, groups=new_ids(groups))
        things: dict[str, Pairs[Any]] = {
            "group": groups,
            "command": commands,
            "computed value": thing_pairs("computed value", two.old.computed, two.new.computed, renames),
            "program": thing_pairs("program", two.old.programs, two.new.programs, renames),
        }
        return cls(map_id, two, registers, things, renames)

    def found(self) -> Iterator[Found]:
        """All that differs."""
        old, new = self.two
        site = Site(self.map_id, new.name, new.name, new.span, old.span, other=old.name)
        if old.name != new.name:
            yield Found(site, Difference(MODEL_RENAMED, "name of the model", Effects(N, B), old.name, new.name))
        for each in compared(MODEL_FACTS, old, new, self.renames):
            yield Found(site, each, (self.map_id, "models"))
        groups = self.things["group"]
        apart = {one.id: "group" for one in (*groups.removed, *groups.added)}
        yield from RegisterComparison(self.map_id, self.two, self.registers, self.renames, apart).found()
        for sort, pairs in self.things.items():
            yield from (found_at(each, site) for each in thing_differences(sort, pairs, self.renames))
        yield from self._notes(site)

    def _notes(self, site: Site) -> Iterator[Found]:
        """What is noted of the programs that both versions have."""
        before, after = (
            {program.id: notes for program, notes in zip(model.programs, model.program_notes, strict=True)}
            for model in self.two
        )
        for old, new in self.things["program"].both:
            here = site._replace(subject=new.id, span=after[new.id].span, was=before[old.id].span)
            yield from (Found(here, each) for each in compared(NOTES_FACTS, before[old.id], after[new.id]))
