"""What docs/bus.md shows is what comes out, and its links and settings exist."""

import doctest
import re
from pathlib import Path

from regscribe.simulate import SimulatedDevice
from regscribe_runtime import LinkSettings
from regscribe_runtime.link.links import LineSettings

from .conftest import serving

PAGE = (Path(__file__).parents[3] / "docs" / "bus.md").read_text(encoding="utf-8")


def test_the_sessions_of_the_page_run_as_they_are_shown(units: list[SimulatedDevice]) -> None:
    session = "\n".join(re.findall(r"^```pycon\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE))
    with serving(units) as server:
        test = doctest.DocTestParser().get_doctest(session.replace("5020", str(server.port)), {}, "bus", "bus.md", 0)
        assert test.examples
        assert doctest.DocTestRunner(verbose=False).run(test).failed == 0


def test_every_setting_is_on_the_page() -> None:
    rows = "\n".join(line for line in PAGE.splitlines() if line.startswith("| `"))
    settings = {*LinkSettings.__annotations__, *LineSettings.__annotations__}
    assert {name for name in settings if f"`{name}`" not in rows} == set()
