from enum import StrEnum
from fractions import Fraction
from typing import NamedTuple

import pytest

from regscribe.emit.python.expressions import expression
from regscribe.emit.python.formatting import Expression, flat


class Order(StrEnum):
    BIG = "big"
    LITTLE = "little"


class Inner(NamedTuple):
    text: str
    order: Order = Order.BIG


class Outer(NamedTuple):
    number: int | Fraction
    inner: Inner
    many: tuple[Inner, ...] = ()
    flag: bool = False
    limit: int | None = None


VALUES = {
    "None": None,
    "True": True,
    "-7": -7,
    "5": Fraction(5),
    'Fraction("0.1")': Fraction(1, 10),
    'Fraction("-1/3")': Fraction(-1, 3),
    "Order.LITTLE": Order.LITTLE,
    "'he said \"8N1\"'": 'he said "8N1"',
    '"line\\nend"': "line\nend",
    "()": (),
    "(1,)": (1,),
    '((1, "a"), (2, "b"))': ((1, "a"), (2, "b")),
    'Inner("a")': Inner("a", Order.BIG),
    'Outer(Fraction("2.5"), Inner("a", order=Order.LITTLE), many=(Inner("b"),), limit=0)': Outer(
        Fraction(5, 2), Inner("a", Order.LITTLE), many=(Inner("b"),), limit=0
    ),
}


@pytest.mark.parametrize("text", VALUES)
def test_a_value_is_written_as_short_as_it_can_be_and_read_back_the_same(text: str) -> None:
    value = VALUES[text]
    names = {"Fraction": Fraction, "Order": Order, "Inner": Inner, "Outer": Outer}
    assert flat(expression(value)) == text
    assert eval(text, names) == value  # noqa: S307 (what was written a line above)


def test_what_a_module_calls_by_a_name_goes_by_it_wherever_it_stands() -> None:
    def known(value: object) -> Expression | None:
        return "_SHARED" if value == Inner("a") else None

    assert flat(expression(Outer(1, Inner("a"), (Inner("a"), Inner("b"))), known)) == (
        'Outer(1, _SHARED, many=(_SHARED, Inner("b")))'
    )


@pytest.mark.parametrize("value", [2.5, b"raw", [1], {1: 2}, (1, 2.5)])
def test_what_has_no_exact_or_frozen_form_is_refused(value: object) -> None:
    with pytest.raises(TypeError, match="a declaration cannot hold"):
        expression(value)
