"""Hypothesis for all tests, and an end to those that hang.

No test asserts how long something took: machines are busy, and `make bench` measures speed.
Hypothesis has no deadline, and gives the same examples every time where CI is set.
"""

import gc
import os
import signal
from collections.abc import Iterator

import pytest
from hypothesis import settings

settings.register_profile("here", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True)
settings.load_profile("ci" if os.environ.get("CI") else "here")

signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell lets what it starts in the background ignore Ctrl-C

gc.disable()  # until all is collected: nothing of that ever goes


@pytest.hookimpl(trylast=True)
def pytest_collection_finish() -> None:
    """Let garbage be looked for among what tests make only, not among 20,000 tests each time."""
    gc.freeze()
    gc.enable()


HANG_SECONDS = 120.0
"""Of CPU time, far above what any test that is not slow takes: what is over it is no longer linear, or never ends."""


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Iterator[None]:
    """Let a test fail that computes without end; one that waits has deadlines of its own."""
    if item.get_closest_marker("slow") is not None or not hasattr(signal, "setitimer"):
        return (yield)

    def stop(*_: object) -> None:
        pytest.fail(f"still computing after {HANG_SECONDS:.0f} s of CPU time")

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, HANG_SECONDS)
    try:
        return (yield)
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)
