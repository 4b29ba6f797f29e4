"""Addresses: overlaps, ends of the address space, aliases, reserved addresses, notations, functions of a space."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from operator import attrgetter

from regscribe.checks.probe_states import verdict
from regscribe.checks.rule import (
    MAP,
    Finding,
    Problem,
    RuleScope,
    Scopes,
    doubled,
    header_rule,
    map_rule,
    model_rule,
    register_rule,
)
from regscribe.lower.conditions import both, excludes
from regscribe.model import Access, Condition, Order, Page, Register, RegisterMap, Related, Space, View
from regscribe_runtime.values.wire_types import PAGE_BITS, WRITE_AND_READ

WRITE_IN = "name under `written_in` the notation that the rows are written in (`modicon` for 40001 and 400001)"
LAST_PART, LAST_OBJECT = 0xFFFF, 0xFF
"""The highest number of a file or a queue, and of an object of the identification."""
FAR = 10_000
"""A notation that begins here tells spaces apart by a digit in front (30001, 40001, 400001)."""


@dataclass(frozen=True, slots=True)
class TakenAddresses:
    """Addresses that a register takes in one space, by which of its views (the base view for an alias)."""

    space: Space
    first: int
    last: int
    register: Register
    by: str
    view: View

    @property
    def ground(self) -> tuple[str, Space]:
        """What the addresses count in: a block (or none) and a space."""
        return self.register.block, self.space

    def serves(self, *, reading: bool) -> bool:
        """Whether it is for reading (or for writing); what could be neither counts as both."""
        access, view = self.register.access, self.view
        ways = access.readable and view.readable, access.writable and view.writable
        return ways[not reading] or not any(ways)

    def __str__(self) -> str:
        spelled = self.space.spelled
        ends = dict.fromkeys(map(spelled, (self.first, self.last)))
        where = "..".join(ends)
        inside = f" of block {self.register.block}" if self.register.block else ""
        return f"{self.space} {where}{inside}{f' ({self.by})' if self.by else ''}"


def stretches(register: Register) -> Iterator[TakenAddresses]:
    """The addresses that a register takes: by its views, then by its aliases."""
    for view in register.views:
        by = f"view {view.name}" if len(register.views) > 1 else ""
        for first, last in _parts(view, view.address(register.at)):
            yield TakenAddresses(view.space, first, last, register, by, view)
    for alias in dict.fromkeys(register.aliases):
        if alias == register.address:
            continue  # RS0403 reports it
        base = register.base
        for first, last in _parts(base, alias):
            yield TakenAddresses(base.space, first, last, register, "alias", base)


def _parts(view: View, address: int) -> list[tuple[int, int]]:
    """The addresses of a view from the first to the last; of words that stand apart each alone."""
    each = [(address + offset, address + offset) for offset in view.offsets]
    return each if view.is_apart else [(address, address + view.words - 1)]


@model_rule("RS0401", "Addresses overlap")
def overlap(scope: RuleScope) -> Iterator[Finding]:
    """Two things to read (or two to write) at one address cannot both be right, unless they never exist together."""
    stretched = (stretch for register in scope.model.registers for stretch in stretches(register))
    every = sorted(stretched, key=attrgetter("ground", "first", "last"))
    ways = ([one for one in every if one.serves(reading=reading)] for reading in (True, False))
    twice = (one for way in ways for one in _overlaps(way, scope))
    return iter(dict.fromkeys(twice))


def _overlaps(every: Iterable[TakenAddresses], scope: RuleScope) -> Iterator[Finding]:
    before: list[TakenAddresses] = []
    for stretch in every:
        before = [one for one in before if one.ground == stretch.ground and one.last >= stretch.first]
        rivals = [one for one in before if not _other_bytes(one.view, stretch.view)]
        rivals = [one for one in rivals if not _one_again(one.register, stretch.register)]
        rivals = [one for one in rivals if not _apart(one.register.when, stretch.register.when, scope)]
        if rivals:
            earlier, later = sorted((max(rivals, key=attrgetter("last")), stretch), key=lambda one: one.register.span)
            other = earlier.register
            message = f"takes {later}, which overlaps {earlier} of `{other.path}`"
            related = Related(f"`{other.path}` takes {earlier}", other.span)
            yield Finding.at(later.register, message, _advice(earlier.register, later.register), related)
        before.append(stretch)


def _one_again(one: Register, other: Register) -> bool:
    """Whether one of two registers reads the words of the other again, or both those of a third."""
    return (one.rereads or one.path) == (other.rereads or other.path)


def _other_bytes(one: View, other: View) -> bool:
    """Whether two views are the two bytes of a word."""
    return one.is_byte and other.is_byte and {one.byte_order, other.byte_order} == {Order.BIG, Order.LITTLE}


@register_rule("RS0611", "Byte written beside another register")
def byte_written(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """A write is of whole words, so it would write the other byte as 0."""
    mine = [one for one in stretches(register) if one.view.is_byte and one.serves(reading=False)]
    if not register.access.writable or not mine:
        return
    others = scope.once("bytes", lambda: _bytes(scope.model.registers))
    for stretch in mine:
        for other in others.get((stretch.ground, stretch.first), ()):
            if other.register is not register and _other_bytes(stretch.view, other.view):
                related = Related(f"`{other.register.path}` is the other byte", other.register.span)
                message = f"can be written at {stretch}, of which `{other.register.path}` is the other byte"
                yield message, "give it `access: r`, or describe the word as one register with `fields`", related


def _bytes(registers: Iterable[Register]) -> dict[tuple[tuple[str, Space], int], list[TakenAddresses]]:
    found: dict[tuple[tuple[str, Space], int], list[TakenAddresses]] = {}
    for register in registers:
        for stretch in stretches(register):
            if stretch.view.is_byte:
                found.setdefault((stretch.ground, stretch.first), []).append(stretch)
    return found


@register_rule("RS0612", "Words apart that no request can carry")
def words_apart(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """They are read by one request, so that both are of one moment, with what stands between them; never written."""
    if not any(view.is_apart and len(view.offsets) == view.type.words for view in register.views):
        return
    if register.access.writable:
        yield "has words that stand apart, which no request writes alone", "give it `access: r`"
    if scope.register_map.protocol.read_holes:
        return
    known = scope.once("read along", lambda: _read_along(scope))
    for view in register.views:
        between = range(view.address(register.at), view.last(register.at))
        holes = [at for at in between if (register.block, view.space, at) not in known]
        if holes:
            shown = ", ".join(map(str, holes[:5]))
            message = f"has words that stand apart, and a request for both would read {shown}, which no register has"
            yield message, "describe what stands between, list it under `unused`, or say `read_holes: true`"


def _read_along(scope: RuleScope) -> set[tuple[str, Space, int]]:
    """The addresses that any read may cover."""
    found = {
        (one.register.block, one.space, at)
        for register in scope.model.registers
        for one in stretches(register)
        if one.serves(reading=True)
        and register.access.readable
        and register.when.always
        and not register.reading.clears
        for at in range(one.first, one.last + 1)
    }
    return found | {("", space, at) for space, first, last in scope.model.unused for at in range(first, last + 1)}


def _apart(one: Condition, other: Condition, scope: RuleScope) -> bool:
    """Whether two conditions never hold together."""
    if one.always or other.always:
        return False
    together = both(one, other)
    return excludes(one, other) or scope.once(("apart", together), lambda: not verdict((together,), scope).possible)


def _advice(one: Register, other: Register) -> str:
    if one.when.always and other.when.always:
        twice = one.address == other.address and one.base.words >= other.base.words and other.access is Access.READ
        again = f", or say `rereads: {one.path}`" if twice and "." not in one.path else ""
        return f"correct `at`, the type, the array's stride or (if one is read and one written) `access`{again}"
    return "give both a `when` such that they never hold together, or correct `at`"


@register_rule("RS0402", "Address outside the address space")
def outside_space(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A Modbus address is 16 bits; function 07 has one address, 0, a file records 0 to 9999, a queue 31 values."""
    for stretch in stretches(register):
        space, bits = stretch.space, stretch.space.part_bits or PAGE_BITS
        part = stretch.first >> bits
        if space is Space.ENRON:
            first, last = space.within(0), space.within(LAST_PART, space.each - 1)
            if stretch.first < first or stretch.last > last:
                yield f"takes {stretch}, outside 0..{LAST_PART}", f"correct `at` or the view's offset, or {WRITE_IN}"
            continue
        parts = range(int(space is Space.FILE), 1 + (LAST_OBJECT if space is Space.IDENTIFICATION else LAST_PART))
        parts = parts if space.part_bits else range(register.page, register.page + 1)
        if stretch.first < 0 or part not in parts or stretch.last > (part << bits) + space.last:
            yield f"takes {stretch}, outside 0..{space.last}", f"correct `at` or the view's offset, or {WRITE_IN}"


@register_rule("RS0688", "Page that cannot be selected")
def on_unreachable_page(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """What selects a page is written before anything on it is read, and so it stands on none itself."""
    page = scope.model.pages[register.page - 1] if register.page else Page()
    for path in page.selectors:
        other = scope.registers.get(path)
        if other and (other.page or other.block or not other.access.writable):
            related = Related(f"`{path}` selects it", other.span)
            yield f"stands on a page that `{path}` selects, which cannot be written first", "name another one", related
        elif other and other.stays != "operation":
            related = Related(f"`{path}` selects it", other.span)
            message = f"stands on a page that `{path}` selects, which reading it changes"
            yield message, f"give `{path}` `stays: operation`: it is no setting", related
    if register.page and any(view.space.part_bits or view.space is Space.STATUS for view in register.views):
        what = "stands on a page or at another unit id, as only holding and input registers and bits can"
        yield what, "move it to another group"
    if register.page and register.path in {
        path for rule in scope.register_map.identity for path in rule.identity.registers()
    }:
        yield "identifies a model, and stands on a page", "use another one"


@register_rule("RS0403", "Alias equals an address that the register has")
def alias_of_itself(register: Register, _: RuleScope) -> Iterator[Problem]:
    """An alias says nothing if it is no other address."""
    for place, alias in enumerate(register.aliases):
        if alias == register.address or alias in register.aliases[:place]:
            yield f"lists alias {alias}, which it has already", "remove this alias"


@register_rule("RS0404", "Register at a reserved address")
def reserved(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """The manual cannot both reserve an address and describe it."""
    yield from _listed(register, "reserved", scope.register_map.reserved)


@register_rule("RS0407", "Register at an unused address")
def unused(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """The manual cannot both list an address as unused and describe it."""
    yield from _listed(register, "unused", scope.model.unused)


def _listed(register: Register, word: str, entries: Sequence[tuple[Space, int, int]]) -> Iterator[Problem]:
    own = list(stretches(register)) if entries and not register.block else []
    for space, first, last in entries:
        for stretch in own:
            if stretch.space == space and stretch.first <= last and stretch.last >= first:
                help_text = f"correct `at`, or shorten the entry under `{word}`"
                yield f"takes {stretch}, but {first}..{last} are {word}", help_text


def without_register(scope: RuleScope) -> list[tuple[str, Space, int, int]]:
    """The entries of `reserved` and `unused` that count on a model: key, space, first and last address."""
    entries = [("reserved", *one) for one in scope.register_map.reserved]
    return entries + [("unused", *one) for one in scope.model.unused]


@model_rule("RS0662", "Addresses without a register listed twice")
def listed_twice(scope: RuleScope) -> Iterator[Finding]:
    """They are reserved or unused, and need one entry only."""
    for (key, space, first, last), (other, other_space, low, high) in combinations(without_register(scope), 2):
        if space == other_space and first <= high and low <= last:
            message = f"`{other}` lists {space} {low}..{high}, of which `{key}` has {first}..{last} already"
            yield Finding(MAP, scope.register_map.span, message, "remove one entry, or shorten it")


@model_rule("RS0672", "Listed address outside the address space")
def listed_outside(scope: RuleScope) -> Iterator[Finding]:
    """A Modbus address is 16 bits; rows of 40001 and the like need `written_in`."""
    for key, space, _, last in without_register(scope):
        if last > space.last and not space.part_bits:
            message = f"`{key}` lists {space} {last}, outside 0..{space.last}"
            yield Finding(MAP, scope.register_map.span, message, f"correct `at`, or {WRITE_IN}")


@header_rule("RS0405", "Notation declared twice")
def notation_twice(register_map: RegisterMap) -> Iterator[Problem]:
    """Two offsets under one name leave a printed address with two meanings."""
    for _, one in doubled(register_map.notations, lambda notation: [(notation.name, notation.space)]):
        message = f"notation `{one.name}` of space {one.space} is declared twice (offset {one.offset})"
        yield message, "remove one, or give it another name"


@register_rule("RS0406", "The device has no function for this access")
def no_function(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """A register that can be read or written needs a function code of its space that the device supports."""
    has = scope.register_map.protocol.functions
    for verb, view, functions in _accesses(register):
        if not set(functions) & set(has) & set(view.functions or functions):
            need = " or ".join(f"{code:02d}" for code in functions) or "that does not exist"
            where = f"view {view.name} by functions {list(view.functions)}" if view.functions else f"space {view.space}"
            message = f"is to be {verb} in {where}, which needs function {need}"
            yield message, f"correct `access`, `space`, `functions` or `protocol.functions` ({list(has)})"


def _accesses(register: Register) -> Iterator[tuple[str, View, tuple[int, ...]]]:
    """Each view that is to be read or written, with the functions of its space that do it."""
    if register.access.readable:
        for view in register.views:
            if view.readable or view is register.read_view:
                by = WRITE_AND_READ if view.is_read_behind_write else view.space.read_function
                yield "read", view, (by,)
    if register.access.writable:
        for view in register.views:
            if view.writable or view is register.write_view:
                yield "written", view, view.space.write_functions[int(view.words > view.space.each) :]


@map_rule("RS0636", "Addresses in a notation", warns=True)
def in_a_notation(register_map: RegisterMap, scopes: Scopes) -> Iterator[Finding]:
    """`at` is the address in the request, which counts from 0; a printed 40001 is address 0 on the wire."""
    for notation in register_map.notations:
        found = {
            register.path: register
            for scope in scopes
            for register in scope.model.registers
            if register.base.space is notation.space and not register.block
        }
        plain = notation.space.plain
        inside = [one for one in found.values() if plain(one.address) >= notation.offset]
        if notation.offset >= FAR and 2 * len(inside) > len(found):
            first = min(inside, key=lambda one: one.address)
            meant = f"is `at: {plain(first.address) - notation.offset}` meant? Or {WRITE_IN}"
            where = f"which notation `{notation.name}` (offset {notation.offset}) would"
            print_as = f"print as {plain(first.address) + notation.offset}"
            yield Finding.at(first, f"stands at wire address {plain(first.address)}, {where} {print_as}", meant)


MODICON = {Space.DISCRETE: 10_001, Space.INPUT: 30_001, Space.HOLDING: 40_001}
"""What manuals call the first address of a space, if they count as the first Modbus controllers did."""


@map_rule("RS0673", "Addresses that look like manual numbers", warns=True)
def looks_like_modicon(register_map: RegisterMap, scopes: Scopes) -> Iterator[Finding]:
    """`at` is the address in the request, which counts from 0; a printed 40001 is nearly always address 0 there."""
    declared = {notation.space for notation in register_map.notations}
    for space, first in MODICON.items():
        found = [one for scope in scopes for one in scope.model.registers if one.base.space is space]
        lowest = min(found, key=lambda one: one.address, default=None)
        if lowest and lowest.address == first and space not in declared:
            message = f"is the first of {space}, at wire address {first}"
            yield Finding.at(lowest, message, f"is address 0 meant? Then {WRITE_IN}")
