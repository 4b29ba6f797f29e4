"""What `regscribe` imports before it is told what to do, and how long a help text makes anyone wait."""

from collections.abc import Callable
from typing import Any

import pytest

from regscribe.cli.app import COMMANDS

HEAVY = ("yaml", "jinja2", "jsonschema", "pymodbus", "serial", "rich", "asyncio")


@pytest.mark.parametrize("argument", ["--version", "--help"])
def test_nothing_heavy_is_imported_to_say_what_there_is(process: Callable[..., Any], argument: str) -> None:
    script = (
        "import sys\nfrom regscribe.cli.app import run\n"
        f"code = run([{argument!r}])\n"
        f"print('loaded:', [name for name in {HEAVY!r} if name in sys.modules], code)"
    )
    assert process(script, python=True).out.endswith("loaded: [] 0\n")


def test_a_build_without_change_imports_no_compiler(process: Callable[..., Any], oven: object) -> None:
    assert process("generate").code == 0, oven
    heavy = ("yaml", "jinja2", "jsonschema", "pymodbus", "regscribe.pipeline")
    script = (
        "import sys\nfrom regscribe.cli.app import run\nrun(['generate'])\n"
        f"print('loaded:', [name for name in {heavy!r} if name in sys.modules])"
    )
    assert process(script, python=True).out.endswith("loaded: []\n")


def test_the_version_is_printed(cli: Callable[..., Any]) -> None:
    result = cli("--version")
    assert result.code == 0
    assert result.out.startswith("regscribe 0.")


@pytest.mark.parametrize("command", COMMANDS)
def test_every_help_shows_an_example(cli: Callable[..., Any], command: str) -> None:
    result = cli(command, "--help")
    assert result.code == 0
    assert f"Example: regscribe {command}" in result.out


def test_the_help_lists_every_command(cli: Callable[..., Any]) -> None:
    out = cli("--help").out
    assert all(f"\n  {command} " in out for command in COMMANDS)


def test_without_a_command_the_help_is_shown_as_usage(cli: Callable[..., Any]) -> None:
    result = cli()
    assert (result.code, "Commands:" in result.err) == (2, True)
