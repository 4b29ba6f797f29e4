"""What docs/simulate.md shows works."""

import doctest
import re
from pathlib import Path
from typing import Any

import pytest

pytest_plugins = ["pytester"]
PAGE = Path(__file__).parents[3] / "docs" / "simulate.md"
TEXT = PAGE.read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", TEXT, re.DOTALL)


def test_the_session_of_the_page_runs() -> None:
    (session,) = blocks("pycon")
    found = doctest.DocTestParser().get_doctest(session, {}, "simulate.md", str(PAGE), 0)
    runner = doctest.DocTestRunner(verbose=False)
    told: list[str] = []
    runner.run(found, out=told.append)
    assert (runner.failures, found.examples != []) == (0, True), "".join(told)


def test_the_test_of_the_page_runs(pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
    test, _ = blocks("python")
    pytester.makepyfile(test.replace("...  # what the program does", "controller.setpoint_ram.read()"))
    pytester.runpytest_subprocess("-p", "regscribe.pytest_plugin").assert_outcomes(passed=1)


def test_the_bad_line_of_the_page_loses_an_answer_and_no_value() -> None:
    _, shown = blocks("python")
    names: dict[str, Any] = {}
    exec(shown, names)  # noqa: S102 - our own page
    assert list(names["faults"].injected.values()) == [1]
    assert names["device"].device.peek("setpoint_ram") == 151


def test_the_options_of_the_page_exist() -> None:
    from click.testing import CliRunner  # noqa: PLC0415 - here only

    from regscribe.cli.commands.simulate import command  # noqa: PLC0415 - as above

    usage = CliRunner().invoke(command, ["--help"]).output
    named = set(re.findall(r"(?<!`)(--[a-z]+)", TEXT))
    assert named <= set(re.findall(r"--[a-z]+", usage))
    assert named
