"""The result of reading several registers at once."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeVar, overload

from regscribe_runtime.errors import RegscribeError
from regscribe_runtime.operations.decode_block import PreparedBlock
from regscribe_runtime.registers.register import Register

T = TypeVar("T")
Answers = tuple[tuple["PreparedBlock", "Sequence[int | None]"], ...]
"""Requests that were sent, and the words that came (None where none could be read)."""


class Snapshot(Mapping[str, Any]):
    """Values by register path; looking up a register without a value raises its error.

    That is ValueNotDecodable (SensorFault, Saturated, OutOfRange, NotDecodable), or Absent if this unit does not have
    the register.
    With a register of the driver's class as key the value is typed: `snapshot[Athena16C.process_value]`.
    """

    def __init__(self, values: Mapping[str, Any], answers: Answers = ()) -> None:
        self._values = values
        self.answers = answers

    @overload
    def __getitem__(self, key: Register[T]) -> T: ...
    @overload
    def __getitem__(self, key: str) -> Any: ...
    def __getitem__(self, key: Register[Any] | str) -> Any:
        value = self._values[key if isinstance(key, str) else key.path]
        if isinstance(value, RegscribeError):
            raise value
        return value

    def __contains__(self, key: object) -> bool:
        """Whether a register was read, with a value or without."""
        return getattr(key, "path", key) in self._values

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    @property
    def entries(self) -> dict[str, Any]:
        """Values and errors by path."""
        return dict(self._values)

    @property
    def valid(self) -> dict[str, Any]:
        """The values, by path, without errors."""
        return {path: value for path, value in self._values.items() if not isinstance(value, RegscribeError)}

    @property
    def errors(self) -> dict[str, RegscribeError]:
        """The errors, by path, of the registers without a value."""
        return {path: value for path, value in self._values.items() if isinstance(value, RegscribeError)}

    @property
    def words(self) -> dict[str, tuple[int, ...]]:
        """The words that each register was read from, by its path in the device, also where they are no value."""
        found: dict[str, tuple[int, ...]] = {}
        for block, words in self.answers:
            for register, view, start in block.placed:
                there = tuple(word for word in words[start : start + view.words] if word is not None)
                if len(there) == view.words:
                    found[register.path] = there
        return found

    def __repr__(self) -> str:
        shown = ", ".join(f"{path}={value!r}" for path, value in self._values.items())
        return f"Snapshot({shown})"
