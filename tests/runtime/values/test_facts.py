"""What a register sets of the line, and what the steps of a command write."""

import pytest

from regscribe_runtime.values.facts import CommandStep, Governs, Setting
from regscribe_runtime.values.wire_types import Space


def test_a_code_that_the_manual_does_not_print_sets_nothing() -> None:
    speed = Governs(Setting.BAUD, codes=((0, "1200"), (1, "9600")))
    assert [speed.value(code) for code in (0, 1.0, 2)] == ["1200", "9600", None]


@pytest.mark.parametrize(
    ("function", "space"), [(5, Space.COIL), (15, Space.COIL), (6, Space.HOLDING), (16, Space.HOLDING)]
)
def test_a_step_writes_the_space_of_its_function(function: int, space: Space) -> None:
    assert CommandStep(function, 7, (1,)).space is space
