"""Pictures of a map in words, for those who do not see them."""

from collections.abc import Sequence

from regscribe.emit import picture_paths
from regscribe.emit.markdown.context import SPACES, PageContext
from regscribe.emit.markdown.escape import Md, md
from regscribe.emit.outline import Branch, Leaf, formula, leaves, lettered
from regscribe.emit.words import bits_words, listed, one_line, span_words
from regscribe.model import Register, RegisterMap, Space

MANY = 12
"""Things that are listed before the rest is counted."""


def addresses(register_map: RegisterMap) -> str:
    """Return which spaces the address map shows, from the lowest address to the highest."""
    found: dict[Space, list[int]] = {}
    for model in register_map.models:
        for register in (one for one in model.registers if not one.block and not one.page):
            for view in register.views:
                found.setdefault(view.space, []).extend((view.address(register.at), view.last(register.at)))
            found[register.base.space].extend(register.aliases)
    found = {space: ends for space, ends in found.items() if not space.part_bits}
    spaces = {space: (min(found[space]), max(found[space])) for space in Space if space in found}
    spans = listed([f"{SPACES[space].lower()} {span_words(*ends)}" for space, ends in spaces.items()], last="and")
    words = f"Address map of {one_line(register_map.title)}: {spans}, in the colours of their groups."
    return " ".join(filter(None, (words, undrawn(register_map))))


def undrawn(register_map: RegisterMap) -> str:
    """Return what the address map leaves out, with the names; nothing if it shows all."""
    found: dict[str, dict[str, None]] = {}
    for model in register_map.models:
        for register in model.registers:
            for place in filter(None, (_elsewhere(register, view.space) for view in register.views)):
                found.setdefault(place, {})[one_line(register.name)] = None
    places = [f"{place} ({'; '.join(_few(list(names)))})" for place, names in found.items()]
    return f"Not in the picture: {listed(places, last='and')}." if places else ""


def _elsewhere(register: Register, space: Space) -> str:
    """Where a register stands that has no place among the addresses of all devices; empty for another."""
    if space.part_bits:
        return SPACES[space][0].lower() + SPACES[space][1:] if space is not Space.QUEUE else SPACES[space]
    return (
        "registers in blocks" if register.block else "registers on pages or at other unit ids" if register.page else ""
    )


def bits(leaf: Leaf) -> str:
    """Return what each bit means."""
    parts = dict.fromkeys(
        f"{bits_words(part)} {one_line(part.label)}"
        for _, register in leaf.register.versions
        for part in sorted(register.fields, key=lambda part: part.low)
    )
    return f"Bits of {one_line(leaf.register.first.name)}: {'; '.join(_few(list(parts)))}."


def array(branch: Branch) -> str:
    """Return where each member of an array stands."""
    registers = [(leaf.register.first, leaf.arrays) for leaf in leaves((branch,))]
    parts = [f"{lettered(one.path)} at {formula(one.base, one.at, arrays)}" for one, arrays in registers]
    return f"Structure of {one_line(branch.array.first.name)}: {'; '.join(_few(parts))}."


def _few(parts: Sequence[str]) -> Sequence[str]:
    return parts if len(parts) <= MANY else [*parts[:MANY], f"and {len(parts) - MANY} more"]


def address_map(context: PageContext) -> Md:
    """Return the picture of the address spaces; nothing if no register has an address of its own."""
    drawn = fixed(context.map)
    if not drawn:
        return Md()
    picture, rest = _picture(context, picture_paths.ADDRESSES, addresses(context.map)), undrawn(context.map)
    return md(picture, Md("\n\n"), rest) if rest else picture


def fixed(register_map: RegisterMap) -> bool:
    """Whether any register stands outside blocks, at the same address on every device."""
    registers = (register for model in register_map.models for register in model.registers)
    return any(not register.block and not register.page and not register.base.space.part_bits for register in registers)


def bit_fields(context: PageContext, leaf: Leaf) -> tuple[Md, ...]:
    """Return the picture of a register's bits; nothing if it has no fields."""
    drawn = any(register.fields for _, register in leaf.register.versions)
    return (_picture(context, picture_paths.bits(leaf.register.key), bits(leaf)),) if drawn else ()


def structure(context: PageContext, branch: Branch) -> tuple[Md, ...]:
    """Return the picture of an array; nothing for one inside another, which the outer one's picture shows."""
    name = picture_paths.array(branch.array.first.id)
    return () if branch.arrays else (_picture(context, name, array(branch)),)


def _picture(context: PageContext, name: str, words: str) -> Md:
    return md(Md("!["), words, Md(f"]({picture_paths.link(context.map.id, name)})"))
