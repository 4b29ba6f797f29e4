"""Texts, dates, addresses and versions that are worth trying, and the words of them."""

from collections.abc import Iterator
from contextlib import suppress

from regscribe.model import Kind, Order, Register, View, WireType
from regscribe.reference import Arrangement, RefusedError, words_in_order
from regscribe.reference.octets import octets_of
from regscribe_runtime.values.octets import PLAIN_TEXT

TEXTS_TRIED = {"A": "one character", "": "empty", "\u00e9": "no ASCII"}
LETTERS = {
    "\u00e9\u00fc": "letters of western Europe",
    "\u0416\u0448": "Cyrillic letters",
    "\u65e5\u672c": "Chinese letters",
}
DAYS = ("2000-01-01", "2024-02-29", "2024-12-31", "2099-12-31", "1999-12-31", "2106-02-07")
TIMES = ("00:00:00", "12:30:00", "23:59:00", "23:59:59", "12:30:15.250000")
TRIED = {
    WireType.IPV4: ("192.168.0.1", "0.0.0.0", "255.255.255.255", "256.0.0.1"),  # noqa: S104 (no interface is bound)
    WireType.IPV6: ("2001:db8::1", "::", "fe80::12:34ff:fe56:789a", "12345::"),
    WireType.EUI48: ("00:1a:2b:3c:4d:5e", "ff:ff:ff:ff:ff:ff", "00:1a:2b:3c:4d"),
    WireType.EUI64: ("00:1a:2b:ff:fe:3c:4d:5e", "ff:ff:ff:ff:ff:ff:ff:ff", "00:1a:2b:3c:4d:5e"),
    WireType.DATE: DAYS,
    WireType.TIME: TIMES,
    WireType.DATETIME: tuple(f"{day}T{time}" for day, time in zip(DAYS, (*TIMES, TIMES[0]), strict=True)),
}
"""Values of types of bytes, and beside them some that their words may not tell."""


def texts(register: Register, view: View) -> Iterator[tuple[str, str]]:
    """Yield texts to write to a register of bytes or to a version, with notes."""
    if register.kind is Kind.VERSION:
        yield from _versions(register)
    elif register.kind is Kind.STRING:
        yield from TEXTS_TRIED.items()
        yield from LETTERS.items() if register.text != PLAIN_TEXT else ()
        room = view.words if register.text.per_register else 2 * view.words // register.text.size
        full = "".join(chr(ord("A") + place % 26) for place in range(room))
        yield full, "as long as it may be"
        yield full + "Z", "one character too many"
    elif register.kind is Kind.BYTES:
        size = 2 * view.words
        yield bytes(place & 0xFF for place in range(1, size + 1)).hex(), "every byte differs"
        yield bytes(size).hex(), "zeros"
        yield bytes(size - 1).hex(), "a byte too few"
    else:
        yield from ((text, "as it is written") for text in TRIED[view.type])


def _versions(register: Register) -> Iterator[tuple[str, str]]:
    digits, group = register.version_digits, register.version_group or register.version_digits
    for text, note in (
        ("1" * digits, "all ones"),
        ("0" * digits, "all zeros"),
        ("9" * digits, "all nines"),
        ("1" * (digits + 1), "a digit too many"),
    ):
        yield ".".join(text[start : start + group] for start in range(0, len(text), group)), note


def words(register: Register, view: View, order: Arrangement) -> dict[tuple[int, ...], str]:
    """Return words to decode, with notes."""
    if register.kind is Kind.STRING and register.text == PLAIN_TEXT:
        found = _plain_text(view)
    else:
        found = {(0,) * view.words: "zeros", (0xFFFF,) * view.words: "all bits"}
        found[tuple(0x0102 + 0x0202 * place & 0xFFFF for place in range(view.words))] = "every byte differs"
        for text, note in texts(register, view):
            with suppress(RefusedError):
                found.setdefault(words_in_order(list(octets_of(register, text, 2 * view.words)), order), note)
    for sentinel in register.sentinels:
        for end in sentinel.ends or ():
            raw = int(end).to_bytes(2 * view.words, "big")
            found.setdefault(words_in_order(list(raw), order), f"fault: {sentinel.id}")
    return found


def _plain_text(view: View) -> dict[tuple[int, ...], str]:
    last = 0x4100 if view.byte_order is Order.BIG else 0x0041
    return {
        (0x4133,) * view.words: "the high byte is A, the low byte is 3",
        (*((0x4142,) * (view.words - 1)), last): "filled up with zero",
        (0xC3A9,) * view.words: "no ASCII",
    }
