"""Orders of words and of bytes: fixed, or by cases that registers and givens decide."""

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from regscribe_runtime.values.conditions import Case, Cases, Condition, Is, registers_of
from regscribe_runtime.values.numbers import Number
from regscribe_runtime.values.wire_types import Order

WordOrder = Order | tuple[int, ...]
"""Which word comes first, or the place on the wire (from 1) of each word, the most significant word's place first."""

Words = Sequence[int]


class OrderCases(NamedTuple):
    """The first case whose condition holds sets the order; none: nobody can tell what the words mean."""

    cases: Cases[WordOrder]

    @property
    def every(self) -> tuple[WordOrder, ...]:
        """Each order that there may be, once."""
        return tuple(dict.fromkeys(case.then for case in self.cases))

    def by_code(self) -> tuple[str, tuple[tuple[Number, WordOrder], ...]] | None:
        """The register that alone sets it, with the order of each of its codes; None where it is not as simple."""
        found: list[tuple[Number, WordOrder]] = []
        register = next(iter(registers_of(self.cases)), "")
        for when, order in self.cases:
            test = when.tests[0] if len(when.tests) == 1 else None
            code = test.codes[0][0] if isinstance(test, Is) and test.codes else None
            if code is None or test != Is(register, ((code, code),)):
                return None
            found.append((code, order))
        return register, tuple(found)


def order_from(register: str, codes: Iterable[tuple[int, WordOrder]]) -> OrderCases:
    """The order that the codes of one register set."""
    return OrderCases(tuple(Case(Condition((Is(register, ((code, code),)),)), order) for code, order in codes))


def orders_of(order: WordOrder | OrderCases) -> tuple[WordOrder, ...]:
    """Each order that there may be."""
    return order.every if isinstance(order, OrderCases) else (order,)


def gathered(order: WordOrder, words: Words) -> Words:
    """The words on the wire, the most significant first."""
    if isinstance(order, Order):
        return words if order is Order.BIG else words[::-1]
    return [words[place - 1] for place in order]


def spread(order: WordOrder, words: Words) -> Words:
    """Words, the most significant first, as they follow each other on the wire."""
    if isinstance(order, Order):
        return words if order is Order.BIG else words[::-1]
    return [word for _, word in sorted(zip(order, words, strict=True))]
