"""Constants that several declarations share: each is emitted once, before its first use, under a readable name."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from regscribe.emit.python.formatting import INDENT, WIDTH, Expression, flat, lay, width
from regscribe.model import Model, Register

PROTOCOL = "_PROTOCOL"
"""The name of the constant of the protocol."""
SHORT = 30
"""An expression of at most this many characters stays where it is used."""


@dataclass(slots=True)
class Pool:
    """Named constants by their text; `lines` are their definitions in the order of first use.

    `hidden` are the functions of the runtime that go by another name in this module, `taken` all private names in it.
    """

    hidden: frozenset[str] = frozenset()
    names: dict[str, str] = field(default_factory=dict)
    lines: list[str] = field(default_factory=list)
    taken: set[str] = field(default_factory=lambda: {PROTOCOL})

    def helper(self, name: str) -> str:
        """The name under which this module calls a function of the runtime."""
        return f"_{name}" if name in self.hidden else name

    def share(self, expression: Expression, *names: str, comment: str = "", type_name: str = "") -> str:
        """The name of a constant of this content, defined now if it is new, under the first of `names` that is free."""
        text = flat(expression)
        if text not in self.names:
            self.names[text] = self._free(names)
            self.taken.add(self.names[text])
            self.lines += [f"# {comment}"] if comment and len(comment) + 2 <= WIDTH else []
            head = f"{self.names[text]}: {type_name} = " if type_name else f"{self.names[text]} = "
            self.lines += _definition(head, expression)
        return self.names[text]

    def maybe(self, expression: Expression, *names: str) -> Expression:
        """The expression itself if it is short, else its constant."""
        return expression if len(flat(expression)) <= SHORT else self.share(expression, *names)

    def _free(self, names: Sequence[str]) -> str:
        wanted = ["_" + re.sub(r"\W+", "_", name, flags=re.ASCII).strip("_").upper() for name in names]
        numbered = (f"{wanted[-1]}_{count}" for count in range(2, len(self.taken) + 3))
        return next(free for free in (*wanted, *numbered) if free not in self.taken)


def _definition(head: str, expression: Expression) -> list[str]:
    """The lines of an assignment; a text that does not fit after `head` stands in brackets."""
    lines = lay(expression, head=head)
    too_long = len(lines) == 1 and width(lines[0]) > WIDTH
    if too_long and len(INDENT) + width(flat(expression)) <= WIDTH:
        return [f"{head}(", f"{INDENT}{flat(expression)}", ")"]
    return lines


def names_of(register: Register, use: str, model: Model) -> tuple[str, ...]:
    """Names for a constant that a register of a model uses as `use`, the shortest first.

    They begin with the name of the map's rule that states it, else with that of the register.
    """
    rule = dict(register.rules).get(use, "") or (register.unit_id if use == "unit" else "")
    if rule:
        return rule, f"{rule}_{use}", f"{rule}_{use}_{model.name}"
    path = re.sub(r"\[.*?\]", "", register.path)
    return f"{register.id}_{use}", f"{path}_{use}", f"{path}_{use}_{model.name}"
