"""Reads several registers in few requests, as plain values with the present unit of each."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

from regscribe.model.address_text import AddressReading
from regscribe.tools.live.names import Excerpt, Readable
from regscribe.tools.live.value_text import Plain, as_text, is_number, part_of, show, text_of
from regscribe_runtime import (
    Computed,
    ExceptionAnswer,
    Flags,
    NotPresent,
    OutOfRange,
    Register,
    RegscribeError,
    Snapshot,
    Word,
)
from regscribe_runtime.errors import ValueNotDecodable
from regscribe_runtime.operations import tasks
from regscribe_runtime.operations.compute import computed
from regscribe_runtime.operations.read import NO_VALUE, know
from regscribe_runtime.operations.session import Operation, Session, Task
from regscribe_runtime.registers.presence import missing
from regscribe_runtime.values.conditions import choose, registers_of
from regscribe_runtime.values.wire_types import Space
from regscribe_runtime.wire.requests import Request


class RegisterReading(NamedTuple):
    """A value of a register or a computed one: plain, as `text` for people, with its `unit`; or the `error` instead.

    `absent` are the flags and parts that it shows nothing of, each with the reason.
    """

    name: str
    value: Plain | None
    text: str
    unit: str
    error: RegscribeError | None
    absent: Mapping[str, str] = MappingProxyType({})

    @property
    def spelled(self) -> str:
        """For people: the value with its unit, or why there is none."""
        if self.error is not None:
            return f"({reason(self.error, self.name)})"
        return f"{self.text} {self.unit}".rstrip() + without(self.absent)


def readings(wanted: Sequence[Readable]) -> Task[tuple[RegisterReading, ...]]:
    """Read registers and computed values in few requests, each with its present unit."""

    def task(session: Session) -> Operation[tuple[RegisterReading, ...]]:
        along = {path for one in wanted if isinstance(one, Computed) for path in one.needs}
        asked = [one for one in wanted if isinstance(one, Register)]
        asked += [one.register for one in wanted if isinstance(one, Excerpt) and not one.view]
        asked += [session.registers[path] for path in sorted(along)]
        snapshot = yield from read_with(asked, shown_needs)(session)
        found = []
        for one in wanted:
            if isinstance(one, Excerpt) and one.view:
                found.append((yield from _in_view(session, one)))
            else:
                found.append(_reading(one, snapshot, session.givens))
        return tuple(found)

    return task


def word_at(place: AddressReading) -> Task[tuple[int, ...]]:
    """Read the word (or the bit) at an address, whatever it is."""

    def task(session: Session) -> Operation[tuple[int, ...]]:
        space = place.space or Space.HOLDING
        return (yield from session.exchange(Request(space.read_function, place.address)))

    return task


def _in_view(session: Session, one: Excerpt) -> Operation[RegisterReading]:
    """A register in another view than the one that it is read in by name."""
    try:
        value = yield from tasks.read(one.register, one.view)(session)
        needed = yield from tasks.read_many([session.registers[path] for path in shown_needs(one.register)])(session)
    except (ExceptionAnswer, *NO_VALUE) as error:
        return RegisterReading(one.path, None, "", "", error)
    return _shown(one.path, one.register, value, needed.valid, session.givens)


def _reading(one: Readable, snapshot: Snapshot, givens: Mapping[str, Any]) -> RegisterReading:
    if isinstance(one, Excerpt):
        return _part(one, snapshot, givens)
    unit = one.unit if isinstance(one, Computed) else unit_of(one, snapshot.valid, givens)
    try:
        if isinstance(one, Computed):
            number = computed(one, snapshot.entries, givens)
            return RegisterReading(one.path, number, text_of(number), unit, None)
        value = snapshot[one.path]
    except RegscribeError as error:
        return RegisterReading(one.path, None, "", unit, error)
    return _shown(one.path, one, value, snapshot.valid, givens)


def _part(one: Excerpt, snapshot: Snapshot, givens: Mapping[str, Any]) -> RegisterReading:
    """One flag or field of a word that was read."""
    try:
        value = snapshot[one.register.path]
        gone = missing(one.register.path, one.register.partial, snapshot.valid, givens)
        if isinstance(value, Flags) and one.part in gone:
            raise gone[one.part]
        plain = part_of(one.register, value, one.part)
    except RegscribeError as error:
        return RegisterReading(one.path, None, "", "", error)
    return RegisterReading(one.path, plain, text_of(plain), "", None)


def _shown(
    name: str,
    register: Register[Any],
    value: Any,  # noqa: ANN401 - of any register
    state: Mapping[str, Any],
    givens: Mapping[str, Any],
) -> RegisterReading:
    absent = left_out(register, value, state, givens)
    plain = show(register, value, absent)
    unit = unit_of(register, state, givens) if is_number(plain) else ""
    return RegisterReading(name, plain, as_text(register, value, absent), unit, None, absent)


def left_out(
    register: Register[Any],
    value: Any,  # noqa: ANN401 - of any register
    state: Mapping[str, Any],
    givens: Mapping[str, Any],
) -> dict[str, str]:
    """The flags and parts of which a value shows nothing, each with the reason."""
    errors: Mapping[str, object] = {}
    if isinstance(value, Word):
        errors = {name: part for name, part in value if isinstance(part, NotPresent | OutOfRange)}
    elif isinstance(value, Flags):
        errors = missing(register.path, register.partial, state, givens)
    return {name: str(error).partition(": ")[2] for name, error in errors.items()}


def without(absent: Mapping[str, str]) -> str:
    """For people, behind a value: what it shows nothing of, and why; empty where it is whole."""
    return f" (without {'; without '.join(f'{name}: {why}' for name, why in absent.items())})" if absent else ""


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


def shown_needs(register: Register[Any]) -> tuple[str, ...]:
    """The registers that decide the unit of a register, and which of its parts exist."""
    return (*unit_needs(register), *registers_of(register.partial))


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
