"""A repository of a user with regscribe from its wheels: maps, generated files, their tests, drivers for production."""

import shutil
import sys
import venv
from pathlib import Path

import pytest

from .distributions import run

pytestmark = pytest.mark.slow

TYPE_CHECKERS = [
    (sys.executable, "-m", "mypy", "--strict", "--python-executable"),
    (sys.executable, "-m", "pyright", "--pythonpath"),
]


@pytest.fixture
def repository(user: Path, tmp_path: Path) -> Path:
    """A fresh folder in which a user started two maps of one family name, and has a test of that name already."""
    for maker in ("acme", "bosch"):
        run(user / "regscribe", "new", f"{maker}/oven", cwd=tmp_path)
    own = tmp_path / "tests" / "test_oven.py"
    own.parent.mkdir()
    own.write_text("def test_mine():\n    pass\n", encoding="utf-8")
    run(user / "regscribe", "generate", "--project", "acme-drivers", cwd=tmp_path)
    return tmp_path


def test_the_generated_tests_of_a_fresh_repository_pass(user: Path, repository: Path) -> None:
    said = run(user / "python", "-m", "pytest", "-W", "error", "-q", cwd=repository)
    assert " passed" in said.splitlines()[-1]
    assert " skipped" not in said
    listed = run(user / "python", "-m", "pytest", "--collect-only", "-q", "generated/tests", cwd=repository)
    assert "tests/acme/test_acme__oven.py" in listed
    assert "tests/bosch/test_bosch__oven.py" in listed


def test_the_generated_tests_notice_a_driver_that_was_changed(user: Path, repository: Path) -> None:
    driver = repository / "generated/regscribe_devices/acme/oven.py"
    text = driver.read_text(encoding="utf-8")
    changed = text.replace('Fraction("0.1")', 'Fraction("0.2")')
    assert changed != text
    driver.write_text(changed, encoding="utf-8")
    with pytest.raises(AssertionError, match="failed"):
        run(user / "python", "-m", "pytest", "-q", "generated/tests/acme", cwd=repository)


def test_the_generated_tests_run_from_any_folder(user: Path, repository: Path, tmp_path: Path) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    said = run(user / "python", "-m", "pytest", "-q", repository / "generated/tests", cwd=elsewhere)
    assert " passed" in said


def test_without_hypothesis_the_generated_tests_name_what_to_install(
    user: Path, repository: Path, tmp_path: Path
) -> None:
    hidden = tmp_path / "hidden"
    hidden.mkdir()
    (hidden / "hypothesis.py").write_text("raise ModuleNotFoundError('no', name='hypothesis')\n", encoding="utf-8")
    with pytest.raises(AssertionError, match=r"pip install 'regscribe\[test\]'"):
        run(
            *(user / "python", "-m", "pytest", "-q", "-p", "no:hypothesispytest", "generated/tests"),
            cwd=repository,
            PYTHONPATH=str(hidden),
        )


def test_drivers_of_a_user_and_of_regscribe_come_and_go_one_without_the_other(
    repository: Path, wheel_folder: Path, tmp_path: Path
) -> None:
    production = tmp_path / "production"
    venv.create(production, with_pip=True, symlinks=True)
    pip = (production / "bin/python", "-m", "pip")
    shutil.copytree(repository / "generated", tmp_path / "copy")
    run(*pip, "install", tmp_path / "copy", "regscribe-devices", cwd=tmp_path, PIP_FIND_LINKS=str(wheel_folder))
    known = "from regscribe_runtime import known_models\nprint(*sorted({one.map_id for one in known_models()}))"
    both = run(production / "bin/python", "-c", known, cwd=tmp_path).split()
    assert {"fdc/series-100"} < {*both}
    run(*pip, "uninstall", "-y", "regscribe-devices", cwd=tmp_path)
    use = tmp_path / "use.py"
    use.write_text(
        "from regscribe_devices.acme.oven import AcmePlus\n\nreveal_type(AcmePlus.model)\n", encoding="utf-8"
    )
    assert run(production / "bin/python", "-c", "import regscribe_devices.acme.oven", cwd=tmp_path) == ""
    for checker in TYPE_CHECKERS:
        assert "str" in run(*checker, production / "bin/python", use, cwd=tmp_path)
    run(*pip, "install", "regscribe-devices", cwd=tmp_path, PIP_FIND_LINKS=str(wheel_folder))
    run(*pip, "uninstall", "-y", "acme-drivers", cwd=tmp_path)
    assert {"fdc/series-100"} < {*run(production / "bin/python", "-c", known, cwd=tmp_path).split()}


def test_pip_installs_the_drivers_beside_the_runtime_alone(
    repository: Path, wheel_folder: Path, tmp_path: Path
) -> None:
    production = tmp_path / "production"
    venv.create(production, with_pip=True, symlinks=True)
    shutil.copytree(repository / "generated", tmp_path / "copy")
    run(
        *(production / "bin/python", "-m", "pip", "install", tmp_path / "copy"),
        cwd=tmp_path,
        PIP_FIND_LINKS=str(wheel_folder),
    )
    script = (
        "import importlib.util\n"
        "from regscribe_devices.acme.oven import AcmePlus\n"
        "print(AcmePlus.model, importlib.util.find_spec('regscribe'))"
    )
    assert run(production / "bin/python", "-c", script, cwd=tmp_path) == "Plus None\n"
