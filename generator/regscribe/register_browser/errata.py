"""Which errata of a manual concern which register: those of its section, and those that name it or its address."""

import re
from collections.abc import Iterable, Iterator

from regscribe.model import Erratum, Register

_SECTION = re.compile(r"[A-Z]?\d+(?:\.\d+)+")
_NUMBERED = re.compile(r"\bregisters? ((?:\d+(?:, | and | or | to )?)+)")
_STRETCH = re.compile(r"(\d+)(?: to (\d+))?")


def concerning(errata: tuple[Erratum, ...], registers: Iterable[Register]) -> list[int]:
    """Return the places of the errata that concern a register, given as all its versions and elements."""
    registers = tuple(registers)
    names = {name for one in registers for name in (one.path, one.name) if _is_telling(name)}
    sections = {section for one in registers for section in _SECTION.findall(one.section)}
    addresses = {view.address(one.at) for one in registers for view in one.views}
    return [
        place for place, one in enumerate(errata) if _names(one, names) or _stands_at(one.where, sections, addresses)
    ]


def _is_telling(name: str) -> bool:
    """Whether a name is found in prose by its meaning only: `rate` may be any rate, `Soak Time` is the register."""
    return "_" in name or " " in name


def _names(erratum: Erratum, names: set[str]) -> bool:
    texts = f"{erratum.where}\n{erratum.printed}\n{erratum.read}\n{erratum.why}"
    return any(name in texts and re.search(rf"(?<!\w){re.escape(name)}(?!\w)", texts) for name in names)


def _stands_at(where: str, sections: set[str], addresses: set[int]) -> bool:
    """Whether a place is one of the sections, and one of the addresses if it says any."""
    said = [stretch for found in _NUMBERED.findall(where) for stretch in _stretches(found)]
    if said:
        return any(number in stretch for stretch in said for number in addresses)
    return not sections.isdisjoint(_SECTION.findall(where))


def _stretches(text: str) -> Iterator[range]:
    """Yield the addresses of `11, 12 and 42 to 46`."""
    for first, last in _STRETCH.findall(text):
        yield range(int(first), int(last or first) + 1)
