"""Reads several registers in few requests, as plain values with the present unit of each."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from regscribe.tools.live.names import Readable
from regscribe.tools.live.value_text import Plain, as_text, is_number, show, text_of
from regscribe_runtime import Computed, Register, RegscribeError, Snapshot
from regscribe_runtime.errors import ValueNotDecodable
from regscribe_runtime.operations import tasks
from regscribe_runtime.operations.compute import computed
from regscribe_runtime.operations.read import know
from regscribe_runtime.operations.session import Operation, Session, Task
from regscribe_runtime.values.conditions import choose, registers_of


class RegisterReading(NamedTuple):
    """A value of a register or a computed one: plain, as `text` for people, with its `unit`; or the `error` instead."""

    name: str
    value: Plain | None
    text: str
    unit: str
    error: RegscribeError | None

    @property
    def spelled(self) -> str:
        """For people: the value with its unit, or why there is none."""
        if self.error is not None:
            return f"({reason(self.error, self.name)})"
        return f"{self.text} {self.unit}".rstrip()


def readings(wanted: Sequence[Readable]) -> Task[tuple[RegisterReading, ...]]:
    """Read registers and computed values in few requests, each with its present unit."""

    def task(session: Session) -> Operation[tuple[RegisterReading, ...]]:
        along = {path for one in wanted if isinstance(one, Computed) for path in one.needs}
        asked = [one for one in wanted if isinstance(one, Register)]
        asked += [session.registers[path] for path in sorted(along)]
        snapshot = yield from read_with(asked, unit_needs)(session)
        return tuple(_reading(one, snapshot, session.givens) for one in wanted)

    return task


def _reading(one: Readable, snapshot: Snapshot, givens: Mapping[str, Any]) -> RegisterReading:
    unit = one.unit if isinstance(one, Computed) else unit_of(one, snapshot.valid, givens)
    try:
        plain, text = _value(one, snapshot, givens)
    except RegscribeError as error:
        return RegisterReading(one.path, None, "", unit, error)
    return RegisterReading(one.path, plain, text, unit if is_number(plain) else "", None)


def _value(one: Readable, snapshot: Snapshot, givens: Mapping[str, Any]) -> tuple[Plain, str]:
    """A value, plain and as text; raises the error of one that there is not."""
    if isinstance(one, Computed):
        number = computed(one, snapshot.entries, givens)
        return number, text_of(number)
    value = snapshot[one.path]
    return show(one, value), as_text(one, value)


def read_with(registers: Iterable[Register[Any]], needs: Callable[[Register[Any]], Iterable[str]]) -> Task[Snapshot]:
    """Read registers in few requests, and with each those that it `needs`."""
    wanted = {register.path: register for register in registers}
    needed = sorted({path for register in wanted.values() for path in needs(register)})

    def task(session: Session) -> Operation[Snapshot]:
        others = {path: session.registers[path] for path in needed}
        return (yield from tasks.read_many(list((wanted | others).values()))(session))

    return task


def held_of(register: Register[Any], value: Any, view: str | None) -> Task[Any]:  # noqa: ANN401 - of any register
    """The value that a device will hold once `value` is written in `view`, rounded to what that view can carry.

    Nothing is written; registers that decide the scale are read. Raises what encoding raises.
    """

    def task(session: Session) -> Operation[Any]:
        chosen = register.write_view(view)
        state = {
            **(yield from know(session, register.needs(chosen))),
            **(yield from know(session, register.limit_needs)),
        }
        words = register.encode(value, view=chosen.name, state=state, givens=session.givens, rounded=True)
        try:
            return register.decode(words, view=chosen.name, state=state, givens=session.givens)
        except ValueNotDecodable:  # the end of the view's range, which reading takes for "this or beyond"
            return value

    return task


def unit_needs(register: Register[Any]) -> tuple[str, ...]:
    """The registers that decide the unit of a register."""
    return registers_of(register.unit)


def unit_of(register: Register[Any], state: Mapping[str, Any], givens: Mapping[str, Any]) -> str:
    """The unit under the values in `state`; "" where it has none, or where they do not decide it."""
    if not set(unit_needs(register)) <= set(state):
        return ""
    return choose(register.unit, state, givens) or ""


def reason(error: RegscribeError, name: str) -> str:
    """The text of an error, without the name of its register."""
    return str(error).removeprefix(f"{name}: ")
