"""All models that drivers exist for: those that come with regscribe, and those of the user's own packages."""

import importlib
import pkgutil
import sys
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from types import ModuleType

from regscribe.tools.live.errors import MOST_SHOWN, TargetError, unknown
from regscribe_runtime import BareDevice
from regscribe_runtime.driver.identify import Known

SHIPPED = "regscribe_devices"
"""The package of the drivers that come with regscribe."""


@cache
def models(packages: tuple[str, ...] = ()) -> tuple[Known, ...]:
    """Every model of the shipped package and of `packages`, by map and model; TargetError if one cannot be imported.

    A package is named as Python imports it, or by its folder. The first of several that have a model provides it.
    """
    found: dict[tuple[str, str], Known] = {}
    for name in (*packages, SHIPPED):
        for known in _drivers(package(name)):
            found.setdefault((known.map_id, known.model), known)
    return tuple(found[key] for key in sorted(found))


def find(name: str, packages: Sequence[str] = ()) -> Known:
    """The model of that name: `16C`, `athena/series-c:16C`, or the class `Athena16C`; case does not matter.

    The id of a map is the name of its model, if it has one.

    TargetError says which was probably meant, or which several have that name.
    """
    known = models(tuple(packages))
    wanted = name.casefold()
    found = [one for one in known if wanted in map(str.casefold, (one.model, full_name(one), one.driver.__name__))]
    found = found or [one for one in known if wanted == one.map_id]
    if not found:
        names = [text for one in known for text in (one.model, full_name(one))]
        raise TargetError(unknown("model", name, names, where="among the drivers") + "; `regscribe devices` lists all")
    if len(found) > 1:
        what = f"{name} has several models" if wanted == found[0].map_id else f"several maps have a model `{name}`"
        message = f"{what}: write {' or '.join(map(full_name, found))}"
        raise TargetError(message)
    return found[0]


def full_name(known: Known) -> str:
    """The name of a model that no other has: `athena/series-c:16C`."""
    return f"{known.map_id}:{known.model}"


def title(known: Known) -> str:
    """The title of a model in its driver: `Athena Controls 16C: Compact panel controller`."""
    first = (known.driver.__doc__ or "").split("\n\n", 1)[0]
    return " ".join(first.split()).removesuffix(".").removesuffix("(synchronous driver)").strip()


def package(name: str) -> ModuleType:
    """The package of that name, or in that folder; TargetError if it cannot be imported."""
    path = Path(name)
    if path.is_dir() and ("/" in name or path.is_absolute()):
        sys.path.insert(0, str(path.resolve().parent))
        name = path.resolve().name
    try:
        if not all(part.isidentifier() for part in name.split(".")):
            what = "that is no name of a package"
            raise ImportError(what)  # noqa: TRY301 (what Python says of such names is of many sorts)
        return importlib.import_module(name)
    except Exception as error:  # noqa: BLE001 (whatever the user's package does when it is imported)
        message = (
            f"the package `{name[:MOST_SHOWN]}` of drivers cannot be imported ({error}): name one that is installed, "
            "or its folder (./build/my_devices)"
        )
        raise TargetError(message) from None


def _drivers(package: ModuleType) -> Iterator[Known]:
    """The drivers that the modules of a package define."""
    infos = pkgutil.walk_packages(getattr(package, "__path__", []), f"{package.__name__}.")
    for module in (package, *(importlib.import_module(info.name) for info in infos)):
        for value in list(vars(module).values()):
            own = isinstance(value, type) and issubclass(value, BareDevice) and value.__module__ == module.__name__
            if own and value.model and hasattr(module, f"Async{value.__name__}"):
                yield Known(value.map_id, value.model, value, getattr(module, f"Async{value.__name__}"))
