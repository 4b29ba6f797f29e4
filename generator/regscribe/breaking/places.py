"""Where a register stands and how its words are sent: addresses, aliases, views, block and page."""

from collections.abc import Hashable, Iterator
from dataclasses import replace
from typing import NamedTuple

from regscribe.breaking.change import TEXT_ONLY, Difference, Effects
from regscribe.breaking.facts import EXACT, B, C, Fact, H, N, compared, first_difference, judged, shown
from regscribe.breaking.plain import plain
from regscribe.breaking.renames import Renames
from regscribe.breaking.rules import ADDRESS, ALIAS, ORDER, REACH, TEXT, TYPE, VIEW, VIEW_SET
from regscribe.emit.words import order_words
from regscribe.model import Model, Page, Register, Rule, Space, View
from regscribe_runtime.values.wire_types import WIRE

Placed = tuple[Difference, Hashable, tuple[int, int, int] | None]
"""A difference, its cause, and the first address before and after with the number of words."""


class Seat(NamedTuple):
    """A register of a model; `home` is the `at` that it would have in the first elements of the arrays around it."""

    register: Register
    home: int
    model: Model


def _functions(old: View, new: View) -> tuple[Rule, Effects]:
    """A function that may not be used any more breaks those who send it; none listed: all may."""
    lost = not set(old.functions) <= set(new.functions) if old.functions and new.functions else bool(new.functions)
    return VIEW, Effects(B, H) if lost else Effects(C, N)


def _align(old: View, new: View) -> tuple[Rule, Effects]:
    return VIEW, Effects(C if old.align % new.align == 0 else B, N)


def _type_words(view: View) -> str:
    return f"{view.type.value} in {view.words} word{'' if view.words == 1 else 's'}"


FACTS: tuple[Fact[View], ...] = (
    Fact(("type", "words"), "wire type", judged(TYPE, B, B), _type_words),
    Fact(("order",), "word order", judged(ORDER, B, N), lambda view: order_words(view.order, EXACT)),
    Fact(("byte_order",), "byte order", judged(ORDER, B, N), lambda view: shown(view.byte_order)),
    Fact(("factor", "times"), "factor of the view", judged(VIEW, B, N)),
    Fact(("rounding", "saturates"), "rounding", judged(VIEW, H, H)),
    Fact(("functions",), "functions", _functions),
    Fact(("preferred",), "preferred", judged(VIEW, H, N)),
    Fact(("align",), "alignment", _align),
    Fact(("region",), "region", lambda _, __: (TEXT, TEXT_ONLY)),
)
"""Facts of a view; `name` is how views are paired, `space`, `offset` and `stride` make the address."""


def differences(old: Seat, new: Seat, renames: Renames) -> Iterator[Placed]:
    """All that differs between the places of two versions of a register."""
    one, other = old.register.views, new.register.views
    names = {view.name: view for view in other}
    pairs = [(view, names[view.name]) for view in one if view.name in names]
    if old.register.base.name not in names and new.register.base.name not in {view.name for view in one}:
        pairs.insert(0, (old.register.base, new.register.base))
        if len(one) > 1:
            renamed = Difference(
                VIEW_SET, "name of the view", Effects(N, B), old.register.base.name, new.register.base.name
            )
            yield renamed, None, None
    elif old.register.base.name != new.register.base.name:
        words = old.register.base.name, new.register.base.name
        yield Difference(VIEW, "base view", Effects(H, H), *words), None, None
    yield from _views_apart(pairs, old.register, new.register)
    moved_base = False
    for mine, theirs in pairs:
        several = f" of view `{mine.name}`" if len(one) > 1 else ""
        yield from (
            (each._replace(what=each.what + several), None, None) for each in compared(FACTS, mine, theirs, renames)
        )
        carried = moved_base and (mine.space, mine.offset, mine.stride) == (theirs.space, theirs.offset, theirs.stride)
        if not carried:  # else the register moved as a whole
            found = _address(mine, theirs, old, new, several if mine is not old.register.base else "")
            moved_base = moved_base or (found is not None and mine is old.register.base)
            yield from (found,) if found else ()
    yield from _aliases(old.register, new.register)
    yield from _reach(old, new, renames)


def _views_apart(pairs: list[tuple[View, View]], old: Register, new: Register) -> Iterator[Placed]:
    """The views of one version alone."""
    known = ({id(one) for one, _ in pairs}, {id(other) for _, other in pairs})
    for view in old.views:
        if id(view) not in known[0]:
            yield Difference(VIEW_SET, "view", Effects(B, B), _view_words(view, old.at), "none"), None, None
    for view in new.views:
        if id(view) not in known[1]:
            yield Difference(VIEW_SET, "view", Effects(C, C), "none", _view_words(view, new.at)), None, None


def _view_words(view: View, at: int) -> str:
    return f"{view.name}: {spelled(view.space, view.address(at))}, {_type_words(view)}"


def _address(mine: View, theirs: View, old: Seat, new: Seat, what: str) -> Placed | None:
    """The address of a view where it differs for another reason than the shape of an array, which is told there."""
    steps = new.register.at - new.home
    before = bare(mine.space, mine.address(old.home + steps))
    after = bare(theirs.space, theirs.address(new.register.at))
    if (mine.space, before) == (theirs.space, after):
        if mine.stride == theirs.stride or new.register.index:  # other elements move, and tell it
            return None
        words = f"{mine.stride} addresses a step", f"{theirs.stride} addresses a step"
        return Difference(TEXT, f"stride{what}", TEXT_ONLY, *words), None, None
    first = bare(mine.space, mine.address(old.register.at))
    words = f"{spelled(mine.space, first)}", f"{spelled(theirs.space, after)}"
    formulas = [(view.offset, view.stride) for view in (mine, theirs)]
    why = after - before if formulas[0] == formulas[1] else tuple(formulas)
    cause = (ADDRESS.id, mine.space, theirs.space, what, why)
    return Difference(ADDRESS, f"address{what}", Effects(B, N), *words), cause, (first, after, theirs.words)


def bare(space: Space, address: int) -> int:
    """An address without the number of its page, which is one of the map and not of the device."""
    return address if space.part_bits else address & WIRE


def spelled(space: Space, address: int) -> str:
    """An address with its space: `holding 40`."""
    return f"{space.value} {space.spelled(bare(space, address))}"


def _aliases(old: Register, new: Register) -> Iterator[Placed]:
    """Further addresses that came or went; those that moved with the register are told with it."""
    before, after = (frozenset(one.aliases) for one in (old, new))
    if before == after or {one - old.address for one in before} == {one - new.address for one in after}:
        return
    for gone, words in ((True, before - after), (False, after - before)):
        if words:
            told = ", ".join(spelled(new.base.space, one) for one in sorted(words))
            effects = Effects(B, N) if gone else Effects(C, N)
            yield (
                Difference(ALIAS, "further address", effects, *((told, "none") if gone else ("none", told))),
                None,
                None,
            )


def _reach(old: Seat, new: Seat, renames: Renames) -> Iterator[Placed]:
    """The block, and what selects the page."""
    block = renames.blocks.get(old.register.block, old.register.block)
    if block != new.register.block:
        words = old.register.block or "none", new.register.block or "none"
        yield Difference(REACH, "block", Effects(B, H), *words), None, None
    pages = [
        seat.model.pages[seat.register.page - 1] if 0 < seat.register.page <= len(seat.model.pages) else None
        for seat in (old, new)
    ]
    if _selection(pages[0], renames) != _selection(pages[1], renames.now):
        words = first_difference(pages[0], pages[1], renames)
        yield Difference(REACH, "page", Effects(B, N), *words), (REACH.id, *words), None


def _selection(page: Page | None, renames: Renames) -> Hashable:
    """What selects a page, whatever function the protocol leaves for it."""
    return plain(page and replace(page, steps=tuple(step._replace(function=0) for step in page.steps)), renames)
