"""From words to values of use and back, exactly: the only place where numbers are scaled."""

import math
import struct
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from regscribe.runtime.errors import NotDecodable, Saturated, SensorFault, ValueNotDecodable, ValueRefused
from regscribe.runtime.spec import Conversion, Givens, Limits, Ref, State, Text, View, choose
from regscribe.runtime.wire import LITTLE, ROUNDINGS, exact, shortest, show

if TYPE_CHECKING:
    from regscribe.runtime.register import Register

BIT_SPACES = frozenset({"coil", "discrete", "status"})
"""Spaces whose values come as one number, not as words: bits, and the byte of function 07."""

PATTERNS = frozenset({"flags", "fields"})
"""Kinds whose words are patterns of bits: never negative, whatever the type of the view."""

MAX_DECIMALS = 9
"""A decimals register above this is no decimal position of any device; scaling by it would only hide a fault."""


def power(name: str, register: str, at_most: int | None, state: State) -> int:
    """10^d with d from `register`; NotDecodable if that register holds no plausible number of decimals."""
    if not register:
        return 1
    digits = int(state[register])
    if not 0 <= digits <= MAX_DECIMALS:
        raise NotDecodable(name, f"{register} is {digits}, which is no number of decimals")
    return int(10 ** (digits if at_most is None else min(digits, at_most)))


def _conversion(register: "Register[Any]", state: State, givens: Givens) -> tuple[Conversion, int]:
    found: Conversion | None = choose(register.scale, state, givens)
    if found is None:
        known = ", ".join(f"{name} = {state[name]}" for name in register.scale_needs)
        raise NotDecodable(register.path, f"no scale of the manual holds with {known}")
    return found, power(register.path, found.decimals, found.at_most, state)


def arrange(view: View, name: str, words: Sequence[int], state: State) -> Sequence[int]:
    """`words` between wire order and most-significant-first (the same step both ways)."""
    if view.words > 1 and view.word_order(name, state) == LITTLE:
        return words[::-1]
    return words


def reader(register: "Register[Any]", view: View, state: State, givens: Givens) -> Callable[[Any], Any]:
    """A function from a wire number of `view` to a value of use, under the present `state`.

    It raises Saturated, SensorFault or NotDecodable for numbers that are no values.
    """
    if register.kind.name in PATTERNS:
        make, mask = register.kind.make, (1 << 16 * view.words) - 1
        return lambda wire: make(wire & mask)
    if register.kind.coded:
        return register.kind.make
    conversion, divisor = _conversion(register, state, givens)
    factor, multiply, add = Fraction(view.factor), Fraction(conversion.multiply), Fraction(conversion.add)
    slope, offset = multiply / factor / divisor, add / divisor
    scaled = _ieee(register, view, slope, offset) if view.type.is_float else _whole(register, slope, offset)
    return _guarded(register, view, factor, _with_specials(register, scaled))


def same(wire: int) -> int:
    """The reader of plain whole numbers; a block recognises it and does not call it."""
    return wire


def _whole(register: "Register[Any]", slope: Fraction, offset: Fraction) -> Callable[[int], Any]:
    # int / int is correctly rounded in Python, so (a x wire + b) / c is the float nearest to the exact value
    scale = math.lcm(slope.denominator, offset.denominator)
    a, b = int(slope * scale), int(offset * scale)
    if register.kind.make is float:
        if b:
            return lambda wire: (a * wire + b) / scale
        return (lambda wire: wire / scale) if a == 1 else (lambda wire: a * wire / scale)
    if (a, b, scale) == (1, 0, 1):
        return same
    return lambda wire: _no_fraction(register, Fraction(a * wire + b, scale))


def _no_fraction(register: "Register[Any]", value: Fraction) -> int:
    if value.denominator != 1:
        raise NotDecodable(register.path, f"{show(value)} is no whole number")
    return value.numerator


def _ieee(register: "Register[Any]", view: View, slope: Fraction, offset: Fraction) -> Callable[[float], Any]:
    def scaled(wire: float) -> Any:
        if not math.isfinite(wire):
            raise NotDecodable(register.path, f"the {view.name} view holds {wire}, which is no number")
        value = Fraction(shortest(wire, view.type)) * slope + offset
        return float(value) if register.kind.make is float else _no_fraction(register, value)

    return scaled


def _with_specials(register: "Register[Any]", scaled: Callable[[Any], Any]) -> Callable[[Any], Any]:
    special, means = register.kind.special, register.kind.means
    if special is None and not means:
        return scaled
    codes: dict[float, Any] = {code: float(Fraction(text)) for code, text in means.items()}
    codes |= {member.value: member for member in special or () if member.value not in codes}

    def named(wire: Any) -> Any:
        value = scaled(wire)
        return codes.get(value, value)

    return named


def _guarded(
    register: "Register[Any]", view: View, factor: Fraction, scaled: Callable[[Any], Any]
) -> Callable[[Any], Any]:
    ends = (view.type.minimum, view.type.maximum) if view.saturates else ()
    faults = {Fraction(stored) * factor: (name, label) for stored, name, label in register.sentinels}
    if not ends and not faults:
        return scaled

    def checked(wire: Any) -> Any:
        if wire in ends:
            also = f" (or {' or '.join(label for _, label in faults.values())})" if faults else ""
            raise Saturated(register.path, f"the {view.name} view stands at its end, {wire}{also}: read another view")
        if wire in faults:
            raise SensorFault(register.path, *faults[wire])
        return scaled(wire)

    return checked


def decoder(register: "Register[Any]", view: View, state: State, givens: Givens) -> Callable[[Sequence[int]], Any]:
    """A function from the words of `view` (in wire order) to a value of use, under the present `state`.

    It raises ValueNotDecodable with the words in it.
    """
    if register.kind.name == "string":
        return lambda words: _text(register, view, words)
    make = register.kind.make
    if view.space in BIT_SPACES:
        return lambda words: make(words[0])
    backward = view.words > 1 and view.word_order(register.path, state) == LITTLE
    unpack, convert = view.type.unpack, reader(register, view, state, givens)

    def decode(words: Sequence[int]) -> Any:
        try:
            return convert(unpack(words[::-1] if backward else words))
        except ValueNotDecodable as error:
            error.words = tuple(words)
            raise

    return decode


def decode(register: "Register[Any]", view: View, words: Sequence[int], state: State, givens: Givens) -> Any:
    """The value of use that `words` (in wire order) spell; ValueNotDecodable carries the words."""
    if len(words) != view.words:
        message = f"{register.path} has {view.words} words in its {view.name} view, not {len(words)}"
        raise ValueError(message)
    try:
        return decoder(register, view, state, givens)(words)
    except ValueNotDecodable as error:
        error.words = tuple(words)
        raise


def _text(register: "Register[Any]", view: View, words: Sequence[int]) -> str:
    raw = struct.pack(f"{'<' if view.byte_order == LITTLE else '>'}{len(words)}H", *words)
    try:
        return raw.decode("ascii").rstrip("\0 ")
    except UnicodeDecodeError:
        raise NotDecodable(register.path, f"{raw.hex(' ')} is no ASCII text") from None


def encode(
    register: "Register[Any]", view: View, value: object, state: State, givens: Givens, *, rounded: bool = False
) -> tuple[int, ...]:
    """The words of `value` in wire order; ValueRefused says which limit, step or type it breaks.

    With `rounded`, a value finer than the view can carry is rounded by the view's rule instead of refused.
    """
    if register.kind.name == "string":
        return _from_text(register, view, value)
    amount = _amount(register, value)
    if not register.kind.coded:
        _within_limits(register, amount, state, givens)
        stored = _stored(register, amount, state, givens, rounded=rounded)
        if not rounded:
            _carried(register, view, amount, stored, state, givens)
        amount = stored
    elif register.kind.name == "boolean" or view.space == "coil":
        return (int(amount),)
    return tuple(arrange(view, register.path, _wire_words(register, view, amount, rounded=rounded), state))


def _amount(register: "Register[Any]", value: object) -> Fraction:
    if isinstance(value, register.kind.special or ()):
        return Fraction(int(value))
    amount = register.kind.number(register.path, value)
    return next((Fraction(code) for code, text in register.kind.means.items() if Fraction(text) == amount), amount)


def _is_special(register: "Register[Any]", amount: Fraction) -> bool:
    special = register.kind.special
    return amount in register.kind.means or (special is not None and any(amount == member for member in special))


def _limit(bound: Text | Ref | None, divisor: int, state: State) -> Fraction | None:
    if bound is None:
        return None
    if isinstance(bound, Ref):
        return exact(state[bound.register])
    return Fraction(bound) / divisor


def _within_limits(register: "Register[Any]", amount: Fraction, state: State, givens: Givens) -> None:
    if not register.range or _is_special(register, amount):
        return
    limits: Limits | None = choose(register.range, state, givens)
    if limits is None:
        raise ValueRefused(register.path, "no range of the manual holds as the device is configured")
    divisor = power(register.path, limits.decimals, limits.at_most, state)
    ends = [(_limit(low, divisor, state), _limit(high, divisor, state)) for low, high in limits.intervals]
    if not any((low is None or low <= amount) and (high is None or amount <= high) for low, high in ends):
        allowed = " or ".join(
            f"{'(open)' if low is None else show(low)} to {'(open)' if high is None else show(high)}"
            for low, high in ends
        )
        raise ValueRefused(register.path, f"{show(amount)} lies outside {allowed}")


def _stored(register: "Register[Any]", amount: Fraction, state: State, givens: Givens, *, rounded: bool) -> Fraction:
    conversion, divisor = _conversion(register, state, givens)
    stored = (amount * divisor - Fraction(conversion.add)) / Fraction(conversion.multiply)
    if conversion.step is not None:
        steps = stored / Fraction(conversion.step)
        if steps.denominator != 1:
            step = Fraction(conversion.step) * Fraction(conversion.multiply) / divisor
            if not rounded:
                raise ValueRefused(register.path, f"{show(amount)} is finer than the resolution {show(abs(step))}")
            stored = ROUNDINGS["half_up"](steps) * Fraction(conversion.step)
    for fault, _, label in register.sentinels:
        if stored == Fraction(fault):
            raise ValueRefused(register.path, f"{show(amount)} is how the device reports {label}")
    return stored


def _carried(
    register: "Register[Any]", view: View, amount: Fraction, stored: Fraction, state: State, givens: Givens
) -> None:
    exactly = stored * Fraction(view.factor)
    if view.type.is_float or exactly.denominator == 1:
        return
    conversion, divisor = _conversion(register, state, givens)
    around = sorted(
        (wire / Fraction(view.factor) * Fraction(conversion.multiply) + Fraction(conversion.add)) / divisor
        for wire in (math.floor(exactly), math.ceil(exactly))
    )
    near = " and ".join(map(show, around))
    message = f"{show(amount)} is finer than the {view.name} view can carry; nearest are {near} (rounded=True rounds)"
    raise ValueRefused(register.path, message)


def _wire_words(register: "Register[Any]", view: View, stored: Fraction, *, rounded: bool) -> tuple[int, ...]:
    exactly = stored * Fraction(view.factor)
    if view.type.is_float:
        return _float_words(register, view, exactly, rounded=rounded)
    wire = ROUNDINGS[view.rounding](exactly)
    if register.kind.name in PATTERNS and view.type.maximum < wire < 1 << 16 * view.words:
        wire -= 1 << 16 * view.words
    low, high = view.type.minimum + view.saturates, view.type.maximum - view.saturates
    if not low <= wire <= high:
        raise ValueRefused(register.path, f"{wire} on the wire lies outside {low} to {high} of the {view.name} view")
    return view.type.pack(wire)


def _float_words(register: "Register[Any]", view: View, exactly: Fraction, *, rounded: bool) -> tuple[int, ...]:
    try:
        words = view.type.pack(float(exactly))
    except OverflowError:
        raise ValueRefused(register.path, f"{float(exactly):g} is too large for {view.type.name}") from None
    back = shortest(view.type.unpack(words), view.type)
    if not back.is_finite():
        raise ValueRefused(register.path, f"{float(exactly):g} is too large for {view.type.name}")
    if Fraction(back) != exactly and not rounded:
        raise ValueRefused(
            register.path, f"finer than {view.type.name} can carry; the nearest number on the wire is {back}"
        )
    return words


def _from_text(register: "Register[Any]", view: View, value: object) -> tuple[int, ...]:
    if not isinstance(value, str) or not value.isascii():
        raise ValueRefused(register.path, f"{value!r} is no ASCII text")
    if len(value) > 2 * view.words:
        raise ValueRefused(register.path, f"{value!r} has {len(value)} characters; {2 * view.words} fit")
    raw = value.ljust(2 * view.words).encode("ascii")
    return struct.unpack(f"{'<' if view.byte_order == LITTLE else '>'}{view.words}H", raw)
