"""Drivers that lose patience sooner than usual, so that a bad line does not take the tests' time."""

import pytest

from .world import LATE_SECONDS


@pytest.fixture(autouse=True)
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("regscribe.runtime.late.LATE_SECONDS", LATE_SECONDS)
    monkeypatch.setattr("regscribe.runtime.lookback.LOOKS", (0.0, 0.02))
