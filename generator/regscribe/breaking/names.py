"""The public names of driver modules: what programs import besides paths."""

import ast
import re
from collections.abc import Iterator

from regscribe.breaking.change import Difference, Effects
from regscribe.breaking.facts import B, C, N
from regscribe.breaking.rules import NAME_ADDED, NAME_REMOVED
from regscribe.emit.python import render
from regscribe.emit.python.library_modules import module_path
from regscribe.model import Model, RegisterMap

ALL = re.compile(r"^__all__ = (\[.*?^\])", re.MULTILINE | re.DOTALL)


def public_names(register_map: RegisterMap) -> frozenset[str]:
    """The names that the driver module of a map exports."""
    found = ALL.search(render(register_map)[module_path(register_map.id)])
    return frozenset(ast.literal_eval(found[1])) if found else frozenset()


def name_differences(old: RegisterMap, new: RegisterMap) -> Iterator[Difference]:
    """Names that came and went, but for the classes of models that came and went as wholes."""
    before, after = public_names(old), public_names(new)
    models = _classes(old, new) | _classes(new, old)
    gone, come = sorted(before - after - models), sorted(after - before - models)
    if gone:
        yield Difference(NAME_REMOVED, "names of the driver module", Effects(N, B), ", ".join(gone), "none")
    if come:
        yield Difference(NAME_ADDED, "names of the driver module", Effects(N, C), "none", ", ".join(come))


def _classes(one: RegisterMap, other: RegisterMap) -> set[str]:
    """The classes of models that one map alone has."""
    lacking: list[Model] = [model for model in one.models if not other.has(model.name)]
    return {name for model in lacking for name in (model.class_name, f"Async{model.class_name}")}
