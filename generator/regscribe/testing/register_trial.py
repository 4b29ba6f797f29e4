"""One register in one situation, and the driver's codec under it."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from regscribe.testing.vectors import Json, number


class Trial(NamedTuple):
    """One register in one view and situation: `case` has its vectors, `entry` what the register is."""

    register: Any  # a Register; named so, pyright would let the field take what its __set__ takes, which is nothing
    entry: Json
    case: Json
    state: Mapping[str, Any]
    givens: Mapping[str, Any]

    @property
    def view(self) -> str:
        """The name of the view."""
        return str(self.case["view"])

    def decode(self, words: Sequence[int]) -> Any:  # noqa: ANN401 (whatever the register holds)
        """Decode with the driver under the state of this trial."""
        return self.register.decode(words, view=self.view, state=self.state, givens=self.givens)

    def encode(self, value: object, *, rounded: bool = False) -> tuple[int, ...]:
        """Encode with the driver under the state of this trial."""
        words: tuple[int, ...] = self.register.encode(
            value, view=self.view, state=self.state, givens=self.givens, rounded=rounded
        )
        return words

    def __repr__(self) -> str:
        given = {name: codes for name, codes in self.givens.items() if name in self.case.get("givens", {})}
        return f"{self.register.path} ({self.view}) with {dict(self.state) | given}"


def known(case: Json) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the state and the givens of a case as a driver takes them."""
    givens = case.get("givens", {})
    stated = {**case.get("assumed", {}), **case.get("state", {})}
    return (
        {path: number(text) for path, text in stated.items()},
        {
            name: codes if isinstance(codes, bool) else {number(text) for text in codes}
            for name, codes in givens.items()
        },
    )
