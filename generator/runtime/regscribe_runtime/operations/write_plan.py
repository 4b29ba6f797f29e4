"""What is to be written: values checked as a whole before anything is sent, each in the state as it will be then."""

from __future__ import annotations

import copy
from collections.abc import Iterable, Mapping, Sequence
from difflib import get_close_matches
from typing import Any, NamedTuple

from regscribe_runtime.errors import ExceptionAnswer, ValueRefused, ValuesRefused
from regscribe_runtime.operations.line_change import allowed
from regscribe_runtime.operations.read import know
from regscribe_runtime.operations.read_back import Target, in_view, meaning, read_back_needs, words_of
from regscribe_runtime.operations.session import Operation, Session
from regscribe_runtime.operations.write_order import needs, order
from regscribe_runtime.operations.write_request import confirmed, permitted
from regscribe_runtime.registers import codec
from regscribe_runtime.registers.enums import unnamed_bits
from regscribe_runtime.registers.register import Register
from regscribe_runtime.report import Change, Fate, Words
from regscribe_runtime.values.conditions import registers_of
from regscribe_runtime.values.kinds import Access, Kind
from regscribe_runtime.values.views import View

SUGGESTED = 3


class Assignment(NamedTuple):
    """A register and the value that it is to have."""

    register: Register[Any]
    value: Any

    @property
    def view(self) -> View:
        """The view in which it is written."""
        return self.register.write_view()


class Present(NamedTuple):
    """What the device holds: values that others depend on, and the words of what is to be written."""

    state: dict[str, Any]
    words: dict[str, Words]


def wanted(session: Session, values: Mapping[Any, Any]) -> list[Assignment]:
    """The registers of `values` in the order of writing; ValueRefused for names and access."""
    refusals: list[ValueRefused] = []
    found: dict[str, Assignment] = {}
    for key, value in values.items():
        try:
            register = _register(session, key)
            found[register.path] = Assignment(register, value)  # pyright: ignore[reportArgumentType] # a register is a descriptor, but no attribute of this tuple
        except ValueRefused as refusal:
            refusals.append(refusal)
    refuse(refusals)
    return [found[register.path] for register in order(session, [one.register for one in found.values()])]


def refuse(refusals: Sequence[ValueRefused]) -> None:
    """Raise what was refused, all of it together."""
    if len(refusals) == 1:
        raise refusals[0]
    if refusals:
        raise ValuesRefused(refusals)


def _register(session: Session, key: Any) -> Register[Any]:
    declared: Register[Any] | None = None if isinstance(key, str) else getattr(key, "register", key)
    path = declared.path if declared else key
    register: Register[Any] | None = session.registers.get(path)
    if register is None:
        near = get_close_matches(path, session.registers, n=SUGGESTED)
        meant = f": did you mean {' or '.join(near)}?" if near else ""
        raise ValueRefused(path, f"the device has no such register{meant}")
    try:
        register = session.own(declared or register)
    except ValueError as error:
        raise ValueRefused(path, str(error)) from None
    if not register.access.writable:
        raise ValueRefused(path, "the register is read-only")
    return register


def look(session: Session, targets: Iterable[Assignment]) -> Operation[Present]:
    """Read what the checks need and what the registers hold now."""
    chosen = list(targets)
    session.forget()
    paths = [
        path for one in chosen for path in (*needs(one.register, one.view), *read_back_needs(one.register, one.view))
    ]
    state = dict((yield from know(session, paths, fresh=True)))
    held = {one.register.path: (one.register, one.view) for one in chosen if one.register.access is Access.READ_WRITE}
    found = yield from _words(session, tuple(held.values()))
    words = {path: in_view(target, found[path], state) for path, target in held.items()}
    return Present(state, {path: one for path, one in words.items() if one is not None})


def _words(session: Session, targets: Sequence[Target]) -> Operation[dict[str, Words]]:
    """The words of registers; ValueRefused for those that this unit does not have, found one by one."""
    try:
        return (yield from words_of(session, targets))
    except ExceptionAnswer:
        refusals: list[ValueRefused] = []
        found: dict[str, Words] = {}
    for target in targets:
        try:
            found |= yield from words_of(session, [target])
        except ExceptionAnswer as error:
            refusals.append(ValueRefused(target[0].path, f"this unit cannot read it, so it may not have it: {error}"))
    refuse(refusals)
    return found


def intend(
    session: Session, targets: Iterable[Assignment], sight: Present, *, rounded: bool, confirm: bool = True
) -> list[Change]:
    """The changes that bring the device to the values; ValueRefused (all together) if it cannot take them.

    A dangerous write that is not confirmed is refused, too, unless the device holds the value already.

    Each is checked in the state that those before it leave. `sight.state` is that after the last one then. Limits that
    the device converts meanwhile, because the unit of measure changes, are not known yet: they are checked when it has.
    """
    refusals: list[ValueRefused] = []
    changes: list[Change] = []
    converted: set[str] = set()
    for one in targets:
        register, view = one.register, one.view
        try:
            permitted(register, sight.state, session.givens)
            free = converted.intersection(register.limit_needs)
            words = words_of_wanted(session, one, sight, rounded=rounded, limited=not free)
            allowed(session, (register, view), words, sight.state)
            change = _change(session, one, sight, words)
            confirmed(register, confirm=confirm or change.fate is Fate.EQUAL)
        except ValueRefused as refusal:
            refusals.append(refusal)
            continue
        changes.append(change)
        if register.rescales and change.fate is not Fate.EQUAL:
            converted |= dependent(session, register)
        converted.discard(register.path)
        value = meaning(register, view, words, sight.state, session, named=False)
        sight.state[register.path] = one.value if value is None else value
    refuse(refusals)
    return changes


def words_of_wanted(
    session: Session, one: Assignment, sight: Present, *, rounded: bool, limited: bool = True
) -> tuple[int, ...]:
    """The words of a wanted value; bits without a name may be among it where the device has them set already."""
    register = one.register if limited else _unlimited(one.register)
    kept = 0
    if register.kind is Kind.FLAGS and isinstance(one.value, int):
        held = meaning(register, one.view, sight.words.get(register.path), sight.state, session)
        kept = int(one.value) & unnamed_bits(held) if held is not None else 0
    return codec.encode(register, one.view, one.value, sight.state, session.givens, rounded=rounded, kept=kept)


def _change(session: Session, one: Assignment, sight: Present, words: Words) -> Change:
    before = sight.words.get(one.register.path)
    was = meaning(one.register, one.view, before, sight.state, session)
    fate = Fate.EQUAL if before == words else Fate.PLANNED
    return Change(one.register.path, one.view.name, before, words, was, one.value, fate)


def dependent(session: Session, register: Register[Any]) -> set[str]:
    """The registers that the device converts when this one, a unit of measure, is written."""
    return {path for path, other in session.registers.items() if register.path in registers_of(other.unit)}


def _unlimited(register: Register[Any]) -> Register[Any]:
    other = copy.copy(register)
    other.range = ()
    return other
