"""Small YAML -> generate -> import -> talk to the simulator: what every test here does."""

import importlib.util
import itertools
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import pytest

from regscribe import checks, lower, schema, source
from regscribe.emit import python
from regscribe.model import RegisterMap, Severity

OVEN = (Path(__file__).parent / "oven.yaml").read_text(encoding="utf-8")
"""A made-up controller with every hard fact of the real manuals in a few registers."""


class Built(NamedTuple):
    """A compiled map and its generated driver module."""

    map: RegisterMap
    module: Any

    def driver(self, model: str) -> Any:
        """The synchronous driver class of a model."""
        return getattr(self.module, self.map.model(model).class_name)


def compile_text(text: str) -> RegisterMap:
    """All phases; fails the test with the diagnostics if there is an error."""
    document, found = source.parse(text, name="maps/test/oven.yaml")
    assert document is not None, found
    found = [*found, *schema.validate(document)]
    assert not found, found
    register_map, lowered = lower.lower(document)
    assert register_map is not None, lowered
    errors = [one for one in checks.check(register_map) if one.severity is Severity.ERROR]
    assert not errors, errors
    return register_map


def load(path: Path, name: str) -> ModuleType:
    """Import a generated file under a name of its own."""
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


_numbers = itertools.count()


@pytest.fixture(scope="session")
def build(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Built]:
    """Compile, generate and import a map."""

    def make(text: str) -> Built:
        register_map = compile_text(text)
        ((_, code),) = python.render(register_map).items()
        folder = tmp_path_factory.mktemp("generated")
        (folder / "driver.py").write_text(code, encoding="utf-8")
        return Built(register_map, load(folder / "driver.py", f"generated_driver_{next(_numbers)}"))

    return make


@pytest.fixture(scope="session")
def oven(build: Callable[[str], Built]) -> Built:
    """The made-up controller."""
    return build(OVEN)
