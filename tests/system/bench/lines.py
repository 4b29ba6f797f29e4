"""A full read of a model at 9600 baud, on a pty that lets bytes take their time: whole seconds of a real line.

Against one register after the other with minimalmodbus, and against a reader that bridges gaps of a fixed size, which
sends its requests over the same link as the driver. The simulated device answers at once, so that only the line counts:
with the manuals' latencies the distance is larger still, and a run would take minutes.
"""

import contextlib
import time
from collections.abc import Iterator
from typing import Any

import minimalmodbus
from measure import Row, at_least
from planning import subjects
from rivals import Task, fixed_gap

from regscribe.cli.shared.map_arguments import find_map
from regscribe.model import GivenKind
from regscribe.pipeline import compile_map
from regscribe.planned_model import PlannedModel
from regscribe.simulate import SerialLine, simulate
from regscribe.tools.live import catalogue
from regscribe_runtime import RegscribeError
from regscribe_runtime.link.connect import serial
from regscribe_runtime.planning.address_ranges import RegisterSpan
from regscribe_runtime.planning.cost import Cost
from regscribe_runtime.planning.read_places import read_places
from regscribe_runtime.wire.requests import Request

BAUD = 9600
GAP = 10
"""A usual choice of readers with one setting for it."""
NO_WORSE = 0.9
"""Our plans count the latency of the device, too, which is off here, and clocks are noisy."""
FEW = ("fdc/series-100:C21", "athena/series-c:16C", "athena/platinum-x5000:X5000")
"""What a run without --full measures: the smallest, one in the middle, the largest."""


def rows(*, every: bool = False) -> Iterator[Row]:
    """A row a model for each rival."""
    for _, subject in subjects():
        known = catalogue.find(f"{subject.model.class_name}")
        name = catalogue.full_name(known)
        if every or name in FEW:
            yield from _model(name, known, subject)


def _model(name: str, known: Any, subject: PlannedModel) -> Iterator[Row]:
    register_map = compile_map(find_map(known.map_id)).map
    assert register_map is not None
    givens: dict[str, Any] = {
        one.id: frozenset({4}) if one.kind is GivenKind.CODES else True for one in register_map.givens
    }
    with simulate(
        register_map, known.model, givens=givens, transport="pty", line=SerialLine(baud=BAUD), paced=True
    ) as running:
        unit = running.device.unit
        ours = _driver(known.driver, running.path, unit, givens)
        gap = _fixed_gap(subject, running.path, unit)
        single = _one_by_one(subject, running.path, unit)
    what = f"{name}, {len(subject.readable)} registers, 9600 baud"
    yield _row(f"{what} (gaps of {GAP} words)", ours, gap, NO_WORSE)
    yield _row(f"{what} (minimalmodbus, one by one)", ours, single, 1)


def _row(what: str, ours: float, theirs: float, budget: float) -> Row:
    return at_least(what, f"{ours:.2f} s", f"{theirs:.2f} s", theirs / ours, budget)


def _driver(driver: Any, path: str, unit: int, givens: dict[str, Any]) -> float:
    with driver(serial(path, baud=BAUD), unit=unit, **givens) as device:
        device.read()  # what it remembers between reads is not part of a read
        start = time.perf_counter()
        device.read()
        return time.perf_counter() - start


def _items(subject: PlannedModel) -> list[RegisterSpan]:
    return list(dict.fromkeys(read_places(subject.registers[path])[0].span for path in subject.readable))


def _fixed_gap(subject: PlannedModel, path: str, unit: int) -> float:
    terms = subject.terms(Cost.serial(subject.protocol, baud=BAUD))
    items = _items(subject)
    requests = fixed_gap(Task.of(items, items, terms), GAP)
    link = serial(path, baud=BAUD)
    link.open()
    try:
        start = time.perf_counter()
        for one in requests:
            link.call(unit, Request(one.space.read_function, one.address, one.words))
        return time.perf_counter() - start
    finally:
        link.close()


def _one_by_one(subject: PlannedModel, path: str, unit: int) -> float:
    instrument = minimalmodbus.Instrument(path, unit)
    instrument.serial.baudrate, instrument.serial.timeout = BAUD, 2
    try:
        start = time.perf_counter()
        for one in _items(subject):
            with contextlib.suppress(minimalmodbus.ModbusException, RegscribeError):
                _read(instrument, one)
        return time.perf_counter() - start
    finally:
        instrument.serial.close()


def _read(instrument: Any, one: RegisterSpan) -> None:
    function = one.space.read_function
    if one.space == "status":
        return  # minimalmodbus has no function 07: the comparison is in its favour
    if one.space in {"coil", "discrete"}:
        instrument.read_bits(one.address, one.words, functioncode=function)
    else:
        instrument.read_registers(one.address, one.words, functioncode=function)
