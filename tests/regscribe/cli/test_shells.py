"""Completion in the shells themselves, as far as they are installed, and the manual pages."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click
import pytest

from regscribe.cli.app import COMMANDS, regscribe
from regscribe.cli.shared.exit_codes import EXIT_CODES
from regscribe.cli.shared.man_page import escaped, pages

Cli = Callable[..., Any]
BIN = Path(sys.executable).parent
PAGES = dict(pages(regscribe))
SCRIPTS = {
    "bash": 'eval "$(regscribe completion bash)"\nCOMP_WORDS=(TYPED)\nCOMP_CWORD=LAST\n'
    '_regscribe_completion regscribe\nprintf "%s\\n" "${COMPREPLY[@]}"',
    "zsh": "compdef() { : }\n_describe() { print -l -- ${completions_with_descriptions%%:*} }\n"
    "compadd() { print -l -- $completions }\n"
    'eval "$(regscribe completion zsh)"\nwords=(TYPED)\nCURRENT=$((LAST + 1))\n_regscribe_completion',
    "fish": 'regscribe completion fish | source\ncomplete -C "TYPED"',
}


@pytest.mark.skipif(not (BIN / "regscribe").exists(), reason="regscribe is not installed beside this Python")
@pytest.mark.parametrize("shell", SCRIPTS)
@pytest.mark.parametrize(
    ("typed", "completed"),
    [
        ("regscribe che", "check"),
        ("regscribe check --str", "--strict"),
        ("regscribe export athena/ser", "athena/series-c"),
        ("regscribe explain RS040", "RS0401"),
        ("regscribe read --col", "--color"),
    ],
)
def test_a_shell_completes_commands_and_options(shell: str, typed: str, completed: str, tmp_path: Path) -> None:
    program = shutil.which(shell)
    if program is None:
        pytest.skip(f"{shell} is not here")
    script = SCRIPTS[shell].replace("TYPED", typed).replace("LAST", str(len(typed.split()) - 1))
    environment = {"PATH": f"{BIN}:{os.environ['PATH']}", "HOME": str(tmp_path)}
    done = subprocess.run([program], input=script, capture_output=True, text=True, env=environment, check=False)  # noqa: S603 - our own
    found = [line.split("\t")[0].removeprefix("plain,") for line in done.stdout.split("\n")]
    assert completed in found, done


def test_powershell_gets_the_script_of_click(cli: Cli) -> None:
    result = cli("completion", "powershell")
    assert result.code == 0
    assert "Register-ArgumentCompleter -Native -CommandName regscribe" in " ".join(result.out.split())
    assert "$env:_REGSCRIBE_COMPLETE = 'powershell_complete'" in result.out


def test_a_click_that_lacks_a_shell_is_said(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("regscribe.cli.commands.completion.get_completion_class", lambda _: None)
    result = cli("completion", "powershell")
    assert (result.code, "click>=8.5" in result.err) == (2, True)


def test_every_command_has_a_page_with_its_help() -> None:
    assert PAGES.keys() >= {f"regscribe-{name}.1" for name in COMMANDS} | {"regscribe.1", "regscribe-program-show.1"}
    check = PAGES["regscribe-check.1"]
    assert check.startswith('.TH "REGSCRIBE\\-CHECK" 1 ')
    assert ".SH NAME\nregscribe\\-check \\- Report what is wrong in maps\n" in check
    assert ".TP\n.B \\-\\-strict\nLet warnings count as findings, too.\n" in check
    assert all(f".TP\n.B {code}\n" in PAGES["regscribe.1"] for code in EXIT_CODES)


def test_a_page_is_the_same_whatever_the_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "40")
    assert dict(pages(regscribe)) == PAGES


def test_no_text_becomes_a_request_of_roff() -> None:
    assert escaped(".so /etc/passwd") == "\\&.so /etc/passwd"
    assert escaped("'x\n.y\\n-") == "\\&'x\n\\&.y\\en\\-"

    @click.command(help=".so /etc/passwd\n\n'quoted\\fB", epilog="\b\n.begins\n  kept")
    @click.option("--x", metavar='A"B', help=".looks like a request")
    def hostile(x: str) -> None: ...

    group = click.Group("regscribe", commands={"hostile": hostile})
    text = dict(pages(group))["regscribe-hostile.1"]
    requests = {line.split()[0] for line in text.splitlines() if line.startswith((".", "'"))}
    assert requests <= {".TH", ".SH", ".B", ".TP", ".PP", ".nf", ".fi"}
    assert "\\-\\-x A\\(dqB" in text


@pytest.mark.parametrize(
    "tool", [["mandoc", "-T", "lint", "-W", "warning"], ["groff", "-man", "-ww", "-z", "-K", "utf8"]]
)
def test_no_page_is_complained_about(tool: list[str], tmp_path: Path) -> None:
    if shutil.which(tool[0]) is None:
        pytest.skip(f"{tool[0]} is not here")
    for name, text in PAGES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    done = subprocess.run([*tool, *PAGES], capture_output=True, text=True, cwd=tmp_path, check=False)  # noqa: S603 - as above
    said = [line for line in (done.stdout + done.stderr).splitlines() if "missing date" not in line]  # pages have none
    assert said == []


def test_pages_are_written_into_a_new_folder(cli: Cli, folder: Path) -> None:
    result = cli("man", "-o", "share/man1")
    assert (result.code, result.out) == (0, f"{len(PAGES)} pages in share/man1\n")
    assert (folder / "share/man1/regscribe-read.1").read_text(encoding="utf-8") == PAGES["regscribe-read.1"]
    (folder / "file").write_text("")
    refused = cli("man", "-o", "file/man1")
    assert (refused.code, "cannot make the folder file/man1" in refused.err) == (74, True)
