"""The device that other programs read, served once; a test of a program that is missing says how to get it."""

from collections.abc import Iterator

import pytest

from .install import CONSUMERS
from .stage import Stage, staged


@pytest.fixture(scope="session")
def stage() -> Iterator[Stage]:
    """The device, holding what held.yaml says. It is for reading: who writes serves one of his own by `staged`."""
    with staged() as served:
        yield served


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Skip, with what to do, the tests of a program that is not installed: `make test-interop` installs it before."""
    absent = {one.name for one in CONSUMERS if not one.installed}
    for item in items:
        mark = item.get_closest_marker("interop")
        if mark and set(mark.args) & absent:
            item.add_marker(pytest.mark.skip(reason=f"{mark.args[0]} is not installed: `make test-interop` does that"))
