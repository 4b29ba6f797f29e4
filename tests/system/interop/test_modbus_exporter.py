"""promtool takes the names and types that metrics of modbus_exporter would have; the exporter itself is not run."""

import shutil
import subprocess
from typing import Any

import pytest
import yaml

from .stage import Stage

pytestmark = pytest.mark.interop("promtool")


def exposition(metrics: list[dict[str, Any]]) -> str:
    """The text that a scrape would give, with 0 for each value."""
    lines = []
    for one in sorted(metrics, key=lambda one: str(one["name"])):  # samples of one name stand together
        head = [f"# HELP {one['name']} {one['help']}", f"# TYPE {one['name']} {one['metricType']}"]
        labels = ",".join(f'{key}="{value}"' for key, value in {**one.get("labels", {}), "module": "m"}.items())
        lines += [*(line for line in head if line not in lines), f"{one['name']}{{{labels}}} 0"]
    return "".join(f"{line}\n" for line in lines)


def test_promtool_finds_nothing_to_say_of_names_and_types(stage: Stage) -> None:
    (module,) = yaml.safe_load(stage.text("modbus-exporter"))["modules"]
    assert linted(exposition(module["metrics"])) == (0, "")


def test_promtool_would_say_it_of_a_name_that_is_none() -> None:
    code, said = linted("# HELP a_total a\n# TYPE a_total gauge\na_total 0\n")
    assert (code, "total" in said) == (3, True)


def linted(text: str) -> tuple[int, str]:
    program = shutil.which("promtool")
    assert program is not None
    command = [program, "check", "metrics"]
    done = subprocess.run(command, input=text, capture_output=True, text=True, timeout=30, check=False)  # noqa: S603 (fixed)
    return done.returncode, done.stdout + done.stderr
