"""Names for other programs: none is given twice, and the same map gives the same names every time."""


class Names:
    """Gives names away; what is wanted a second time gets a number behind it."""

    def __init__(self, between: str = "_") -> None:
        """`between` stands between a name and its number."""
        self._between = between
        self._given: set[str] = set()

    def give(self, wanted: str) -> str:
        """The wanted name if it is free, else `wanted_2`, `wanted_3`, .."""
        found, number = wanted, 1
        while found in self._given:
            number += 1
            found = f"{wanted}{self._between}{number}"
        self._given.add(found)
        return found
