"""Whatever the line does and whatever a program asks for: no wrong value, no write twice, nothing left behind."""

import pytest
from hypothesis import HealthCheck, Phase, settings
from hypothesis.stateful import run_state_machine_as_test

from regscribe.simulate.line.line_faults import UNDETECTABLE, USUAL

from .machine import machine

FEW = settings(
    max_examples=3,
    stateful_step_count=15,
    deadline=None,
    derandomize=True,
    database=None,
    phases=[Phase.generate],
    suppress_health_check=list(HealthCheck),
)


@pytest.mark.parametrize("kind", ["sync", "async"])
@pytest.mark.parametrize("transport", ["tcp", "rtu-tcp", "ascii-tcp", "pty"])
def test_a_driver_on_a_bad_line_never_says_what_is_not_true(kind: str, transport: str) -> None:
    run_state_machine_as_test(machine(kind, transport), settings=FEW)


@pytest.mark.parametrize("kind", ["sync", "async"])
def test_falsified_values_do_no_harm_but_the_one_that_nobody_can_detect(kind: str) -> None:
    faults = (*USUAL, *UNDETECTABLE)
    run_state_machine_as_test(machine(kind, "tcp", kinds=faults, judging=False, rate=0.3), settings=FEW)
