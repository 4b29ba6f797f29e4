"""The vectors of one register in all its views and situations, without its name and addresses."""

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from regscribe.emit.vectors import offered_values
from regscribe.emit.vectors.candidates import Proposal, wire_bits
from regscribe.emit.vectors.domain import CODED, domain
from regscribe.emit.vectors.scale import Scale, scale_now
from regscribe.emit.vectors.situations import Situation
from regscribe.model import BitField, Kind, Order, Register, Special, View, WireType, show
from regscribe.reference import (
    Meaning,
    Reading,
    RefusedError,
    Surroundings,
    decode,
    encode,
    special_value,
    word_order,
)
from regscribe_runtime.values.numbers import MOST_DIGITS

Json = dict[str, Any]
LARGEST_TRIED = Fraction(10**MOST_DIGITS)


def case_of(register: Register, view: View, situation: Situation) -> Json:
    """Return the vectors of one view in one situation, as `schema/vectors.schema.json` describes them."""
    known = situation.known
    scale = scale_now(register, view, known)
    found: Json = {"view": view.name, **surroundings(situation)}
    found["decode"] = list(_decodes(register, view, known, _words(register, view, scale, situation)))
    if not register.access.writable:
        found["refuse"] = [{"value": _sample(found["decode"]), "reason": "read_only", "note": "cannot be written"}]
    else:
        found |= _writes(register, view, scale, situation)
    return {key: value for key, value in found.items() if value or key == "view"}


def surroundings(situation: Situation) -> Json:
    """Return the state and the givens of a situation."""
    found: Json = {}
    if situation.state:
        found["state"] = {name: show(value) for name, value in situation.state.items()}
    givens: Json = {name: [show(code) for code in sorted(codes)] for name, codes in situation.codes}
    givens |= dict(situation.facts)
    if givens:
        found["givens"] = givens
    return found


def _sample(decodes: list[Json]) -> str:
    return next((str(case["value"]) for case in decodes if "value" in case), "0")


def _words(register: Register, view: View, scale: Scale | None, situation: Situation) -> dict[tuple[int, ...], str]:
    if view.type is WireType.STRING:
        return {
            (0x4133,) * view.words: "the high byte is A, the low byte is 3",
            (
                *((0x4142,) * (view.words - 1)),
                0x4100 if view.byte_order is Order.BIG else 0x0041,
            ): "filled up with zero",
            (0xC3A9,) * view.words: "no ASCII",
        }
    order = word_order(view, situation.known) or Order.BIG
    bits = wire_bits(register, view, scale, situation.known, full=situation.full)
    return {_in_order(view, pattern, order): note for pattern, note in bits.items()}


def _in_order(view: View, bits: int, order: Order) -> tuple[int, ...]:
    words = tuple(bits >> 16 * place & 0xFFFF for place in reversed(range(view.type.words)))
    if view.byte_order is Order.LITTLE:
        words = tuple((word & 0xFF) << 8 | word >> 8 for word in words)
    return words if order is Order.BIG else words[::-1]


def _decodes(register: Register, view: View, known: Surroundings, words: dict[tuple[int, ...], str]) -> Iterator[Json]:
    for sent, note in words.items():
        reading = decode(register, view, sent, known)
        yield {"words": list(sent), **_outcome(register, reading, known), "note": note}


def _outcome(register: Register, reading: Reading, known: Surroundings) -> Json:
    if reading.meaning is Meaning.FAULT:
        return {"fault": reading.fault}
    if reading.meaning in {Meaning.SATURATED, Meaning.NOT_DECODABLE}:
        return {"outcome": reading.meaning.value}
    found: Json = {"value": reading.value if isinstance(reading.value, str) else show(reading.value or Fraction(0))}
    if reading.meaning is Meaning.UNKNOWN_MEMBER:
        return {**found, "unknown": True}
    if isinstance(reading.value, Fraction):
        found |= _named(register, reading.value, known)
    return found


def _named(register: Register, value: Fraction, known: Surroundings) -> Json:
    if register.enum is not None:
        return {"member": next(member.id for member in register.enum.members if member.code == value)}
    special = next((one.id for one, code in _specials(register, known) if code == value), None)
    return {"special": special} if special is not None else _bits_set(register, int(value))


def _specials(register: Register, known: Surroundings) -> Iterator[tuple[Special, Fraction | None]]:
    """Yield the special values that stand for no number, with their codes as values of use."""
    return ((one, special_value(register, one, known)) for one in register.specials if one.means is None)


def _bits_set(register: Register, word: int) -> Json:
    if register.kind is Kind.FLAGS:
        return {"flags": [bits.id for bits in register.fields if word >> bits.low & 1]}
    if register.kind is Kind.FIELDS:
        return {"fields": {bits.id: str(_part(bits, word)) for bits in register.fields}}
    return {}


def _part(bits: BitField, word: int) -> int:
    return (word >> bits.low) % (1 << bits.width)


def _writes(register: Register, view: View, scale: Scale | None, situation: Situation) -> Json:
    known, encodes, refuses = situation.known, [], []
    for value, note in _offered(register, view, scale, situation):
        shown = value if isinstance(value, str) else show(value)
        try:
            encodes.append({"value": shown, "words": list(encode(register, view, value, known)), "note": note})
        except RefusedError as refusal:
            refuses.append({"value": shown, "reason": refusal.reason.value, "note": note})
    if scale is not None and situation.full and register.kind not in CODED and view.type.is_integer:
        encodes += _rounded(register, view, scale, known)
    found: Json = {"encode": encodes, "refuse": refuses}
    if situation.full and word_order(view, known) is not None:
        found["domain"] = list(domain(register, view, scale, known))
    return found


def _offered(
    register: Register, view: View, scale: Scale | None, situation: Situation
) -> Iterator[tuple[Fraction | str, str]]:
    if register.kind in {Kind.STRING, Kind.VERSION}:
        yield from offered_values.texts(register, view)
        return
    yield from _once(offered_values.numbers(register, view, scale, situation.known, full=situation.full))


def _once(proposals: Iterator[Proposal]) -> Iterator[Proposal]:
    seen: dict[Fraction, str] = {}
    for value, note in proposals:
        if abs(value) < LARGEST_TRIED:
            seen.setdefault(value, note)
    return (Proposal(value, note) for value, note in seen.items())


def _rounded(register: Register, view: View, scale: Scale, known: Surroundings) -> Iterator[Json]:
    if not register.fractional:
        return
    for value, note in _once(offered_values.rounded(scale)):
        try:
            words = encode(register, view, value, known, rounded=True)
        except RefusedError:
            continue
        yield {"value": show(value), "rounded": True, "words": list(words), "note": note}
