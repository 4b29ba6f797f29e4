"""Drivers that lose patience sooner than usual, so that a bad line does not take the tests' time."""

import pytest

from .world import LATE_SECONDS


@pytest.fixture(autouse=True)
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("regscribe_runtime.link.pending.LATE_SECONDS", LATE_SECONDS)
    monkeypatch.setattr("regscribe_runtime.operations.read_back.LOOKS", (0.0, 0.02))
