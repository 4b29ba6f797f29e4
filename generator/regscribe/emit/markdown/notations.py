"""Other ways to write an address: hexadecimal, those of the map, and Modicon's number where none of these says it."""

from collections.abc import Callable
from functools import partial

from regscribe.emit.markdown.escape import Md, md
from regscribe.emit.words import one_line, span_words
from regscribe.model import Notation, RegisterMap, Space
from regscribe.model.address_text import MODICON, hexadecimal, modicon, readings

NUMBERED = {*MODICON, Space.ENRON}
"""Spaces whose addresses are plain numbers in a request; of the others they are parts and places in them."""

HEXADECIMAL = 16

Column = tuple[str, Callable[[int], str]]
"""The name of a notation, and what writes a wire address in it (nothing, where it has no number for it)."""


def columns(register_map: RegisterMap, space: Space) -> tuple[Column, ...]:
    """Return the notations of a space, those of the map first."""
    own = [item for item in register_map.notations if item.space is space]
    found: list[Column] = [(one_line(item.name), item.printed) for item in own]
    if space in MODICON and not any(map(_is_modicon, own)):
        found.append(("Modicon", partial(modicon, space)))
    return tuple(found)


def _is_modicon(notation: Notation) -> bool:
    first = ((one.address, one.space) for one in readings(notation.printed(0)))
    return (0, notation.space) in first


def in_hexadecimal(register_map: RegisterMap, space: Space, address: int) -> str:
    """Return an address in hexadecimal: `0xFD1`; nothing where it is none, or where the map's own notation says so."""
    said = any(one.space is space and one.base == HEXADECIMAL and not one.offset for one in register_map.notations)
    return "" if said or space not in NUMBERED else hexadecimal(space.inside(address))


def notations(register_map: RegisterMap, space: Space, address: int) -> Md:
    """Return the other notations of an address: `0xFD1, absolute 44050`."""
    named = ((name, written(address)) for name, written in columns(register_map, space))
    parts = (in_hexadecimal(register_map, space, address), *(f"{name} {text}" for name, text in named if text))
    return md(", ".join(filter(None, parts)))


def bracketed(shown: str, others: Md) -> Md:
    """Return an address with its other notations in brackets, if there are any."""
    return md(shown, " (", others, ")") if others else md(shown)


def span(register_map: RegisterMap, space: Space, ends: tuple[int, int], spelled: Callable[[int], str]) -> str:
    """Return the addresses from the first to the last: `4014 to 4021 (0xFAE to 0xFB5)`."""
    words = span_words(*map(spelled, ends))
    low, high = (in_hexadecimal(register_map, space, end) for end in ends)
    return f"{words} ({span_words(low, high)})" if low else words
