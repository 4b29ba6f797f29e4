"""Who types what README and tutorial show, into a shell that knows nothing yet, finds the commands."""

import re
import shlex
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
ACTIVATE = ". .venv/bin/activate"
PAGES = {name: (ROOT / name).read_text(encoding="utf-8") for name in ("README.md", "docs/tutorial.md")}

pytestmark = pytest.mark.skipif(
    not (ROOT / ".venv/bin/regscribe").exists(), reason="`make generate` did not make this environment"
)


def typed(text: str, folder: Path, shell: str = "bash") -> subprocess.CompletedProcess[str]:
    """What a new login shell without any variables makes of it."""
    program = shutil.which(shell)
    assert program is not None
    environment = {"HOME": str(folder), "TERM": "dumb"}
    command = ["/usr/bin/env", "-i", *(f"{name}={value}" for name, value in environment.items()), program, "-l"]
    return subprocess.run(command, input=text, capture_output=True, text=True, cwd=folder, timeout=60, check=False)  # noqa: S603 - our own


def shown(page: str) -> list[str]:
    """The commands of a page, by its prompts and by its lists of commands."""
    prompts = re.findall(r"^\$ (.+)", PAGES[page], re.MULTILINE)
    return prompts + re.findall(r"^regscribe [^#\n]+", PAGES[page], re.MULTILINE)


@pytest.mark.parametrize("page", PAGES)
def test_every_command_of_a_page_is_found_after_what_the_page_says_first(page: str, tmp_path: Path) -> None:
    assert ACTIVATE in PAGES[page]
    names = sorted({shlex.split(line)[0] for line in shown(page)})
    assert "regscribe" in names
    lines = [f"cd {shlex.quote(str(ROOT))}", ACTIVATE, f"cd {shlex.quote(str(tmp_path))}"]
    done = typed("\n".join([*lines, *(f"command -v {name} >/dev/null || echo no {name}" for name in names)]), tmp_path)
    assert (done.returncode, done.stdout) == (0, ""), done.stderr


def test_the_first_steps_of_the_tutorial_work_as_typed(tmp_path: Path) -> None:
    first, *_ = shown("docs/tutorial.md")
    assert first == "regscribe new brennwerk/oc-20"
    activate = f"cd {shlex.quote(str(ROOT))}\n{ACTIVATE}\ncd {shlex.quote(str(tmp_path))}\n"
    done = typed(f"{activate}{first}\nregscribe check\npython -c 'import regscribe_devices'\n", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.endswith("1 map checked: no findings\n")


@pytest.mark.parametrize("shell", ["bash", "dash"])
def test_the_launcher_runs_from_anywhere_and_through_links(shell: str, tmp_path: Path) -> None:
    if shutil.which(shell) is None:
        pytest.skip(f"{shell} is not here")
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "regscribe").symlink_to(ROOT / "regscribe")
    (tmp_path / "again").symlink_to("bin/regscribe")
    for command in (ROOT / "regscribe", tmp_path / "bin" / "regscribe", "./again"):
        done = typed(f"{shlex.quote(str(command))} explain RS9999", tmp_path, shell)
        assert (done.returncode, "there is no rule `RS9999`" in done.stderr) == (2, True)


def test_the_launcher_says_what_is_missing(tmp_path: Path) -> None:
    shutil.copy(ROOT / "regscribe", tmp_path)
    done = typed("./regscribe check", tmp_path)
    assert done.returncode == 127
    assert done.stderr == "regscribe is not installed in this checkout: run `make generate` in . first\n"
