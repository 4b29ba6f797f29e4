"""The vectors of one view of a register in one situation, without its name and addresses."""

from collections.abc import Iterable, Iterator
from fractions import Fraction
from typing import Any

from regscribe.emit.vectors import octet_vectors, offered_values
from regscribe.emit.vectors.candidates import Proposal, wire_bits
from regscribe.emit.vectors.scale import Scale, scale_now
from regscribe.emit.vectors.situations import Situation
from regscribe.model import Kind, Register, Sentinel, View, show
from regscribe.reference import (
    AS_IS,
    Meaning,
    Reading,
    RefusedError,
    Surroundings,
    decode,
    encode,
    existing_members,
    holds,
    part_value,
    present_view,
    special_value,
    word_order,
    words_of_bits,
)
from regscribe_runtime.values.numbers import MOST_DIGITS

Json = dict[str, Any]
LARGEST_TRIED = Fraction(10**MOST_DIGITS)


def case_of(register: Register, view: View, situation: Situation) -> Json:
    """Return the vectors of one view in one situation, as `schema/vectors.schema.json` describes them."""
    known = situation.known
    view = present_view(view, known) or view
    scale = scale_now(register, view, known)
    decodes = [
        {"words": list(words), **_outcome(register, decode(register, view, words, known), known), "note": note}
        for words, note in _words(register, view, scale, situation).items()
    ]
    found: Json = {"view": view.name, **surroundings(situation), "decode": decodes}
    if not register.access.writable:
        sample = next((str(one["value"]) for one in decodes if "value" in one), "0")
        found["refuse"] = [{"value": sample, "reason": "read_only", "note": "cannot be written"}]
    else:
        found |= _writes(register, view, scale, situation)
    return {key: value for key, value in found.items() if value or key == "view"}


def surroundings(situation: Situation) -> Json:
    """Return the state and the givens of a situation."""
    found: Json = {}
    state = {name: show(value) for name, value in situation.state.items()} | situation.texts
    if state:
        found["state"] = state
    givens: Json = {name: [show(code) for code in sorted(codes)] for name, codes in situation.codes}
    givens |= dict(situation.facts) | dict(situation.choices)
    givens |= {name: show(value) for name, value in situation.numbers.items()}
    if givens:
        found["givens"] = givens
    return found


def _words(register: Register, view: View, scale: Scale | None, situation: Situation) -> dict[tuple[int, ...], str]:
    if view.type.is_octets:
        return octet_vectors.words(register, view, word_order(view, situation.known) or AS_IS)
    order = word_order(view, situation.known) or AS_IS
    bits = wire_bits(register, view, scale, situation.known, full=situation.full)
    return {words_of_bits(view, pattern, order): note for pattern, note in bits.items()}


def _outcome(register: Register, reading: Reading, known: Surroundings) -> Json:
    if reading.meaning is Meaning.FAULT:
        return {"fault": reading.fault}
    if reading.meaning in {Meaning.SATURATED, Meaning.OUT_OF_RANGE, Meaning.NOT_DECODABLE}:
        return {"outcome": reading.meaning.value}
    found: Json = {"value": reading.value if isinstance(reading.value, str) else show(reading.value or Fraction(0))}
    if reading.meaning is Meaning.UNKNOWN_MEMBER:
        return {**found, "unknown": True}
    if isinstance(reading.value, Fraction):
        found |= _named(register, reading.value, known)
    return found


def _named(register: Register, value: Fraction, known: Surroundings) -> Json:
    if register.enum is not None:
        return {"member": next(one.id for one in existing_members(register, known) if one.code == value)}
    for special in register.specials:
        if special.means is None and special_value(register, special, known) == value:
            return {"special": special.id}
    return _parts(register, int(value), known)


def _parts(register: Register, value: int, known: Surroundings) -> Json:
    if register.kind is Kind.FLAGS:
        return {"flags": [bits.id for bits in register.fields if part_value(bits, value) == 1]}
    if register.kind is not Kind.FIELDS:
        return {}
    parts = {bits.id: part_value(bits, value) for bits in register.fields if holds(bits.when, known)}
    absent = [bits.id for bits in register.fields if bits.id not in parts]
    faults = {name: part.id for name, part in parts.items() if isinstance(part, Sentinel)}
    amounts = {name: part for name, part in parts.items() if isinstance(part, Fraction)}
    outside = [bits.id for bits in register.fields if bits.id in amounts and not bits.reads(amounts[bits.id])]
    numbers = {name: show(part) for name, part in amounts.items() if name not in outside}
    besides = {"part_faults": faults, "parts_out_of_range": outside, "absent": absent}
    return {"fields": numbers} | {key: found for key, found in besides.items() if found}


def _writes(register: Register, view: View, scale: Scale | None, situation: Situation) -> Json:
    known, encodes, refuses = situation.known, [], []
    offered: Iterable[tuple[Fraction | str, str]]
    if register.kind in offered_values.TEXTS:
        offered = octet_vectors.texts(register, view)
    else:
        offered = _once(offered_values.numbers(register, view, scale, known, full=situation.full)).items()
    for value, note in offered:
        shown = value if isinstance(value, str) else show(value)
        try:
            encodes.append({"value": shown, "words": list(encode(register, view, value, known)), "note": note})
        except RefusedError as refusal:
            refuses.append({"value": shown, "reason": refusal.reason.value, "note": note})
    found: Json = {"encode": encodes, "refuse": refuses}
    if situation.full:
        if scale is not None and register.fractional and view.type.is_integer:
            encodes += _rounded(register, view, scale, known)
        if word_order(view, known) is not None:
            found["domain"] = list(offered_values.domain(register, view, scale, known))
    return found


def _once(proposals: Iterable[Proposal]) -> dict[Fraction, str]:
    """Return each value with the first of its notes, without values beyond the numbers that a driver takes."""
    notes: dict[Fraction, str] = {}
    for value, note in proposals:
        if abs(value) < LARGEST_TRIED:
            notes.setdefault(value, note)
    return notes


def _rounded(register: Register, view: View, scale: Scale, known: Surroundings) -> Iterator[Json]:
    for value, note in _once(offered_values.rounded(scale)).items():
        try:
            words = encode(register, view, value, known, rounded=True)
        except RefusedError:
            continue
        yield {"value": show(value), "rounded": True, "words": list(words), "note": note}
