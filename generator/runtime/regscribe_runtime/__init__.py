"""The runtime of generated drivers: declarations, errors, and the two kinds of driver.

`public` is imported with the first access to a name, so that the compiler, which needs `values` alone, loads no driver.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from regscribe_runtime.public import *  # noqa: F403 (its re-exports)


def __getattr__(name: str) -> object:
    public = import_module("regscribe_runtime.public")
    names = {each: value for each, value in vars(public).items() if not each.startswith("_")}
    if name not in names:
        message = f"module {__name__!r} has no attribute {name!r}"
        raise AttributeError(message)
    globals().update(names)
    return names[name]
