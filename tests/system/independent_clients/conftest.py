"""Lets the tests import the clients beside them, counts what was agreed, and prints the table at the end."""

import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

sys.path.insert(0, str(Path(__file__).parent))  # the helpers are no part of what is tested, so no package of it

from independent.table import PROPERTY, Agreed, table

AGREEMENTS: list[Agreed] = []


@pytest.fixture
def agree(record_property: Callable[[str, object], None]) -> Callable[..., None]:
    """Count an agreement: `agree(client, family, what, count=1)`."""

    def record(client: str, family: str, what: str, count: int = 1) -> None:
        record_property(PROPERTY, (client, family, what, count))

    return record


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """Collect the counts, also from other processes."""
    if report.when == "call" and report.passed:
        AGREEMENTS.extend(Agreed(*value) for name, value in report.user_properties if name == PROPERTY)  # type: ignore[misc]  # lists after a transfer


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """Print the table."""
    if AGREEMENTS:
        terminalreporter.section("agreed on the wire")
        for line in table(AGREEMENTS):
            terminalreporter.write_line(line)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Skip, with what to do, where a client is missing: `make test-wire` installs them before it comes here."""
    absent = [program for program in ("mbpoll", "socat", "tshark", "node") if not shutil.which(program)]
    skip = pytest.mark.skip(reason=f"{', '.join(absent)} not installed: `make test-wire` does that")
    for item in items if absent else ():
        if item.get_closest_marker("wire"):
            item.add_marker(skip)
