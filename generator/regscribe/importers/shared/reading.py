"""Takes the keys of one point of a configuration; what nobody takes is told by name, none is dropped silently."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NoReturn, TypeVar

from regscribe.draft import Remark
from regscribe.importers.shared import exact
from regscribe.importers.shared.tree import FALSE, TRUE, Node

T = TypeVar("T")
MOST_LISTED = 12
"""Words that a message lists."""


class LeftOutError(Exception):
    """A point cannot be taken: a fact on which its number hangs is missing or not understood."""

    def __init__(self, code: str, message: str) -> None:
        super().__init__(message)
        self.remark = Remark(code, message)


def refuse(key: str, message: str) -> NoReturn:
    """Leave a point out, as a key on which its number hangs is not understood. Raises LeftOutError."""
    code = f"{code_of(key)}-unclear"
    raise LeftOutError(code, message)


@dataclass(slots=True)
class Keys:
    """The keys of a mapping, some of which are taken; `remarks` collects what is to be said of the point.

    `outer` has what counts where the mapping itself does not say it.
    """

    node: Node
    remarks: list[Remark] = field(default_factory=list)
    taken: set[str] = field(default_factory=set)
    outer: Mapping[str, Node] = field(default_factory=dict)

    def take(self, key: str) -> Node | None:
        """Return the value of a key, if it has one, and note that it was asked for."""
        self.taken.add(key)
        return self.node.get(key) or self.outer.get(key)

    def has(self, key: str) -> bool:
        """Whether a key says something; it is not taken by that."""
        return self.node.get(key) is not None

    def text(self, key: str, usual: str = "") -> str:
        """Return the text of a key."""
        found = self.take(key)
        if found is None:
            return usual
        return found.text.strip() if found.is_scalar and not found.tag else usual

    def number(self, key: str) -> Fraction | None:
        """Return the exact number of a key. Raises LeftOutError where it is none."""
        found = self.take(key)
        if found is None:
            return None
        value = exact.number(found.text) if found.is_scalar and not found.tag else None
        if value is None:
            refuse(key, f"{key} {found.shown} is no number")
        return value

    def scale(self, key: str, usual: int = 1) -> Fraction | None:
        """Return the number of a key that scales; None, with a remark to a person, where it is unclear."""
        found = self.take(key)
        if found is None:
            return Fraction(usual)
        value = exact.number(found.text) if found.is_scalar and not found.tag else None
        if value is None:
            self.remarks.append(unclear_scale(f"{key} {found.shown} is no number"))
        return value

    def whole(self, key: str) -> int | None:
        """Return the whole number of a key. Raises LeftOutError where it is none."""
        value = self.number(key)
        if value is not None and value.denominator != 1:
            refuse(key, f"{key} `{value}` is no whole number")
        return None if value is None else value.numerator

    def truth(self, key: str, *, usual: bool = False) -> bool:
        """Return whether a key says yes. Raises LeftOutError where it says neither."""
        found = self.take(key)
        if found is None:
            return usual
        word = found.text.strip().lower()
        if word in TRUE | FALSE and found.is_scalar and not found.tag:
            return word in TRUE
        refuse(key, f"{key} {found.shown} is neither true nor false")

    def choice(self, key: str, table: Mapping[str, T], usual: str = "") -> T:
        """Return what a word of a key means. Raises LeftOutError for a word that the table does not have."""
        found = self.take(key)
        word = usual if found is None else found.text.strip()
        if (found is None or (found.is_scalar and not found.tag)) and word in table:
            return table[word]
        shown = "is not given" if found is None else f"{found.shown} is none"
        known = ", ".join([*filter(None, table)][:MOST_LISTED])
        refuse(key, f"{key} {shown} of {known}")

    def drop(self, key: str, why: str, *, code: str = "", todo: bool = False) -> None:
        """Tell that a key, if it is there, is not in the map, and why."""
        found = self.take(key)
        if found is not None:
            self.remarks.append(Remark(code or f"{code_of(key)}-dropped", f"{key} {found.shown}: {why}", todo=todo))

    def rest(self, shown: frozenset[str]) -> Iterator[Remark]:
        """Yield a remark for each key that nobody took; those `shown` only matter to a display."""
        for key, value in (self.node.members or {}).items():
            if key not in self.taken and key not in shown and not value.is_null:
                yield Remark(f"{code_of(key)}-dropped", f"{key} {value.shown} is not taken over")


def code_of(key: str) -> str:
    """A key as a stable code in lower case: `skip_updates` is `skip-updates`, `dataType` is `data-type`."""
    spread = "".join(f"-{letter.lower()}" if letter.isupper() else letter for letter in key)
    return "-".join(filter(None, "".join(one if one.isalnum() else "-" for one in spread).split("-")))


def unclear_scale(why: str) -> Remark:
    """The remark of a register that is raw, as its scale is unclear."""
    return Remark("scale-unclear", f"{why}; the number is raw here", todo=True)
