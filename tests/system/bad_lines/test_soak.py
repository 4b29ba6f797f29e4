"""`make soak MINUTES=..`: the same as in `test_under_fire`, for as long as one likes, with a report."""

import itertools
import os
import time

import pytest
from hypothesis import HealthCheck, Phase, settings
from hypothesis.stateful import run_state_machine_as_test

from regscribe.simulate.line.line_faults import UNDETECTABLE, USUAL

from .judge import TALLY
from .machine import machine
from .world import FRAMINGS, SIDES

MINUTES = float(os.environ.get("SOAK_MINUTES", "0"))
LONG = settings(
    max_examples=3,
    stateful_step_count=60,
    deadline=None,
    database=None,
    phases=[Phase.generate],
    print_blob=True,
    suppress_health_check=list(HealthCheck),
)
PLACES = tuple(itertools.product(SIDES, FRAMINGS))
ALL = [
    one
    for kind, transport in PLACES
    for one in (
        machine(kind, transport, rate=0.1),
        machine(kind, transport, rate=0.35),
        machine(kind, transport, kinds=(*USUAL, *UNDETECTABLE), judging=False),
    )
]


@pytest.mark.skipif(not MINUTES, reason="runs with `make soak MINUTES=..`")
def test_hours_under_fire_end_without_a_wrong_value(capsys: pytest.CaptureFixture[str]) -> None:
    end = time.monotonic() + 60 * MINUTES
    try:
        for one in itertools.cycle(ALL):
            if time.monotonic() > end:
                break
            run_state_machine_as_test(one, settings=LONG)
    finally:
        with capsys.disabled():
            print("", *TALLY.lines(), sep="\n")  # noqa: T201 - the report is what this is for
    assert not TALLY.wrong
