"""A repository of a user with one map, and changes of it."""

from pathlib import Path

from .distributions import ROOT, run
from .steps import blocks

PAGE = blocks((ROOT / "docs" / "ci.md").read_text(encoding="utf-8"))
"""The blocks of the page that tells how to make one."""
OVEN = Path("maps/acme/oven.yaml")
DRIVER = Path("generated/regscribe_devices/acme/oven.py")
WHO = {f"GIT_{role}_{what}": "somebody@example.org" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}


def git(folder: Path, *arguments: str) -> None:
    run("git", *arguments, cwd=folder, **WHO)


def change(folder: Path, path: Path, old: str, new: str) -> None:
    text = (folder / path).read_text(encoding="utf-8")
    assert old in text
    (folder / path).write_text(text.replace(old, new, 1), encoding="utf-8")


def moved_register(folder: Path, user: Path) -> None:
    change(folder, OVEN, "at: 30001, name: Process Value", "at: 30090, name: Process Value")
    run(user / "regscribe", "generate", cwd=folder)
