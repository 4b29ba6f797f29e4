"""The pytest plugin: a device for a test, and nothing for who does not ask for one."""

import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

pytest_plugins = ["pytester"]
PLUGIN = "regscribe.pytest_plugin"
USES = """
    from pymodbus.client import ModbusTcpClient

    def test_two_devices_are_served_at_once(simulated):
        one = simulated("fdc/series-100", "C21", givens={"linear_inputs": {16}})
        two = simulated("fdc/series-100", "C91", givens={"linear_inputs": {16}}, unit=7)
        two.poke("lock", 3)
        for running, unit, lock in ((one, 1, 0), (two, 7, 3)):
            client = ModbusTcpClient(running.host, port=running.port)
            assert client.connect()
            assert client.read_holding_registers(3, device_id=unit).registers == [lock]
            client.close()
        assert one.requests and two.requests
        open("ports.txt", "w").write(f"{one.port}")
"""


@pytest.fixture
def isolated(pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch) -> pytest.Pytester:
    """No other plugin of this environment takes part."""
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
    return pytester


def test_the_fixture_serves_devices_until_the_test_ends(isolated: pytest.Pytester) -> None:
    isolated.makepyfile(USES)
    isolated.runpytest_subprocess("-p", PLUGIN).assert_outcomes(passed=1)


def test_a_mistake_is_told_in_one_line(isolated: pytest.Pytester) -> None:
    isolated.makepyfile("def test_it(simulated): simulated('fdc/series-10', 'C21')")
    result = isolated.runpytest_subprocess("-p", PLUGIN, "--tb=line")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*there is no map 'fdc/series-10'*did you mean 'fdc/series-100'?*"])


def test_who_does_not_use_it_imports_nothing_of_the_simulator() -> None:
    heavy = ("regscribe.simulate", "regscribe.model", "pymodbus", "yaml", "serial")
    script = f"import sys, {PLUGIN}\nprint([name for name in {heavy} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=True)  # noqa: S603 - our own
    assert done.stdout.strip() == "[]"


def test_the_package_announces_the_plugin() -> None:
    project = tomllib.loads((Path(__file__).parents[3] / "pyproject.toml").read_text("utf-8"))["project"]
    assert project["entry-points"]["pytest11"] == {"regscribe": PLUGIN}
