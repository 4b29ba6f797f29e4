"""What the own driver makes of a device: the value of each register in each view, and the requests of its writes."""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import pairwise
from math import isclose
from typing import Any

from independent.families import Family, column, steering
from independent.stage import Stage, service, staged
from independent.ways import own_link
from regscribe.model import Kind, Order, Register, View
from regscribe.simulate import SimulatedDevice
from regscribe_runtime.errors import ExceptionAnswer, Saturated, SensorFault, ValueNotDecodable, ValueRefused

FINE = 1e-6
"""A float32 has seven digits; mbpoll shows six, and is compared with one digit less."""

ENOUGH = 3
"""Registers that are written for each kind of a family."""


@dataclass(frozen=True, slots=True)
class Case:
    """A write that the own driver made: register and view, the number that is sent, and the request with all its bytes.

    `number` is the number on the wire, `value` what it means to a program.
    """

    path: str
    view: str
    column: str
    address: int
    function: int
    words: tuple[int, ...]
    pdu: bytes
    number: float
    value: Any


@cache
def readings(family: Family) -> dict[tuple[str, str], Any]:
    """Return what the driver reads, by register and view; an error where the words are no value."""
    with staged(family.device(), service("tcp")) as stage, family.driver(own_link(stage), stage.device.unit) as driver:
        return {
            (register.path, view.name): _read(driver, register.path, view.name)
            for register in stage.device.model.registers
            if register.access.readable
            for view in register.views
        }


def agrees(
    device: SimulatedDevice, register: Register, view: View, number: float | str, said: Any, fine: float
) -> bool:
    """Tell whether `number`, as a client read it from the view, means what the driver says."""
    if isinstance(number, str):
        return str(said) == _unswapped(number, view).rstrip("\0 ")
    if isinstance(said, ValueNotDecodable):
        ends = {view.type.minimum, view.type.maximum}
        faults = {each.stored * view.factor for each in register.sentinels}
        return isinstance(said, Saturated | SensorFault) and (number in ends or Fraction(number) in faults)
    if register.kind is Kind.VERSION:
        return int(said.replace(".", "")) == number
    if register.kind not in {Kind.NUMBER, Kind.INTEGER, Kind.RAW}:
        return int(said) == number
    use = device.state.to_value(register, Fraction(number) / view.factor)
    meant = next((each.means for each in register.specials if each.code == use and each.means is not None), use)
    return isclose(float(said), float(meant), rel_tol=fine, abs_tol=1e-9)


@cache
def written(family: Family) -> tuple[Case, ...]:
    """Return writes that the driver makes on a fresh device: some for each kind and view of the family."""
    device = family.device()
    with staged(device, service("tcp")) as stage, family.driver(own_link(stage), device.unit) as driver:
        cases: dict[str, list[Case]] = {}
        for register in _harmless(device):
            for view in register.views:
                swapped = device.state.order(view).words is Order.LITTLE
                name = column(register, view.space, view.type, view.name, swapped=swapped)
                if (case := _write(stage, driver, register, view, name)) is not None:
                    cases.setdefault(f"{register.kind} {name}", []).append(case)
        return tuple(case for alike in cases.values() for case in _some(alike))


def _some(alike: list[Case]) -> list[Case]:
    """Return a few, two of them side by side where there are such."""
    beside = [pair for pair in pairwise(alike) if pair[1].address == pair[0].address + len(pair[0].words)]
    first = list(beside[0]) if beside else []
    return [*first, *(case for case in alike if case not in first)][:ENOUGH]


def _harmless(device: SimulatedDevice) -> Iterator[Register]:
    """Yield registers that can be written without a key, a condition or consequences for others."""
    fixed = steering(device.model)
    for register in device.model.registers:
        tied = register.danger or register.unlock or register.writable or register.rescales or register.path in fixed
        if register.access.writable and register.access.readable and not tied:
            yield register


def _read(driver: Any, path: str, view: str) -> Any:
    try:
        return bound(driver, path).read(view=view)
    except ValueNotDecodable as error:
        return error


def bound(driver: Any, path: str) -> Any:
    """Return the register of a driver by its path: `segments[3].soak_level`."""
    part = driver
    *owners, last = path.split(".")
    for owner in owners:
        name, _, index = owner.partition("[")
        part = getattr(part, name)[int(index.rstrip("]"))] if index else getattr(part, name)
    return getattr(part, last)


def _write(stage: Stage, driver: Any, register: Register, view: View, name: str) -> Case | None:
    """Try values until the driver writes one; put the device back as it was."""
    state = stage.device.state
    before = state.stored(register.path)
    writer = bound(driver, register.path)
    for value in _candidates(stage.device, register):
        stage.requests.clear()
        try:
            writer.write(value, view=view.name, confirm=True)
        except (ValueRefused, ExceptionAnswer):
            continue
        pdu = next((one for one in stage.writes() if int.from_bytes(one[1:3], "big") == view.address(register.at)), b"")
        words = stage.device.peek_words(register.path, view.name)
        stored = state.stored(register.path)
        if not pdu or isinstance(stored, str) or stored == before:
            continue
        state.store(register.path, before)
        number = float(stored * view.factor)
        return Case(register.path, view.name, name, view.address(register.at), pdu[0], words, pdu, number, value)
    state.store(register.path, before)
    return None


def _candidates(device: SimulatedDevice, register: Register) -> Iterator[Any]:
    present = device.peek(register.path)
    if register.enum is not None:
        yield from (each.code for each in register.enum.members if each.code != present)
    elif register.kind is Kind.BOOLEAN:
        yield present == 0
    else:
        yield from (value for value in (150.5, 15, 5, 60, 1, 0.5, 1.25, 2, 0.25, -7) if value != present)


def _unswapped(text: str, view: View) -> str:
    if view.byte_order is Order.BIG:
        return text
    return "".join(second + first for first, second in zip(text[::2], text[1::2], strict=True))
