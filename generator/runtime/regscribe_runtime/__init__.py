"""What generated drivers import: declarations, errors, and the two kinds of driver.

All of it is loaded as its first name is asked for, so that a compiler, which wants the vocabulary in `values` alone,
loads no driver.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from regscribe_runtime.public import *  # noqa: F403 (just what `__all__` there lists)


def __getattr__(name: str) -> object:
    public = import_module("regscribe_runtime.public")
    names = {each: getattr(public, each) for each in public.__all__}
    if name not in names:
        message = f"module {__name__!r} has no attribute {name!r}"
        raise AttributeError(message)
    globals().update(names)
    return names[name]
