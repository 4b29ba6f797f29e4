"""A backup of words that have more digits than a float of a program is not brought back as other words."""

from collections.abc import Callable
from typing import Any

import pytest

from regscribe.tools import settings
from regscribe.tools.settings import UnfitError

COUNTER = """\
format: 1
map: {id: test/fine, title: Fine, maker: Nobody, class_prefix: Fine}
manual: {title: None}
models: {One: {}}
groups:
  - id: main
    name: Main
    source: "1"
    each: {access: rw}
    registers:
      - {at: 0, name: Energy, type: uint64, multiply: 0.1}
      - {at: 4, name: Real, type: float64, multiply: 3}
"""
EXACT, TOO_FINE = 0x0001_0000_0000_0001, 0x0100_0000_0000_0001
"""The first has 15 digits, which a float tells apart; the second 17."""


def words_of(number: int) -> dict[int, int]:
    return {place: number >> 16 * (3 - place) & 0xFFFF for place in range(4)}


@pytest.mark.parametrize(("number", "fits"), [(EXACT, True), (TOO_FINE, False)])
def test_words_that_a_float_does_not_tell_apart_are_named_and_not_written(
    talk: Callable[..., Any], *, number: int, fits: bool
) -> None:
    old, new = talk(COUNTER, words_of(number)), talk(COUNTER, {})
    saved = old.driver.run(settings.backup(type(old.driver)))
    if fits:
        new.driver.run(settings.restore(type(new.driver), saved, confirm=True))
        assert {at: new.words.holds[at] for at in range(4)} == words_of(number)
        return
    with pytest.raises(UnfitError, match=r"energy: its words .* have more digits than the number"):
        new.driver.run(settings.restore(type(new.driver), saved, confirm=True))
    assert all(function in {3, 4} for function, *_ in new.sent)
