"""Names for other programs: none is given twice, and the same map gives the same names every time."""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator


class Names:
    """Gives names away; what is wanted a second time gets a number behind it."""

    def __init__(self, between: str = "_", key: Callable[[str], str] = str) -> None:
        """`between` stands between a name and its number; names of one `key` are the same to the program."""
        self._between, self._key = between, key
        self._given: set[str] = set()

    def give(self, wanted: str) -> str:
        """The wanted name if it is free, else `wanted_2`, `wanted_3`, .."""
        found, number = wanted, 1
        while self._key(found) in self._given:
            number += 1
            found = f"{wanted}{self._between}{number}"
        self._given.add(self._key(found))
        return found


def distinct(wanted: Iterable[tuple[str, str]], key: Callable[[str], str] = str) -> Iterator[str]:
    """Names for people, each wanted with the path that tells it from others: where two are the same, it is added."""
    every = list(wanted)
    often = Counter(key(name) for name, _ in every)
    names = Names(" ", key)
    yield from (names.give(name if often[key(name)] == 1 else f"{name} ({path})") for name, path in every)
