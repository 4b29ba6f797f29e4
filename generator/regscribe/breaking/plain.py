"""Values of the model as plain values that compare: without places in files, without names of conditions.

The old version is said in the words of the new one: what was renamed has its new name.
"""

from collections.abc import Hashable, Iterable
from enum import Enum as PythonEnum
from fractions import Fraction
from types import NoneType
from typing import Any

from regscribe.breaking.field_roles import IDS, PAIRS, PATHS, TEXTS, UNCOMPARED, UNORDERED
from regscribe.breaking.renames import SAME_NAMES, Renames
from regscribe.emit.words import one_line
from regscribe.model import Condition, Open, OrderCases


def plain(value: Any, renames: Renames = SAME_NAMES, *, texts: bool = False) -> Hashable:  # noqa: ANN401 (any value of the model)
    """A value of the model as nested tuples; without `texts`, what only readers see is left out."""
    if isinstance(value, Open):
        return ("open", one_line(value) if texts else "")
    if isinstance(value, str | int | Fraction | bytes | NoneType | PythonEnum):
        return _scalar(value)
    if isinstance(value, Condition):
        if value.name in renames.conditions:
            return ("condition", value.name)
        return ("when", _unordered(plain(test, renames, texts=texts) for test in value.tests))
    names = field_names(value)
    if names:
        kept = [name for name in names if name not in UNCOMPARED and (texts or name not in TEXTS.get(type(value), ()))]
        return (type(value).__name__, *(plain_field(value, name, renames, texts=texts) for name in kept))
    return tuple(plain(each, renames, texts=texts) for each in value)


def _unordered(values: Iterable[Hashable]) -> Hashable:
    """Values whose order says nothing; each counts as often as it stands there."""
    return tuple(sorted(values, key=repr))


def _scalar(value: str | int | Fraction | bytes | PythonEnum | None) -> Hashable:
    """A text on one line, a number as a fraction, anything else as it is."""
    if isinstance(value, PythonEnum | bool | bytes) or value is None:
        return value
    return one_line(value) if isinstance(value, str) else Fraction(value)


def field_names(value: object) -> tuple[str, ...]:
    """The names of the fields of a record of the model; none for what is no record."""
    return tuple(getattr(value, "_fields", None) or getattr(value, "__dataclass_fields__", None) or ())


def plain_field(thing: Any, name: str, renames: Renames = SAME_NAMES, *, texts: bool = False) -> Hashable:  # noqa: ANN401 (as above)
    """One field of a thing as `plain` has it."""
    value = renamed_field(thing, name, renames)
    if name in UNORDERED.get(type(thing), ()) or (isinstance(thing, OrderCases) and thing.by_code()):
        return _unordered(plain(each, renames, texts=texts) for each in value)
    return plain(value, renames, texts=texts)


def renamed_field(thing: Any, name: str, renames: Renames) -> Any:  # noqa: ANN401 (as above)
    """A field of a thing, with what was renamed by its new name."""
    value = getattr(thing, name)
    if name in PATHS.get(type(thing), ()):
        value = _replaced(value, renames.path)
    elif (half := PAIRS.get(type(thing), {}).get(name)) is not None:
        value = tuple((*pair[:half], renames.path(pair[half]), *pair[half + 1 :]) for pair in value)
    elif sort := IDS.get(type(thing), {}).get(name):
        value = getattr(renames, sort).get(value, value)
    return value


def _replaced(value: Any, path: Any) -> Any:  # noqa: ANN401 (nested tuples with paths in them)
    """Each text in nested tuples as `path` has it; conditions stay, as they know their own."""
    if isinstance(value, str) and not isinstance(value, PythonEnum):
        return path(value)
    if isinstance(value, Condition):
        return value
    if hasattr(value, "_fields"):
        return type(value)(*(_replaced(each, path) for each in value))
    return tuple(_replaced(each, path) for each in value) if isinstance(value, tuple) else value
