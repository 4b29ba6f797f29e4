"""Words to values in engineering units and back, in exact arithmetic: the only place where numbers are scaled."""

import math
import struct
import sys
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import partial
from typing import Any, NamedTuple, NoReturn, Protocol, cast

from regscribe_runtime.errors import (
    NotDecodable,
    OutOfRange,
    Saturated,
    SensorFault,
    ValueNotDecodable,
    ValueRefused,
)
from regscribe_runtime.registers.octets import OctetType
from regscribe_runtime.registers.presence import missing
from regscribe_runtime.registers.value_types import FlagsType, ValueType, WordType
from regscribe_runtime.values.conditions import Cases, Givens, State, choose, registers_of
from regscribe_runtime.values.kinds import OCTETS, Kind
from regscribe_runtime.values.numbers import ROUNDINGS, Number, brief, exact, half_up, rough, shortest
from regscribe_runtime.values.orders import OrderCases, WordOrder, gathered, spread
from regscribe_runtime.values.scales import Conversion, Decimals, Limit, Open, Range, Sentinel, in_case
from regscribe_runtime.values.terms import Term, UnsettledError, registers_in, resolve
from regscribe_runtime.values.views import Scaled, View, scale_needs
from regscribe_runtime.values.wire_types import Order, WireType


class Coded(Scaled, Protocol):
    """The part of a register's declaration that encoding and decoding depend on."""

    path: str
    kind: Kind
    value_type: ValueType[Any]


Unknown = Mapping[str, object]
"""Registers without a known value: the reason by path."""

Converter = Callable[[Any], Any]
"""From a number on the wire to a value."""

LARGEST_FLOAT = Fraction(sys.float_info.max)

_NARROW = frozenset({WireType.FLOAT16, WireType.FLOAT32})
"""Floats of which Python's shortest decimal is not theirs."""

PATTERNS = frozenset({Kind.FLAGS, Kind.FIELDS})
"""Kinds whose words are patterns of bits: never negative, whatever the type of the view."""

MAX_DECIMALS = 9
"""Most decimals that a register can state; scaling by more would only hide a fault."""


def power(name: str, decimals: Decimals | None, state: State) -> int:
    """10^d with d from a register; NotDecodable if d is no plausible number of decimals."""
    if decimals is None:
        return 1
    digits = int(state[decimals.register])
    if not 0 <= digits <= MAX_DECIMALS:
        raise NotDecodable(name, f"{decimals.register} is {digits}, which is no number of decimals")
    return int(10 ** (digits if decimals.at_most is None else min(digits, decimals.at_most)))


class Line(NamedTuple):
    """A conversion as things stand: value = `slope` x stored + `offset`."""

    slope: Fraction
    offset: Fraction
    conversion: Conversion

    def value(self, stored: Fraction) -> Fraction:
        """The value of use of a stored number."""
        return self.slope * stored + self.offset

    def stored(self, value: Fraction) -> Fraction:
        """The stored number of a value of use."""
        return (value - self.offset) / self.slope


def settled(register: str, term: Term, state: State, givens: Givens) -> Fraction:
    """The number of a term of a register; NotDecodable where it has none as the device is set."""
    try:
        return resolve(term, state, givens)
    except UnsettledError as error:
        raise NotDecodable(register, str(error)) from None


def present(view: View, register: str, state: State, givens: Givens) -> View:
    """A view with the factor that it has as things stand; NotDecodable where that is no factor."""
    if view.times is None:
        return view
    times = settled(register, view.times, state, givens)
    if times <= 0:
        raise NotDecodable(register, f"its {view.name} view has no factor of {rough(times)}")
    return view._replace(factor=Fraction(view.factor) * times, times=None)


def _line(register: Coded, state: State, givens: Givens) -> Line:
    found = choose(register.scale, state, givens)
    if found is None:
        known = ", ".join(f"{name} = {state[name]}" for name in scale_needs(register))
        raise NotDecodable(register.path, f"no scale of the manual holds with {known}")
    divisor = power(register.path, found.decimals, state)
    multiply, add = (settled(register.path, term, state, givens) for term in (found.multiply, found.add))
    if not multiply:
        known = ", ".join(f"{name} = {state[name]}" for name in registers_in(found.multiply))
        raise NotDecodable(register.path, f"its scale multiplies by 0 with {known}")
    return Line(multiply / divisor, add / divisor, found)


Words = Sequence[int]


def present_order(order: WordOrder | OrderCases, register: str, state: State, givens: Givens) -> WordOrder:
    """The present order of words or bytes; NotDecodable where the manual lists none for what decides."""
    if not isinstance(order, OrderCases):
        return order
    found = choose(order.cases, state, givens)
    if found is None:
        names = registers_of(order.cases)
        known = " and ".join(f"{name} is {state[name]}" for name in names) or "nothing that is given"
        raise NotDecodable(register, f"{known}, which sets no word order" if names else f"{known} sets its order")
    return found


def arranger(view: View, name: str, state: State, givens: Givens, *, sending: bool = False) -> Callable[[Words], Words]:
    """A function from wire order to most-significant-first under the present `state`; back, when `sending`."""
    turned = present_order(view.byte_order, name, state, givens) is Order.LITTLE
    order = present_order(view.order, name, state, givens) if view.words > 1 else Order.BIG
    if order is Order.BIG:
        return _swapped if turned else (lambda words: words)
    arranged = partial(spread if sending else gathered, order)
    return (lambda words: _swapped(arranged(words))) if turned else arranged


def _swapped(words: Words) -> Words:
    return [(word & 0xFF) << 8 | word >> 8 for word in words]


def reader(register: Coded, view: View, state: State, givens: Givens, *, named: bool = True) -> Converter:
    """A function from a wire number of `view` to a value, under the present `state`.

    It raises Saturated, SensorFault, OutOfRange or NotDecodable for numbers that are no values; SensorFault even where
    the scale is unknown. A special value is returned as its enum member; without `named` as its number, as conditions
    compare it.
    """
    try:
        view = present(view, register.path, state, givens)
    except ValueNotDecodable as error:
        return failing(error)
    try:
        convert = _with_specials(register, view, state, givens, named=named)
    except ValueNotDecodable as error:
        convert = failing(error)
    try:
        faults = _faults(register, view, state, givens)
    except ValueNotDecodable as error:
        faults, convert = (), failing(error)
    return _guarded(register, view, convert, faults)


class _Known(dict[str, Any]):
    """A state without unknown registers; looking one up raises NotDecodable for the register that depends on it."""

    def __init__(self, register: Coded, state: State, unknown: Unknown) -> None:
        super().__init__({path: value for path, value in state.items() if path not in unknown})
        self._register, self._unknown = register, unknown

    def __missing__(self, path: str) -> NoReturn:
        why = self._unknown[path]
        raise NotDecodable(self._register.path, f"its meaning depends on {path}: {why}")


def known_state(register: Coded, state: State, unknown: Unknown) -> State:
    """The state for decoding a register; looking up an `unknown` one in it raises NotDecodable."""
    return _Known(register, state, unknown) if unknown else state


def failing(error: ValueNotDecodable) -> Converter:
    """A converter that raises `error`."""

    def fail(_: object) -> NoReturn:
        raise error

    return fail


def same(wire: Any) -> Any:
    """The converter of plain whole numbers; blocks recognise it and do not call it."""
    return wire


def present_type(register: Coded, state: State, givens: Givens) -> ValueType[Any]:
    """The type of a register's values without what does not exist as things stand."""
    if not register.partial:
        return register.value_type
    return register.value_type.without(missing(register.path, register.partial, state, givens))


def _scaled(register: Coded, view: View, state: State, givens: Givens) -> Converter:
    if register.kind in PATTERNS:
        make, mask = present_type(register, state, givens).make, view.type.maximum - view.type.minimum
        return lambda wire: make(wire & mask)
    if register.value_type.coded:
        make = present_type(register, state, givens).make
        return make if view.type.is_integer and view.factor == 1 else lambda wire: make(_code(register, view, wire))
    slope, offset, _ = _line(register, state, givens)
    slope /= Fraction(view.factor)
    scaled = _ieee(register, view, slope, offset) if view.type.is_float else _whole(register, view, slope, offset)
    try:
        limits = interval_ends(register.path, register.valid, state, givens)
    except ValueNotDecodable as error:  # special values are read nevertheless
        return failing(error)
    if limits is None:
        return scaled

    def checked(wire: Any) -> Any:
        value = scaled(wire)
        why = outside(limits, _exactly(view, wire) * slope + offset)
        if why:
            raise OutOfRange(register.path, why)
        return value

    return checked


def _code(register: Coded, view: View, wire: float) -> int:
    """The code that a number on the wire is; NotDecodable where it is no whole number."""
    if math.isnan(wire) or math.isinf(wire):
        raise NotDecodable(register.path, f"the {view.name} view holds {wire}, which is no code")
    code = _exactly(view, wire) / Fraction(view.factor)
    if code.denominator != 1:
        raise NotDecodable(register.path, f"{rough(code)} is no whole number, and so no code")
    return code.numerator


def _exactly(view: View, wire: float) -> Fraction:
    """The number that a number on the wire stands for: of a float the shortest decimal."""
    return Fraction(shortest(wire, view.type)) if view.type.is_float else Fraction(wire)


def _whole(register: Coded, view: View, slope: Fraction, offset: Fraction) -> Callable[[int], Any]:
    # int / int is correctly rounded in Python, so (a x wire + b) / c is the float nearest to the exact value
    scale = math.lcm(slope.denominator, offset.denominator)
    a, b = int(slope * scale), int(offset * scale)
    if register.value_type.make is float:
        if max(abs(slope * end + offset) for end in (view.type.minimum, view.type.maximum)) > LARGEST_FLOAT:
            return lambda wire: _float(register, Fraction(a * wire + b, scale))
        if b:
            return lambda wire: (a * wire + b) / scale
        return (lambda wire: wire / scale) if a == 1 else (lambda wire: a * wire / scale)
    if (a, b, scale) == (1, 0, 1):
        return same
    return lambda wire: _no_fraction(register, Fraction(a * wire + b, scale))


def _no_fraction(register: Coded, value: Fraction) -> int:
    if value.denominator != 1:
        raise NotDecodable(register.path, f"{rough(value)} is no whole number")
    return value.numerator


def _float(register: Coded, value: Fraction) -> float:
    try:
        return float(value)
    except OverflowError:
        raise NotDecodable(register.path, f"{rough(value)} is beyond every float of a program") from None


def _ieee(register: Coded, view: View, slope: Fraction, offset: Fraction) -> Callable[[float], Any]:
    def scaled(wire: float) -> Any:
        if not math.isfinite(wire):
            raise NotDecodable(register.path, f"the {view.name} view holds {wire}, which is no number")
        value = _exactly(view, wire) * slope + offset
        return _float(register, value) if register.value_type.make is float else _no_fraction(register, value)

    return scaled


def _on_wire(view: View, stored: Fraction) -> float | None:
    """The number on the wire for `stored` in a view; None if the view cannot carry it."""
    exactly = stored * Fraction(view.factor)
    if view.type.is_float:
        try:
            return view.type.nearest(exactly)
        except OverflowError:
            return None
    fits = exactly.denominator == 1 and view.type.minimum <= exactly <= view.type.maximum
    return exactly.numerator if fits else None


def _specials(register: Coded, state: State, givens: Givens) -> dict[Fraction, tuple[Any, Fraction]]:
    """Enum member (None where it has none) and number of each special value, by its code in engineering units."""
    special, means = register.value_type.special, register.value_type.means
    if special is None and not means:
        return {}
    chosen = choose(register.special_scale, state, givens)
    if chosen is None:
        raise NotDecodable(register.path, "no decimals of the manual hold for its special values")
    divisor = power(register.path, chosen.decimals, state)
    codes = {exact(member.value) / divisor: member for member in special or ()}
    found = {code: (member, code) for code, member in codes.items()}
    return found | {Fraction(code) / divisor: (None, Fraction(number)) for code, number in means.items()}


def _with_specials(register: Coded, view: View, state: State, givens: Givens, *, named: bool) -> Converter:
    scaled = _scaled(register, view, state, givens)
    specials = _specials(register, state, givens)
    if not specials:
        return scaled
    line = _line(register, state, givens)
    shown: dict[float | None, Any] = {}
    for code, (member, number) in specials.items():
        wire = _on_wire(view, line.stored(code))
        made = register.value_type.make(number) if member is None or not named else member
        shown.setdefault(wire, made)  # of codes that a coarse float does not tell apart, the first
    shown.pop(None, None)
    return lambda wire: shown[wire] if wire in shown else scaled(wire)


Faults = tuple[tuple[float | None, float | None, str, str], ...]
"""The first and the last number on the wire of each fault (None: NaN), its id and label."""


def _faults(register: Coded, view: View, state: State, givens: Givens) -> Faults:
    found: list[tuple[float | None, float | None, str, str]] = []
    if not register.sentinels:
        return ()
    for one in in_case(register.sentinels, state, givens):
        ends = one.ends and [_on_wire(view, Fraction(end)) for end in one.ends]
        if ends is None:
            found.append((None, None, one.id, one.label))
        elif None not in ends:
            found.append((*sorted(end for end in ends if end is not None), one.id, one.label))  # type: ignore[arg-type] # two ends
    return tuple(found)


def _fault(faults: Faults, wire: float) -> tuple[str, str] | None:
    for low, high, name, label in faults:
        if math.isnan(wire) if low is None or high is None else low <= wire <= high:
            return name, label
    return None


def _guarded(register: Coded, view: View, scaled: Converter, faults: Faults) -> Converter:
    ends = (view.type.minimum, view.type.maximum) if view.saturates and view.type.is_integer else ()
    if not ends and not faults:
        return scaled

    def checked(wire: Any) -> Any:
        if wire in ends:
            also = f" (or {' or '.join(one.label for one in register.sentinels)})" if register.sentinels else ""
            raise Saturated(register.path, f"the {view.name} view stands at its end, {wire}{also}: read another view")
        fault = _fault(faults, wire)
        if fault:
            raise SensorFault(register.path, *fault)
        return scaled(wire)

    return checked


def decoder(
    register: Coded, view: View, state: State, givens: Givens, *, named: bool = True
) -> Callable[[Sequence[int]], Any]:
    """A function from the words of `view` (in wire order) to a value, under the present `state`; see `reader`.

    It raises ValueNotDecodable with the words in it.
    """
    arrange = arranger(view, register.path, state, givens)
    unpack: Callable[[Words], Any] = (
        partial(_number, register.path, view.type) if view.type.spelling else view.type.unpack
    )
    convert: Converter = same
    if isinstance(register.value_type, OctetType):
        unpack = partial(_octets, register, in_case(register.sentinels, state, givens))
    else:
        convert = reader(register, view, state, givens, named=named)

    def decode(words: Sequence[int]) -> Any:
        try:
            return convert(unpack(arrange(words)))
        except ValueNotDecodable as error:
            error.words = tuple(words)
            raise

    return decode


def decode(
    register: Coded, view: View, words: Sequence[int], state: State, givens: Givens, *, named: bool = True
) -> Any:
    """The value of `words` (in wire order), see `reader`; ValueNotDecodable carries the words."""
    if len(words) != view.words:
        message = f"{register.path} has {view.words} words in its {view.name} view, not {len(words)}"
        raise ValueError(message)
    try:
        return decoder(register, view, state, givens, named=named)(words)
    except ValueNotDecodable as error:
        error.words = tuple(words)
        raise


def _number(register: str, wire_type: WireType, words: Words) -> float:
    try:
        return wire_type.unpack(words)
    except ValueError as error:
        raise NotDecodable(register, f"no number of type {wire_type}: {error}") from None


def _octets(register: Coded, faults: tuple[Sentinel, ...], words: Words) -> Any:
    raw = struct.pack(f">{len(words)}H", *words)
    fault = next((one for one in faults if one.reports(int.from_bytes(raw))), None)
    if fault:
        raise SensorFault(register.path, fault.id, fault.label)
    try:
        return cast("OctetType[Any]", register.value_type).read(raw)
    except ValueError as error:
        raise NotDecodable(register.path, str(error)) from None


def carried_over(
    register: Coded, view: View, other: View, words: Words, state: State, givens: Givens
) -> tuple[int, ...]:
    """The words of view `other` for the value that `words` set in `view`; ValueRefused if it cannot carry that."""
    view, other = (present(each, register.path, state, givens) for each in (view, other))
    numbers = arranger(view, register.path, state, givens)(words)
    arrange = arranger(other, register.path, state, givens, sending=True)
    if register.kind in OCTETS:
        return tuple(arrange(numbers))
    wire = view.type.unpack(numbers)
    shown = _wire_words(register, other, _exactly(view, wire) / Fraction(view.factor), rounded=True)
    return tuple(arrange(shown))


def idle_bits(register: Coded, held: int, state: State, givens: Givens) -> int:
    """The bits that are set in a word `held` and have no meaning as things stand: a write may leave them so."""
    kind = present_type(register, state, givens)
    return kind.idle(held) if isinstance(kind, FlagsType | WordType) else 0


def encode(
    register: Coded,
    view: View,
    value: object,
    state: State,
    givens: Givens,
    *,
    rounded: bool = False,
    kept: int = 0,
) -> tuple[int, ...]:
    """The words of `value` in wire order; ValueRefused for a wrong type, a limit or a step.

    With `rounded`, a value finer than the view can carry is rounded by the view's rule instead of refused. `kept` are
    unnamed bits that are set in the device and stay so.
    """
    arrange = arranger(view, register.path, state, givens, sending=True)
    view = present(view, register.path, state, givens)
    if isinstance(register.value_type, OctetType):
        return tuple(arrange(_octet_words(register, view, value, in_case(register.sentinels, state, givens))))
    if isinstance(value, float) and view.type in _NARROW and view.type.carries(value):
        value = Fraction(value)  # 2.0**63 is meant, whose shortest decimal is another number
    amount, special = _amount(register, int(value) & ~kept if kept else value, state, givens)  # type: ignore[call-overload] # flags are whole numbers
    amount += kept
    if not register.value_type.coded:
        if not special:
            _within_limits(register, amount, state, givens)
        stored = _stored(register, amount, state, givens, rounded=rounded)
        if not rounded:
            _carried(register, view, amount, stored, state, givens)
        amount = stored
    words = _wire_words(register, view, amount, rounded=rounded)
    fault = _fault(_faults(register, view, state, givens), view.type.unpack(words))
    if fault:
        raise ValueRefused(register.path, f"{brief(value)} is how the device reports {fault[1]}")
    return tuple(arrange(words))


def _amount(register: Coded, value: object, state: State, givens: Givens) -> tuple[Fraction, bool]:
    """The exact number of `value`, and whether it is a special value, which no range limits."""
    specials = _specials(register, state, givens)
    for code, (member, _) in specials.items():
        if value is member and member is not None:
            return code, True
    amount = present_type(register, state, givens).number(register.path, value)
    for code, (member, number) in specials.items():
        if amount == number and member is None:
            return code, True
    if amount in specials and specials[amount][0] is None:  # it would be read back as another number
        meant = rough(specials[amount][1])
        raise ValueRefused(register.path, f"{rough(amount)} is the device's code for {meant}: write {meant}")
    return amount, amount in specials


Ends = list[tuple[Fraction | float, Fraction | float]]
"""Lowest and highest value of each interval; infinite where nothing limits."""


def interval_ends(name: str, cases: Cases[Range], state: State, givens: Givens) -> Ends | None:
    """The limits of the thing `name` that hold now; None where no case does."""
    limits = choose(cases, state, givens)
    if limits is None:
        return None
    divisor = power(name, limits.decimals, state)

    def settle(bound: Limit, unlimited: float) -> Fraction | float:
        if isinstance(bound, Open):
            return unlimited
        return Fraction(bound) / divisor if isinstance(bound, Number) else settled(name, bound, state, givens)

    return [(settle(low, -math.inf), settle(high, math.inf)) for low, high in limits.intervals]


def outside(ends: Ends, amount: Fraction) -> str:
    """Why a value lies in none of the intervals; empty where it lies in one."""
    if any(low <= amount <= high for low, high in ends):
        return ""
    shown = [["(open)" if isinstance(end, float) else rough(Fraction(end)) for end in interval] for interval in ends]
    return f"{rough(amount)} lies outside {' or '.join(map(' to '.join, shown))}"


def _within_limits(register: Coded, amount: Fraction, state: State, givens: Givens) -> None:
    for cases in filter(None, (register.range, register.valid)):
        ends = interval_ends(register.path, cases, state, givens)
        if ends is None and cases is register.range:
            raise ValueRefused(register.path, "no range of the manual holds as the device is configured")
        why = outside(ends, amount) if ends is not None else ""
        if why:
            raise ValueRefused(register.path, why)


def _stored(register: Coded, amount: Fraction, state: State, givens: Givens, *, rounded: bool) -> Fraction:
    line = _line(register, state, givens)
    stored, conversion = line.stored(amount), line.conversion
    if conversion.step is not None:
        increment = Fraction(conversion.step) / power(register.path, conversion.places, state)
        steps = stored / increment
        if steps.denominator != 1:
            step = increment * line.slope
            if not rounded:
                of = f" of {conversion.places.register}" if conversion.places else ""
                message = f"{rough(amount)} is finer than the resolution {rough(abs(step))}{of} (rounded=True rounds)"
                raise ValueRefused(register.path, message)
            stored = half_up(steps) * increment
    return stored


def _carried(register: Coded, view: View, amount: Fraction, stored: Fraction, state: State, givens: Givens) -> None:
    exactly = stored * Fraction(view.factor)
    if view.type.is_float or exactly.denominator == 1:
        return
    line = _line(register, state, givens)
    around = sorted(line.value(wire / Fraction(view.factor)) for wire in (math.floor(exactly), math.ceil(exactly)))
    near = " and ".join(map(rough, around))
    message = f"{rough(amount)} is finer than the {view.name} view can carry; nearest are {near} (rounded=True rounds)"
    raise ValueRefused(register.path, message)


def _wire_words(register: Coded, view: View, stored: Fraction, *, rounded: bool) -> tuple[int, ...]:
    exactly = stored * Fraction(view.factor)
    if view.type.is_float:
        return _float_words(register, view, exactly, rounded=rounded)
    wire = ROUNDINGS[view.rounding](exactly)
    low, high = view.type.minimum + view.saturates, view.type.maximum - view.saturates
    if register.kind in PATTERNS:  # never negative, whatever the type
        low, high = 0, view.type.maximum - view.type.minimum
    if not low <= wire <= high:
        raise ValueRefused(
            register.path, f"{rough(Fraction(wire))} on the wire lies outside {low} to {high} of the {view.name} view"
        )
    if wire > view.type.maximum:
        wire -= high + 1
    return view.type.pack(wire)


def _float_words(register: Coded, view: View, exactly: Fraction, *, rounded: bool) -> tuple[int, ...]:
    try:
        there = view.type.nearest(exactly)
    except OverflowError:
        raise ValueRefused(register.path, f"{rough(exactly)} is too large for {view.type}") from None
    back = shortest(there, view.type)
    if exactly not in (Fraction(there), Fraction(back)) and not rounded:
        raise ValueRefused(register.path, f"finer than {view.type} can carry; the nearest number on the wire is {back}")
    return view.type.pack(there)


def _octet_words(register: Coded, view: View, value: object, faults: tuple[Sentinel, ...]) -> tuple[int, ...]:
    try:
        raw = cast("OctetType[Any]", register.value_type).write(value, 2 * view.words)
    except ValueError as error:
        raise ValueRefused(register.path, str(error)) from None
    fault = next((one for one in faults if one.reports(int.from_bytes(raw))), None)
    if fault:
        raise ValueRefused(register.path, f"{brief(value)} is how the device reports {fault.label}")
    return struct.unpack(f">{view.words}H", raw)
