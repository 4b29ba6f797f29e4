"""What the cells of a table of registers say: pure functions, texts in, typed results out.

Each module reads one kind of cell. A function returns what the text says, None for an empty cell, or `Unclear` for a
text that is not understood or that says several things; it never raises and never guesses. What only the whole column
shows (the base of addresses, whether a scale divides) is decided once for it, with the evidence in words and a way to
say otherwise.
"""

from dataclasses import dataclass

MOST_SHOWN = 60
"""Characters of a cell that a message quotes."""


@dataclass(frozen=True, slots=True)
class Unclear:
    """A text that cannot be read for sure.

    `reason` quotes it and says what is wrong; `proposal` is what was perhaps meant, in the words of the map, if
    something was.
    """

    reason: str
    proposal: str = ""

    @property
    def message(self) -> str:
        """The reason, with the proposal."""
        return f"{self.reason}; perhaps {self.proposal} is meant" if self.proposal else self.reason


def quoted(text: str) -> str:
    """A text of a cell for a message: on one line, not too long, between backticks."""
    flat = " ".join(text.split())
    return f"`{flat if len(flat) <= MOST_SHOWN else f'{flat[: MOST_SHOWN - 3]}...'}`"
