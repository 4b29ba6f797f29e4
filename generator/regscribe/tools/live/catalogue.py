"""All models that there are drivers for: of the user's packages, of the maps here, and what comes with regscribe.

A map in the folder `maps/` here needs no generated driver: it is compiled when its models are asked for.
"""

import importlib
import pkgutil
import re
import sys
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from pathlib import Path
from types import ModuleType

from regscribe.map_files import ENDINGS, LOCAL, MAP, files_below, is_file, kind_of, shipped
from regscribe.tools.live.errors import MOST_NAMED, MOST_SHOWN, TargetError, unknown
from regscribe.tools.live.map_drivers import MapError, origin_of, package_of
from regscribe_runtime import BareDevice
from regscribe_runtime.driver.identify import Known

SHIPPED = "regscribe_devices"
"""The package of the drivers that come with regscribe."""

_FILE = re.compile(r"(.+\.ya?ml)(?::(.*))?", re.DOTALL)
"""A map named by its file, and the model in it."""


def models(packages: Sequence[str] = ()) -> tuple[Known, ...]:
    """Every model of `packages`, of the maps here and of the shipped package, by map and model.

    A package is named as Python imports it, or by its folder; TargetError if one cannot be imported. The first of
    several that have a model provides it. A map with errors has no models here (see `broken_maps`).
    """
    return _first_of_each(_known_in(modules(packages)))


def modules(packages: Sequence[str] = ()) -> tuple[ModuleType, ...]:
    """The packages that `models` looks in, the first to count first."""
    return (*map(package, packages), *(module for module, _ in _own_maps() if module), package(SHIPPED))


def broken_maps() -> tuple[MapError, ...]:
    """The errors of maps here that cannot be compiled."""
    return tuple(error for _, error in _own_maps() if error)


def find(name: str, packages: Sequence[str] = ()) -> Known:
    """The model of that name: `16C`, `athena/series-c:16C`, or the class `Athena16C`; case does not matter.

    The id of a map is the name of its model, if it has one; its file stands for the id (`maps/acme/pump.yaml:P1`).

    TargetError says which was probably meant, which several have that name, or where it was looked for.
    """
    file = _FILE.fullmatch(name)
    known = of_map(file[1]) if file else models(packages)
    wanted = (f"{known[0].map_id}:{file[2]}" if file[2] else known[0].map_id) if file else name
    found = _fitting(wanted.casefold(), known)
    if not found:
        _tell_broken(wanted)
        own_first = sorted(known, key=lambda one: origin_of(one.driver) is None)
        names = [full_name(one) if {":", "/"} & {*name} else one.model for one in own_first]
        raise TargetError(unknown("model", name, names, where=_where(file, packages)))
    if len(found) > 1:
        what = f"{name} has several models" if wanted == found[0].map_id else f"several maps have a model `{name}`"
        message = f"{what}: write {' or '.join(map(full_name, found))}"
        raise TargetError(message)
    if not file:
        _refuse_doubtful(found[0])
    return found[0]


def of_map(name: str, packages: Sequence[str] = ()) -> tuple[Known, ...]:
    """All models of a map, named by its file or its id; MapError if it has errors, TargetError if there is none."""
    if _FILE.fullmatch(name):
        if not is_file(name) or kind_of(name) != MAP:
            message = f"there is no map {name[:MOST_SHOWN]}"
            raise TargetError(message)
        return _first_of_each(_known_in([package_of(Path(name))]))
    known = models(packages)
    found = tuple(one for one in known if one.map_id == name.casefold())
    if not found:
        _tell_broken(name)
        raise TargetError(
            unknown("map", name, dict.fromkeys(one.map_id for one in known), where=_where(None, packages))
        )
    _refuse_doubtful(found[0])
    return found


def instead_of_shipped(known: Known) -> str:
    """That a map here counts instead of the driver that comes with regscribe; empty where it does not."""
    path = origin_of(known.driver)
    same = [one for one in _drivers(package(SHIPPED)) if one[:2] == known[:2]] if path else []
    return f"{full_name(known)} is that of {path}, not the driver that comes with regscribe" if same else ""


def _fitting(wanted: str, known: Sequence[Known]) -> list[Known]:
    """The models of that name; else those of the map of that id."""
    found = [one for one in known if wanted in map(str.casefold, (one.model, full_name(one), one.driver.__name__))]
    return found or [one for one in known if wanted == one.map_id]


def _refuse_doubtful(known: Known) -> None:
    """Refuse a model whose map stands here twice, or here with errors."""
    same = [path for path in map(origin_of, _own_drivers(known)) if path]
    if len(same) > 1:
        message = f"several maps here have the id {known.map_id}: name one by its file, {' or '.join(map(str, same))}"
        raise TargetError(message)
    if origin_of(known.driver) is None:
        _tell_broken(known.map_id)


def _own_drivers(known: Known) -> list[type]:
    """The drivers of a model in all maps here."""
    own = (_drivers(module) for module, _ in _own_maps() if module)
    return [one.driver for drivers in own for one in drivers if one[:2] == known[:2]]


def _tell_broken(name: str) -> None:
    """Raise the errors of the map here that has this id (or whose model has this name), by the name of its file."""
    for error in broken_maps():
        map_id = error.path.relative_to(LOCAL).as_posix().removesuffix(ENDINGS[MAP])
        if name.casefold().partition(":")[0] in {map_id, str(error.path)}:
            raise error


def _where(file: re.Match[str] | None, packages: Sequence[str]) -> str:
    """Where a name was looked for: `in maps/ here (1 of 2 maps has errors), in ... and among the drivers of ...`."""
    if file:
        return f"in {file[1]}"
    own = _own_maps()
    broken = [str(error.path) for _, error in own if error]
    faults = (
        f", {' and '.join(broken[:MOST_NAMED])} {'have' if len(broken) > 1 else 'has'} errors: `regscribe check`"
        if broken
        else ""
    )
    here = f"in {LOCAL}/ ({len(own)} of your own{faults})" if LOCAL.is_dir() else f"here (there is no folder {LOCAL}/)"
    return " or ".join([f"in {name}" for name in packages] + [here, "among the drivers that `regscribe devices` lists"])


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


def _first_of_each(every: Iterable[Known]) -> tuple[Known, ...]:
    found: dict[tuple[str, str], Known] = {}
    for known in every:
        found.setdefault((known.map_id, known.model), known)
    return tuple(found[key] for key in sorted(found))


def _known_in(packages: Iterable[ModuleType]) -> Iterator[Known]:
    return (known for package in packages for known in _drivers(package))


def _own_maps() -> list[tuple[ModuleType | None, MapError | None]]:
    """The package of each map in `maps/` here, or the errors of the map."""
    if not LOCAL.is_dir():
        return []
    found: list[tuple[ModuleType | None, MapError | None]] = []
    for path in _own_files():
        try:
            found.append((package_of(path), None))
        except MapError as error:
            found.append((None, error))
    return found


def _own_files() -> list[Path]:
    """The maps here, but for those of regscribe's own checkout that drivers were generated for."""
    files = files_below(LOCAL)
    if LOCAL.resolve() != shipped().resolve():
        return files
    generated = {known.map_id for known in _drivers(package(SHIPPED))}
    return [path for path in files if path.relative_to(LOCAL).as_posix().removesuffix(ENDINGS[MAP]) not in generated]


@cache
def _drivers(package: ModuleType) -> tuple[Known, ...]:
    """The drivers that the modules of a package define."""
    return tuple(_defined_in(package))


def _defined_in(package: ModuleType) -> Iterator[Known]:
    infos = pkgutil.walk_packages(getattr(package, "__path__", []), f"{package.__name__}.")
    for module in (package, *(importlib.import_module(info.name) for info in infos)):
        for value in list(vars(module).values()):
            own = isinstance(value, type) and issubclass(value, BareDevice) and value.__module__ == module.__name__
            if own and value.model and hasattr(module, f"Async{value.__name__}"):
                yield Known(value.map_id, value.model, value, getattr(module, f"Async{value.__name__}"))
