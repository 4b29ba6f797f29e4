"""Simulated devices for tests: a pytest plugin that every project with regscribe installed has.

    def test_the_oven_heats(simulated):
        oven = simulated("athena/series-c", "16C")
        with Athena16C.tcp(oven.host, port=oven.port, unit=1) as controller:
            ...

Nothing of regscribe is imported before a test asks for a device.
"""

from collections.abc import Iterator
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any, Protocol

import pytest

if TYPE_CHECKING:
    from pathlib import Path

    from regscribe.model import RegisterMap
    from regscribe.simulate import Running


class Simulated(Protocol):
    """The type of the fixture `simulated`: called with a map and a model, it serves a device until the test ends.

    The map is an id (`athena/series-c`), a file or a `RegisterMap`; the keywords are those of `regscribe.simulate`.
    """

    def __call__(self, register_map: "RegisterMap | str | Path", model: str, **options: Any) -> "Running":  # noqa: ANN401 - those of `simulate`
        """Serve a device and return it."""
        raise NotImplementedError


@pytest.fixture
def simulated() -> Iterator[Simulated]:
    """Serve simulated devices until the test ends: `simulated("athena/series-c", "16C")`."""
    with ExitStack() as stack:

        def serve(register_map: "RegisterMap | str | Path", model: str, **options: Any) -> "Running":  # noqa: ANN401 - those of `simulate`
            from regscribe.simulate import simulate  # noqa: PLC0415 - who does not use it does not wait for it

            return stack.enter_context(simulate(register_map, model, **options))

        yield serve
