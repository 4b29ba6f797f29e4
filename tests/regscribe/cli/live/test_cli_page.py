"""docs/cli.md and other pages are true: what their commands print is what stands there."""

import importlib.util
import re
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from regscribe.cli.app import COMMANDS

HERE = Path(__file__).parent
PAGE = (HERE.parents[3] / "docs" / "cli.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def sessions() -> ModuleType:
    """The script that writes the page, which is no package."""
    spec = importlib.util.spec_from_file_location("cli_sessions", HERE / "sessions.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("name", ["README.md", "cli.md", "settings.md", "programs.md"])
def test_the_sessions_of_the_page_print_what_stands_there(
    sessions: Any, compiled: Any, folder: Path, name: str
) -> None:
    (path,) = [one for one in sessions.PAGES if one.name == name]
    page = path.read_text(encoding="utf-8")
    assert Path.cwd() == folder
    with sessions.player(compiled) as found:
        assert found.played(page) == page


def test_a_session_that_prints_something_else_is_noticed(sessions: Any, compiled: Any, folder: Path) -> None:
    changed = PAGE.replace("J_THERMOCOUPLE", "K_THERMOCOUPLE", 1)
    assert Path.cwd() == folder
    with sessions.player(compiled) as found:
        assert found.played(changed) == PAGE != changed


def test_every_live_command_is_on_the_page() -> None:
    live = {"devices", "scan", "identify", "read", "write", "dump", "watch", "command", "decode"}
    assert live <= set(COMMANDS)
    assert live <= set(re.findall(r"^\$ regscribe (\w+)", PAGE, re.MULTILINE))


def test_the_links_of_the_page_lead_somewhere() -> None:
    links = re.findall(r"\]\(([^)#:]+)\)", PAGE)
    assert links
    assert [link for link in links if not (HERE.parents[3] / "docs" / link).exists()] == []
