"""Import drivers from a folder that `regscribe generate` wrote, wherever it lies and whatever is installed."""

from importlib import import_module
from pathlib import Path
from types import ModuleType

PACKAGE = "regscribe_devices"


def driver_module(generated: Path, name: str) -> ModuleType:
    """Import `regscribe_devices.<name>` from the folder `generated`, which need not be on Python's path.

    Raises ImportError if there is none, or if that module was imported from elsewhere before.
    """
    *packages, last = (PACKAGE, *name.split("."))
    folder, module = generated.resolve(), ""
    for package in packages:
        folder, module = folder / package, f"{module}.{package}".lstrip(".")
        imported = import_module(module)
        others = [path for path in imported.__path__ if path != str(folder)]
        imported.__path__ = [str(folder), *others]  # first: vectors judge the driver beside them
    found = import_module(f"{module}.{last}")
    if Path(str(found.__file__)).resolve().parent != folder:
        message = f"{found.__name__} was imported from {found.__file__} already; these tests are of the one in {folder}"
        raise ImportError(message, name=found.__name__, path=found.__file__)
    return found
