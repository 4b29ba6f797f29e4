"""Which errata of a manual concern which register: those about it, which name it or its address, and its section's."""

import re
from collections.abc import Iterable, Iterator

from regscribe.model import Erratum, Register

_SECTION = re.compile(r"[A-Z]?\d+(?:\.\d+)+")
_NUMBERED = re.compile(r"\bregisters? ((?:\d+(?:, | and | or | to )?)+)")
_STRETCH = re.compile(r"(\d+)(?: to (\d+))?")


def concerning(errata: tuple[Erratum, ...], registers: Iterable[Register]) -> tuple[list[int], list[int]]:
    """Return the places of errata about a register (given as all its versions and elements), and of its section's."""
    registers = tuple(registers)
    names = {name for one in registers for name in _names(one) if _is_telling(name)}
    sections = {section for one in registers for section in _SECTION.findall(one.section)}
    addresses = {view.address(one.at) for one in registers for view in one.views}
    own = [place for place, one in enumerate(errata) if _tells(one, names) or _stands_at(one.where, addresses)]
    return own, [
        place
        for place, one in enumerate(errata)
        if place not in own and not _stretches(one.where) and not sections.isdisjoint(_SECTION.findall(one.where))
    ]


def _names(register: Register) -> Iterator[str]:
    """Yield what a register and its fields are called."""
    yield from (register.path, register.name)
    for field in register.fields:
        yield from (field.id, field.label)


def _is_telling(name: str) -> bool:
    """Whether a name is found in prose by its meaning only: `rate` may be any rate, `Soak Time` is the register."""
    return "_" in name or " " in name


def _tells(erratum: Erratum, names: set[str]) -> bool:
    texts = f"{erratum.where}\n{erratum.printed}\n{erratum.read}\n{erratum.why}"
    return any(name in texts and re.search(rf"(?<!\w){re.escape(name)}(?!\w)", texts) for name in names)


def _stands_at(where: str, addresses: set[int]) -> bool:
    """Whether a place says one of the addresses."""
    return any(number in stretch for stretch in _stretches(where) for number in addresses)


def _stretches(where: str) -> list[range]:
    """Return the addresses of `registers 11, 12 and 42 to 46`."""
    found = (_STRETCH.findall(text) for text in _NUMBERED.findall(where))
    return [range(int(first), int(last or first) + 1) for each in found for first, last in each]
