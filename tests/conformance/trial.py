"""One random map on trial: driver, reference and simulator are given the same words and values, and must agree."""

import random
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from math import isfinite
from typing import Any

from regscribe.model import NotANumber, Register, Special, View, WireType
from regscribe.model.located import layout_of, located
from regscribe.reference import (
    Meaning,
    Reading,
    RefusalReason,
    RefusedError,
    Surroundings,
    UnknownValueError,
    decode,
    encode,
    holds,
    present_view,
    special_value,
    transmit,
    wire_number,
    word_order,
)
from regscribe.simulate.device import codec as simulated_codec
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.testing.driver_checks import CHECKS
from regscribe_runtime import ExceptionAnswer, NotPresent, ValueNotDecodable, ValueRefused
from regscribe_runtime.operations.write_request import condition_needs
from regscribe_runtime.registers.octets import OctetType

from . import judges, probes
from .matrix_watch import Wire
from .probes import Words
from .suite import Built
from .wire import Memory

Value = Fraction | str | Special
"""What is written: a number of use, a text, or a special value by its name."""
EXCEPTION = 0x80
ABSENT = {"absent": True}
"""What a register is that does not exist now."""
LIKELY = 0.8
"""How often a register holds what one is likely to hold; else anything."""
FEW = 8
"""How many words and how many values are tried of all that are worth it."""


class Asked:
    """The words of a simulated device, as a master gets them."""

    def __init__(self, device: SimulatedDevice, views: dict[tuple[str, int], tuple[Register, View]]) -> None:
        self._device, self._views = device, views

    def get(self, space: str, address: int, count: int) -> list[int]:
        """The words of the view at an address."""
        found = judges.ask(self._device, *self._views[space, address])
        assert len(found) == count
        return found


class Trial:
    """A map, its driver on a device of nothing but words, and its driver on a simulated device."""

    def __init__(self, built: Built, chance: random.Random) -> None:
        layout = layout_of(built.map, built.map.models[0], {})
        model = located(built.map.models[0], layout)
        self.declared, self.chance = built, chance
        self.built = built._replace(map=replace(built.map, models=(model,)))  # with addresses of registers in blocks
        self.registers = model.registers
        self.memory = Memory()
        for (space, address), word in layout.words.items():
            self.memory.put(space.value, address, [word])
        self.plain = built.module.CaseA(Wire(self.memory.answer), unit=1)
        self.device = SimulatedDevice(built.map, "A", unit=1)
        self.driver = built.module.CaseA(Wire(self.device.handle), unit=1)
        views = {(view.space.value, view.address(one.at)): (one, view) for one in self.registers for view in one.views}
        self.asked = Asked(self.device, views)

    def differences(self) -> Iterator[str]:
        """Everything that one says otherwise than another."""
        yield from self._of_vectors()
        yield from self._of_defaults()
        self.hold()
        yield from self._of_snapshot()
        some = self.chance.sample(self.registers, min(len(self.registers), FEW))
        for register in some:
            for view in register.views:
                yield from (f"{register.path}, {view.name}: {one}" for one in self._of_view(register, view))

    # -- what the devices hold ----------------------------------------------------------------------------------

    def hold(self) -> None:
        """Let every register hold some words: those of a plausible value, or any."""
        for register in self.registers:
            likely = probes.plausible(register.base) if self.chance.random() < LIKELY else ()
            self._put(register, register.base, self.chance.choice(likely or self.words(register, register.base)))

    def _put(self, register: Register, view: View, words: Words) -> None:
        """Put words into the view of the one device, and what they mean into the other; all views of both agree."""
        stored = self._stored(register, view, words)
        if stored is not None:
            self.device.state.store(register.path, stored)
        for each in register.views:
            shown = self.device.peek_words(register.path, each.name)
            self.memory.put(each.space.value, each.address(register.at), list(shown))
        self.memory.put(view.space.value, view.address(register.at), list(words))
        base = register.base
        for alias in register.aliases:
            self.memory.put(base.space.value, alias, self.memory.get(base.space.value, register.address, base.words))

    def _stored(self, register: Register, view: View, words: Words) -> Fraction | NotANumber | str | None:
        """What a device holds whose view shows the words; None for words that nothing stored is shown by."""
        if view.type.is_octets:
            return simulated_codec.decode(self.device.state.seen(view), words, self.device.state.order(view))
        try:
            seen, order = present_view(view, self._known(self.asked)), word_order(view, self._known(self.asked))
        except UnknownValueError:
            return None
        number = None if order is None or seen is None else wire_number(view, words, order)
        if isinstance(number, NotANumber):
            shown = all(one.type.is_float for one in register.views)
            return number if shown and words == transmit(view, number, self._known(self.asked)) else None
        return number and seen and number / seen.factor

    def words(self, register: Register, view: View) -> list[Words]:
        """Some of the words that are worth trying."""
        words = probes.words(register, view, self.chance)
        return self.chance.sample(words, min(len(words), FEW))

    def _of_vectors(self) -> Iterator[str]:
        """The driver is what the vectors say, as the generated tests ask it."""
        bench = judges.bench_of(self.declared)
        for check in CHECKS:
            try:
                check(bench)
            except AssertionError as error:
                yield f"{check.__name__}: {error}"

    def _of_defaults(self) -> Iterator[str]:
        """A new device reads as the default, and takes it back; where others decide, as far as it can hold it now."""
        for register in self.registers:
            if register.default is None or not register.access.readable:
                continue
            view = register.read_view
            if self._encoded(register, view, register.default, self.asked) == judges.REFUSED:
                if register.writable is None and not self._needs(register, view):
                    yield f"{register.path}: its default {register.default} may not be written"
                continue
            found = self._driver_reads(self.driver, register, view)
            declared = self.driver.registers[register.path].default
            if not (same(found, register.default) and declared == found):
                yield f"{register.path} of a new device reads {found!r}, its default is {declared!r}"

    # -- reading ------------------------------------------------------------------------------------------------

    def _of_snapshot(self) -> Iterator[str]:
        for device, memory in ((self.plain, self.memory), (self.driver, self.asked)):
            device.session.forget()
            for path, value in device.read().entries.items():
                register = self.built.map.models[0].register(path)
                found = self._entry(path, value)
                expected = self._reading(register, register.read_view, memory)
                if not same(found, expected) and not any(same(found, one) for one in self._elsewhere(register, memory)):
                    yield f"{path} among all: driver {found!r}, reference {expected!r}"

    @staticmethod
    def _entry(path: str, value: Any) -> object:
        if isinstance(value, NotPresent):
            return ABSENT
        return judges.said_by_error(value, path) if isinstance(value, ValueNotDecodable) else number_of(value)

    def _elsewhere(self, register: Register, memory: Any) -> Iterator[object]:
        """What views of the same type and factor say: the planner may take any of them."""
        usual = register.read_view
        usual_form = usual.type, usual.factor, usual.times, usual.saturates
        for view in register.views:
            if (view.type, view.factor, view.times, view.saturates) == usual_form:
                yield self._reading(register, view, memory)

    def _of_view(self, register: Register, view: View) -> Iterator[str]:
        for one in self.words(register, view):
            self._put(register, view, one)
            if register.access.readable and any(view.allows(one) for one in (1, 2, 3, 4, 7)):
                yield from self._read(register, view, one)
        if register.access.writable and any(view.allows(one) for one in (5, 6, 16)[2 * (view.words > 1) :]):
            yield from self._written(register, view)

    def _read(self, register: Register, view: View, words: Words) -> Iterator[str]:
        for device, memory in ((self.plain, self.memory), (self.driver, self.asked)):
            device.session.forget()
            expected = self._reading(register, view, memory)
            found = self._driver_reads(device, register, view)
            if not same(found, expected):
                yield f"{words} on {type(memory).__name__}: driver {found!r}, reference {expected!r}"
        yield from self._shown(register, view, words)

    def _driver_reads(self, device: Any, register: Register, view: View) -> object:
        try:
            return number_of(judges.attribute(device, register.path).read(view=view.name))
        except ValueNotDecodable as error:
            return judges.said_by_error(error, register.path)
        except NotPresent:
            return ABSENT

    def _reading(self, register: Register, view: View, memory: Any) -> object:
        try:
            if not holds(register.when, self._known(memory)):
                return ABSENT
            words = tuple(memory.get(view.space.value, view.address(register.at), view.words))
            return said(decode(register, view, words, self._known(memory)))
        except UnknownValueError:
            return {"no value": True}

    def _known(self, memory: Any) -> Surroundings:
        return Surroundings(values=judges.Present(self.built, memory))

    def _shown(self, register: Register, view: View, words: Words) -> Iterator[str]:
        """A simulated device that took words in a view shows in each view what the stored number is there."""
        stored = self._stored(register, view, words)
        if stored is None or isinstance(stored, str) or self._reading(register, view, self.asked) == ABSENT:
            return
        for other in register.views:
            try:
                expected = list(transmit(other, stored, self._known(self.asked)))
            except (RefusedError, UnknownValueError):
                continue  # what a device does with a number that a view cannot carry, no map says
            found = (
                judges.ask(self.device, register, other)
                if any(other.allows(one) for one in (1, 2, 3, 4, 7))
                else expected
            )
            if found != expected:
                yield f"{words} show in {other.name} as {found}, not {expected}"

    # -- writing ------------------------------------------------------------------------------------------------

    def _written(self, register: Register, view: View) -> Iterator[str]:
        values = [*probes.values(register), *(one for one in register.specials if one.means is None)]
        for value in self.chance.sample(values, min(len(values), FEW)):
            yield from self._value_written(register, view, value)
        if register.access.readable and any(view.allows(one) for one in (1, 3)):
            for words in self.words(register, view):
                yield from self._words_written(register, view, words)

    def _encoded(self, register: Register, view: View, value: Value, memory: Any) -> object:
        known = self._known(memory)
        try:
            if isinstance(value, Special):
                value = special_value(register, value, known) or Fraction(0)
            if not _takes(register, known):
                return judges.REFUSED
            return list(encode(register, view, value, known))
        except (RefusedError, UnknownValueError):
            return judges.REFUSED

    def _value_written(self, register: Register, view: View, value: Value) -> Iterator[str]:
        declared = self.plain.registers[register.path]
        given = _given(declared, view, value)
        for device, memory in ((self.plain, self.memory), (self.driver, self.asked)):
            device.session.forget()
            before = self.device.state.stored(register.path)
            expected = self._encoded(register, view, value, memory)
            log = device.link.log
            log.clear()
            try:
                judges.attribute(device, register.path).write(given, view=view.name, verify=False)
            except (ValueRefused, ValueNotDecodable, NotPresent):
                found: object = judges.REFUSED
            except ExceptionAnswer as error:
                found = f"the device refuses: {error}"
            else:
                found = _sent(log)
            self.device.state.store(register.path, before)
            if found == judges.REFUSED and not self._decided(register, view, memory):
                continue  # a driver writes nothing while it cannot tell what decides about it
            if found != expected:
                yield f"writing {value} on {type(memory).__name__}: driver {found!r}, reference {expected!r}"

    def _decided(self, register: Register, view: View, memory: Any) -> bool:
        """Whether everything has a value that may decide about a write."""
        return all(path in judges.Present(self.built, memory) for path in self._needs(register, view))

    def _needs(self, register: Register, view: View) -> set[str]:
        """What decides about the words of a value, and whether it may be written."""
        declared = self.plain.registers[register.path]
        return {*declared.needs(declared.view(view.name)), *declared.limit_needs, *condition_needs(declared)}

    def _words_written(self, register: Register, view: View, words: Words) -> Iterator[str]:
        """A simulated device takes words whose value may be written, and refuses those whose value may not."""
        expected = self._may_take(register, view, words)
        if expected is None:
            return
        before = self.device.state.stored(register.path)
        answer = self.device.handle(_request(register, view, words))
        shown = judges.ask(self.device, register, view) if expected else ()
        self.device.state.store(register.path, before)
        assert answer is not None
        if (answer[0] < EXCEPTION) is not expected:
            yield f"words {words}: the simulator {'refuses' if expected else 'takes'} them"
        elif expected and tuple(shown) != words:
            yield f"words {words} were taken by the simulator, which shows {shown}"

    def _may_take(self, register: Register, view: View, words: Words) -> bool | None:
        """Whether the reference writes just these words for their value; None where the map leaves it to the device."""
        known = self._known(self.asked)
        try:
            if not _takes(register, known):
                return False
            reading = decode(register, view, words, known)
            if reading.meaning is not Meaning.VALUE or reading.value is None:
                return None
            return True if encode(register, view, reading.value, known) == words else None
        except RefusedError as refused:
            return False if refused.reason in {RefusalReason.RANGE, RefusalReason.MEMBER} else None
        except UnknownValueError:
            return None


def _takes(register: Register, known: Surroundings) -> bool:
    """Whether it is there now, and can be written now."""
    return holds(register.when, known) and (register.writable is None or holds(register.writable.when, known))


def _given(declared: Any, view: View, value: Value) -> Any:
    """A value as a program would hand it to a driver: a member, an int, or a float; a fraction where no float is it.

    A float counts as its shortest decimal, but also as what it is exactly, where the view carries just that.
    """
    if isinstance(declared.value_type, OctetType):
        with suppress(ValueError):  # the type has no such value
            return declared.value_type.parse(value)
    if isinstance(value, str):
        return value
    if isinstance(value, Special):
        return declared.value_type.special[value.id]
    near = float(value)
    if value not in (Fraction(near), Fraction(repr(near))):  # 1/3: no float spells it
        return value
    number = int(value) if value.denominator == 1 else near
    with suppress(Exception):  # a kind refuses as it likes what it cannot be
        made = declared.value_type.make(number)
        exactly = not isinstance(made, float) or Fraction(repr(made)) == value or view.type is WireType.FLOAT32
        by_case = len(getattr(declared.value_type, "classes", ())) > 1  # which enum counts is not known here
        if made == number and exactly and not by_case:
            return made
    return number


def _sent(log: Iterable[Any]) -> object:
    writes = [one for one in log if one[1] in {5, 6, 15, 16}]
    return list(writes[-1][4]) if len(writes) == 1 else writes


def _request(register: Register, view: View, words: Words) -> bytes:
    where = view.address(register.at).to_bytes(2, "big")
    if view.space.is_bits:
        return b"\x05" + where + (b"\xff\0" if words[0] else b"\0\0")
    data = b"".join(word.to_bytes(2, "big") for word in words)
    if len(words) == 1 and view.allows(6):
        return b"\x06" + where + data
    return b"\x10" + where + len(words).to_bytes(2, "big") + bytes([len(data)]) + data


def number_of(value: Any) -> object:
    """A value of a driver as a text, or as a number: a float is one of its own."""
    if isinstance(value, (str, *judges.OCTETS)):
        return value if isinstance(value, str) else judges.spelled(value)
    return value if isinstance(value, float) else Fraction(int(value))


def said(reading: Reading) -> object:
    """What the reference says, as drivers say it."""
    if reading.meaning is Meaning.FAULT:
        return {"fault": reading.fault}
    if reading.meaning in {Meaning.VALUE, Meaning.UNKNOWN_MEMBER} and reading.value is not None:
        return reading.value
    return {"no value": True}


def same(found: object, expected: object) -> bool:
    """Whether a driver says what the reference says: the same, or the float nearest to it."""
    if isinstance(found, float) and isinstance(expected, Fraction):
        return isfinite(found) and found == float(expected)
    return found == expected
