"""The rows of the types: what each takes, holds and refuses."""

import json
import math
import pickle
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
    assert of_map == of_export["anyOf"][0]["enum"] == [row.value for row in WireType]


@pytest.mark.parametrize("row", [*(one for one in WireType if one.is_integer), *map(WireType.of_words, (1, 5, 125))])
def test_a_type_reads_the_numbers_that_it_spells(row: WireType) -> None:
    ends = {row.minimum, row.minimum + 1, 0, 1, row.maximum // 3, row.maximum}
    assert all(row.unpack(row.pack(number)) == number for number in ends)


def test_a_row_of_more_words_is_made_once() -> None:
    wide = WireType("uint80")
    assert wide is WireType.of_words(5) is pickle.loads(pickle.dumps(wide))  # noqa: S301 (our own bytes)
    assert (wide.name, wide.words, wide.bits, wide.maximum) == ("UINT80", 5, 80, 2**80 - 1)
    assert WireType.of_words(4) is WireType.UINT64


@pytest.mark.parametrize("name", ["uint81", "uint", "uint7", "uint080", "int80", "uint100000", "uint\u0668\u0660"])
def test_there_is_no_row_of_other_widths(name: str) -> None:
    with pytest.raises(ValueError, match="not a valid"):
        WireType(name)


def test_a_float16_reads_as_the_shortest_decimal_of_each_of_its_patterns() -> None:
    finite = range(0, 0x7C00, 7)
    found = [Fraction(shortest(WireType.FLOAT16.unpack([bits]), WireType.FLOAT16)) for bits in finite]
    assert found == [slowly(ieee_number(bits, WireType.FLOAT16), WireType.FLOAT16) for bits in finite]
    assert shortest(2.0**-6, WireType.FLOAT16) == shortest(0.01563, WireType.FLOAT64)


def test_a_float16_is_rounded_once() -> None:
    between = Fraction(1) + Fraction(1, 2048) + Fraction(1, 2**80)  # as a float64 it is the even one of two neighbours
    assert WireType.FLOAT16.nearest(between) == 1 + 1 / 1024
    assert math.isclose(WireType.FLOAT16.nearest(Fraction(1, 10)), 0.0999755859375)
