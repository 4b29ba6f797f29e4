"""The changes of a `configure`: all values are checked before anything is sent, each in the state as it will be."""

from __future__ import annotations

import copy
from collections.abc import Iterable, Mapping, Sequence
from difflib import get_close_matches
from typing import Any, NamedTuple

from regscribe_runtime.errors import ConditionNotMet, ExceptionAnswer, NotPresent, ValueRefused, ValuesRefused
from regscribe_runtime.operations.line_change import check_unit
from regscribe_runtime.operations.read import absences, know
from regscribe_runtime.operations.read_back import (
    RegisterWrite,
    Target,
    holds,
    in_view,
    meaning,
    read_back_needs,
    words_of,
)
from regscribe_runtime.operations.session import Operation, Session
from regscribe_runtime.operations.write_order import needs, order
from regscribe_runtime.operations.write_request import check_condition, check_confirmation
from regscribe_runtime.registers import codec
from regscribe_runtime.registers.presence import absence
from regscribe_runtime.registers.register import Register
from regscribe_runtime.report import Change, Fate, Words
from regscribe_runtime.values.conditions import registers_of
from regscribe_runtime.values.views import View

SUGGESTED = 3
"""Most paths that a message suggests for a misspelt one."""


class Assignment:
    """A register and the value to write."""

    __slots__ = ("register", "value")

    def __init__(self, register: Register[Any], value: Any) -> None:
        self.register, self.value = register, value

    @property
    def view(self) -> View:
        """The view in which it is written; ValueError if there is none."""
        return self.register.write_view()


class Present(NamedTuple):
    """What the device holds: values by path that others depend on, and the words of the registers to write."""

    state: dict[str, Any]
    words: dict[str, Words]


def named(session: Session, values: Iterable[Any]) -> list[Register[Any]]:
    """The registers of the device that the keys of `values` name."""
    paths = (key if isinstance(key, str) else getattr(key, "register", key).path for key in values)
    return [session.declared[path] for path in paths if path in session.declared]


def assignments(session: Session, values: Mapping[Any, Any], gone: Mapping[str, Exception]) -> list[Assignment]:
    """The registers of `values` in the order of writing; ValueRefused for an unknown, a read-only or an absent one."""
    refusals: list[ValueRefused] = []
    found: dict[str, Assignment] = {}
    for key, value in values.items():
        try:
            register = _register(session, key, gone)
            found[register.path] = Assignment(register, value)
        except ValueRefused as refusal:
            refusals.append(refusal)
    _raise_all(refusals)
    return [found[register.path] for register in order(session, [one.register for one in found.values()])]


def _raise_all(refusals: Sequence[ValueRefused]) -> None:
    if len(refusals) == 1:
        raise refusals[0]
    if refusals:
        raise ValuesRefused(refusals)


def _register(session: Session, key: Any, gone: Mapping[str, Exception]) -> Register[Any]:
    declared: Register[Any] | None = None if isinstance(key, str) else getattr(key, "register", key)
    path = declared.path if declared else key
    register = session.registers.get(path)
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
    if path in gone:
        raise ValueRefused(path, str(gone[path]).removeprefix(f"{path}: "))
    return register


def read_present(session: Session, chosen: Sequence[Assignment]) -> Operation[Present]:
    """Read the registers to write, and those that the checks depend on."""
    session.forget()
    paths = [
        path for one in chosen for path in (*needs(one.register, one.view), *read_back_needs(one.register, one.view))
    ]
    gone = yield from absences(session, [*paths, *(one.register.path for one in chosen)])
    state = dict((yield from know(session, [path for path in paths if path not in gone], fresh=True)))
    here = [one for one in chosen if one.register.path not in gone]
    held = {one.register.path: (one.register, one.view) for one in here if one.register.can_be_checked}
    found = yield from _words(session, tuple(held.values()))
    words = {path: in_view(target, found[path], state, session.givens) for path, target in held.items()}
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
    _raise_all(refusals)
    return found


def plan_changes(
    session: Session, chosen: Iterable[Assignment], present: Present, *, rounded: bool, confirm: bool = True
) -> list[Change]:
    """The changes that bring the device to the values; ValueRefused (all together) if it cannot take them.

    A dangerous write without `confirm` is refused, unless the device holds the value already.

    Each is checked in the state that those before it leave; `present.state` is that after the last one then. Limits
    that the device converts when the unit of measure changes are not known yet: they are checked when it has.
    """
    refusals: list[ValueRefused] = []
    changes: list[Change] = []
    converted: set[str] = set()
    for one in chosen:
        register, view, state = one.register, one.view, present.state
        before = present.words.get(register.path)
        try:
            _check_present(session, register, state)
            check_condition(register, state, session.givens)
            limited = not converted.intersection(register.limit_needs)
            words = encoded(session, one, present, rounded=rounded, limited=limited)
            planned = RegisterWrite(register, view, words, state)
            check_unit(session, planned)
            fate = Fate.EQUAL if holds(planned, before, session) else Fate.PLANNED
            check_confirmation(register, confirm=confirm or fate is Fate.EQUAL)
        except ValueRefused as refusal:
            refusals.append(refusal)
            continue
        was = meaning(register, view, before, state, session)
        sent = before if before is not None and fate is Fate.EQUAL else words
        changes.append(Change(register.path, view.name, before, sent, was, one.value, fate))
        if register.rescales and fate is not Fate.EQUAL:  # the device converts what is in this unit of measure
            others = session.registers.items()
            converted |= {path for path, other in others if register.path in registers_of(other.unit)}
        converted.discard(register.path)
        value = planned.value(session, named=False)
        state[register.path] = one.value if value is None else value
    _raise_all(refusals)
    return changes


def _check_present(session: Session, register: Register[Any], state: Mapping[str, Any]) -> None:
    """Refuse a register that does not exist in the state in which it would be written."""
    lacking = {path: NotPresent(path, "", {}) for path in register.when.registers if path not in state}
    gone = absence(register.path, register.when, state, session.givens, lacking)
    if isinstance(gone, NotPresent):
        raise ConditionNotMet(register.path, f"it exists only while {gone.condition}", gone.present)
    if gone:
        raise ValueRefused(register.path, str(gone))


def encoded(session: Session, one: Assignment, present: Present, *, rounded: bool, limited: bool = True) -> Words:
    """The words of a value, with limits checked if `limited`; unnamed bits may be set where the device has them set."""
    register, kept = one.register, 0
    if not limited:
        register = copy.copy(register)
        register.range = register.valid = ()
    if register.kind in codec.PATTERNS and isinstance(one.value, int):
        held = meaning(register, one.view, present.words.get(register.path), present.state, session)
        idle = 0 if held is None else codec.idle_bits(register, held, present.state, session.givens)
        kept = int(one.value) & idle
    return codec.encode(register, one.view, one.value, present.state, session.givens, rounded=rounded, kept=kept)
