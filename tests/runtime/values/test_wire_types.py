"""The rows of the types: what each takes, holds and refuses."""

import json
import math
from fractions import Fraction
from pathlib import Path

import pytest

from regscribe.reference.ieee import ieee_number
from regscribe.reference.ieee import shortest as slowly
from regscribe_runtime.values.numbers import shortest
from regscribe_runtime.values.wire_types import WireType

SCHEMAS = Path(__file__).parents[3] / "schema"


def test_the_schemas_list_the_rows_of_the_table() -> None:
    of_map = json.loads((SCHEMAS / "map.schema.json").read_text("utf-8"))["$defs"]["wire_type"]["enum"]
    of_export = json.loads((SCHEMAS / "export.schema.json").read_text("utf-8"))["$defs"]["view"]["properties"]["type"]
    assert of_map == of_export["enum"] == [row.value for row in WireType]


@pytest.mark.parametrize("row", [one for one in WireType if one.is_integer])
def test_a_type_reads_the_numbers_that_it_spells(row: WireType) -> None:
    ends = {row.minimum, row.minimum + 1, 0, 1, row.maximum // 3, row.maximum}
    assert all(row.unpack(row.pack(number)) == number for number in ends)


def test_a_float16_reads_as_the_shortest_decimal_of_each_of_its_patterns() -> None:
    finite = range(0, 0x7C00, 7)
    found = [Fraction(shortest(WireType.FLOAT16.unpack([bits]), WireType.FLOAT16)) for bits in finite]
    assert found == [slowly(ieee_number(bits, WireType.FLOAT16), WireType.FLOAT16) for bits in finite]
    assert shortest(2.0**-6, WireType.FLOAT16) == shortest(0.01563, WireType.FLOAT64)


def test_a_float16_is_rounded_once() -> None:
    between = Fraction(1) + Fraction(1, 2048) + Fraction(1, 2**80)  # as a float64 it is the even one of two neighbours
    assert WireType.FLOAT16.nearest(between) == 1 + 1 / 1024
    assert math.isclose(WireType.FLOAT16.nearest(Fraction(1, 10)), 0.0999755859375)
