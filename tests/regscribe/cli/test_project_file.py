"""`generate --project`: a file with which pip installs the drivers."""

import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

FILE = Path("generated/pyproject.toml")


@pytest.mark.usefixtures("oven")
def test_a_project_file_is_written_once_and_then_left_to_the_user(cli: Callable[..., Any]) -> None:
    said = cli("generate", "--project", "Acme.Drivers")
    assert (said.code, said.err) == (0, "")
    assert said.out.endswith("generated/pyproject.toml is new: pip install -e generated\n")
    assert tomllib.loads(FILE.read_text())["project"]["name"] == "Acme.Drivers"
    FILE.write_text("# mine\n")
    assert "is new" not in cli("generate", "--project", "other").out
    assert FILE.read_text() == "# mine\n"


@pytest.mark.usefixtures("oven")
def test_a_project_file_is_no_generated_file_that_check_asks_for(cli: Callable[..., Any]) -> None:
    cli("generate")
    assert not FILE.exists()
    assert cli("generate", "--check").code == 0
    cli("generate", "--project", "acme-drivers")
    assert cli("generate", "--check").code == 0
    cli("generate")
    assert FILE.exists()


@pytest.mark.usefixtures("oven")
@pytest.mark.parametrize("name", ["", "a b", "-a", "a-", 'a"\n[x]', "../a", "\u0663", "REGSCRIBE", "regscribe_devices"])
def test_what_is_no_name_of_a_distribution_of_ones_own_is_refused(cli: Callable[..., Any], name: str) -> None:
    said = cli("generate", "--project", name)
    assert said.code == 2
    assert "--project" in said.err
    assert not Path("generated").exists()


@pytest.mark.usefixtures("oven")
def test_a_project_file_that_cannot_be_written_is_told(
    cli: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("tempfile.mkstemp", full)
    said = cli("generate", "--project", "acme-drivers")
    assert said.code == 74
    assert "pyproject.toml cannot be written (No space left on device)" in said.err


@pytest.mark.usefixtures("oven")
def test_check_and_project_contradict_each_other(cli: Callable[..., Any]) -> None:
    assert cli("generate", "--check", "--project", "acme-drivers").code == 2
