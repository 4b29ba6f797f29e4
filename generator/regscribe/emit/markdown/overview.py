"""The overview: one line for each register, ordered by address, in a table for each address space."""

from collections.abc import Callable, Sequence
from functools import partial

from regscribe.emit.markdown.context import SPACES, PageContext, by_model
from regscribe.emit.markdown.escape import Md, code, escape, join, link, md
from regscribe.emit.markdown.notations import Column, columns, span
from regscribe.emit.markdown.page_values import PageTable, Titled, table
from regscribe.emit.markdown.register_facts import symbols
from regscribe.emit.outline import Leaf, aliases, last_address, leaves, lettered
from regscribe.emit.words import codes_words, default_words, one_line, range_words, span_words, special_words
from regscribe.model import Access, Kind, Model, Register, Space, View

ACCESS = {Access.READ: "R", Access.READ_WRITE: "R/W", Access.WRITE: "W"}
MANY = 3
"""Codes (after joining neighbours) that the overview still lists."""


def overview(context: PageContext) -> tuple[Titled, ...]:
    """Return a table for each space that has registers, and for each block."""
    found: dict[tuple[str, Space], list[Leaf]] = {}
    for leaf in leaves(context.nodes):
        found.setdefault((leaf.register.first.block, leaf.register.first.base.space), []).append(leaf)
    order = ["", *(block.id for block in context.map.blocks)]
    ordered = sorted(found.items(), key=lambda one: (order.index(one[0][0]), list(Space).index(one[0][1])))
    return tuple(Titled(_title(*where), _table(context, where, own)) for where, own in ordered)


def _title(block: str, space: Space) -> str:
    return f"{SPACES[space]} of block {block}, addresses from its base" if block else SPACES[space]


def _table(context: PageContext, where: tuple[str, Space], found: Sequence[Leaf]) -> PageTable:
    ordered = sorted(found, key=lambda leaf: leaf.register.first.address)
    block, space = where
    notations = () if block else columns(context.map, space)
    names = dict.fromkeys(view.name for leaf in found for view in leaf.register.first.views[1:])
    headers = ("Address", *(name for name, _ in notations), *names, "Also at", *HEADERS)
    return table(headers, (_row(context, leaf, notations, list(names)) for leaf in ordered))


HEADERS = ("Name", "Id", "Access", "Range", "Default", "Unit", "Models")


def _row(context: PageContext, leaf: Leaf, notations: Sequence[Column], names: Sequence[str]) -> tuple[Md, ...]:
    shared = leaf.register
    owners = [f"{one_line(array.name)} {array.first} to {array.first + array.count - 1}: " for array in leaf.arrays]

    def cell(fact: Callable[[Model, Register], Md]) -> Md:
        return by_model(shared, fact)

    def notation(column: Column) -> Md:
        return cell(lambda _, register: escape(span_words(*map(column[1], _ends(leaf, register.base, register)))))

    def other_view(name: str) -> Md:
        return cell(lambda _, register: _other_view(context, leaf, name, register))

    return (
        cell(lambda _, register: addresses(context, leaf, register.base, register)),
        *map(notation, notations),
        *map(other_view, names),
        cell(
            lambda _, register: join(", ", (addresses(context, leaf, alias, register) for alias in aliases(register)))
        ),
        link(md(*owners, one_line(shared.first.name)), context.anchor("register", shared.key)),
        code(lettered(shared.first.path)),
        cell(lambda _, register: escape(ACCESS[register.access])),
        cell(lambda model, register: _range(context, model, register)),
        cell(lambda model, register: Md(_default(context, model, register))),
        cell(lambda _, register: escape(symbols(register))),
        context.covers(shared.models),
    )


def _aliases(context: PageContext, leaf: Leaf, register: Register) -> Md:
    return join(", ", (addresses(context, leaf, alias, register) for alias in aliases(register)))


def _ends(leaf: Leaf, view: View, register: Register) -> tuple[int, int]:
    return view.address(register.at), last_address(view, register.at, leaf.arrays)


def addresses(context: PageContext, leaf: Leaf, view: View, register: Register) -> Md:
    """Return the addresses of a register in a view, of an array from the first element to the last."""
    ends, spelled = _ends(leaf, view, register), partial(context.place, view.space)
    return escape(span_words(*map(spelled, ends)) if register.block else span(context.map, view.space, ends, spelled))


def _other_view(context: PageContext, leaf: Leaf, name: str, register: Register) -> Md:
    view = next((view for view in register.views[1:] if view.name == name), None)
    if view is None:
        return Md()
    space = f" ({SPACES[view.space]})" if view.space is not register.base.space else ""
    return md(addresses(context, leaf, view, register), space)


def _range(context: PageContext, model: Model, register: Register) -> Md:
    if register.kind in {Kind.FLAGS, Kind.FIELDS}:
        return md("bits")
    if register.enum is not None:
        codes = [(member.code, member.code) for member in register.enum.members]
        words = codes_words(codes, last="and")
        return md(words if words.count(",") < MANY else f"{len(codes)} codes")
    if len(register.range) > 1:
        return md("by condition")
    wording = context.wording(model)
    limits = [range_words(case.then, wording) for case in register.range]
    return Md("; ".join([*limits, *(special_words(special, wording) for special in register.specials)]))


def _default(context: PageContext, model: Model, register: Register) -> str:
    return default_words(register, register.default, register.default_cases, context.wording(model))
