"""The result of reading several registers at once."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, TypeVar, overload

from regscribe.runtime.errors import RegscribeError

if TYPE_CHECKING:
    from regscribe.runtime.register import Register

T = TypeVar("T")


class Snapshot(Mapping[str, Any]):
    """Values by register path; a register without a value raises its error when it is asked for.

    Such errors are ValueNotDecodable (with SensorFault and Saturated), or Absent for what this unit does not have.

    Index it with a register of the driver's class for a typed value: `snapshot[Athena16C.process_value]`.
    """

    def __init__(self, values: Mapping[str, Any]) -> None:
        self._values = values

    @overload
    def __getitem__(self, key: "Register[T]") -> T: ...
    @overload
    def __getitem__(self, key: str) -> Any: ...
    def __getitem__(self, key: "Register[Any] | str") -> Any:
        value = self._values[key if isinstance(key, str) else key.path]
        if isinstance(value, RegscribeError):
            raise value
        return value

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    @property
    def entries(self) -> dict[str, Any]:
        """Values and errors as they are, by path."""
        return dict(self._values)

    @property
    def errors(self) -> dict[str, RegscribeError]:
        """The registers that hold no value, with why."""
        return {path: value for path, value in self._values.items() if isinstance(value, RegscribeError)}

    def renamed(self, names: Mapping[str, str]) -> "Snapshot":
        """The same values under other paths."""
        return Snapshot({names[path]: value for path, value in self._values.items()})

    def __repr__(self) -> str:
        shown = ", ".join(f"{path}={value!r}" for path, value in self._values.items())
        return f"Snapshot({shown})"
