"""Constants that several declarations share: each is emitted once, before its first use, under a readable name."""

import re
from dataclasses import dataclass, field

from regscribe.emit.python.formatting import WIDTH, Expression, flat, lay

SHORT = 30
"""An expression of at most this many characters stays where it is used."""


@dataclass(slots=True)
class Pool:
    """Named constants by their text; `lines` are their definitions in the order of first use.

    `hidden` are the functions of the runtime that go by another name in this module.
    """

    hidden: frozenset[str] = frozenset()
    names: dict[str, str] = field(default_factory=dict)
    lines: list[str] = field(default_factory=list)

    def helper(self, name: str) -> str:
        """The name under which this module calls a function of the runtime."""
        return f"_{name}" if name in self.hidden else name

    def share(self, name: str, expression: Expression, comment: str = "") -> str:
        """The name of a constant of this content, defined now if it is new."""
        text = flat(expression)
        if text not in self.names:
            self.names[text] = self._free(name)
            self.lines += [f"# {comment}"] if comment and len(comment) + 2 <= WIDTH else []
            self.lines += lay(expression, head=f"{self.names[text]} = ")
        return self.names[text]

    def maybe(self, name: str, expression: Expression, comment: str = "") -> Expression:
        """The expression itself if it is short, else its constant."""
        return expression if len(flat(expression)) <= SHORT else self.share(name, expression, comment)

    def _free(self, name: str) -> str:
        name = "_" + re.sub(r"\W+", "_", name, flags=re.ASCII).strip("_").upper()
        taken = set(self.names.values())
        numbered = (f"{name}_{count}" for count in range(2, len(taken) + 3))
        return name if name not in taken else next(free for free in numbered if free not in taken)
