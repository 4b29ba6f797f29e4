"""Addresses: overlaps, ends of the address space, aliases, reserved addresses, notations, functions of a space."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import combinations
from operator import attrgetter

from regscribe.checks.rule import MAP, Finding, RuleScope, Scopes, map_rule, model_rule, register_rule
from regscribe.model import Register, RegisterMap, Related, Space, View

LAST_ADDRESS = 0xFFFF
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

    def __str__(self) -> str:
        where = str(self.first) if self.first == self.last else f"{self.first}..{self.last}"
        return f"{self.space} {where}{f' ({self.by})' if self.by else ''}"


def stretches(register: Register) -> Iterator[TakenAddresses]:
    """All stretches of a register: its views, then its aliases."""
    for view in register.views:
        by = f"view {view.name}" if len(register.views) > 1 else ""
        yield TakenAddresses(view.space, view.address(register.at), view.last(register.at), register, by, view)
    for alias in dict.fromkeys(register.aliases):
        if alias == register.address:
            continue  # RS0403 speaks of it
        base = register.base
        yield TakenAddresses(base.space, alias, alias + base.words - 1, register, "alias", base)


@model_rule(
    "RS0401",
    "Addresses overlap",
    "Two registers (or two views of one) at the same address cannot both be right: one of the rows was misread.",
)
def overlap(scope: RuleScope) -> Iterator[Finding]:
    """Compare each stretch with the one before it that reaches furthest."""
    every = (stretch for register in scope.model.registers for stretch in stretches(register))
    furthest: TakenAddresses | None = None
    for stretch in sorted(every, key=attrgetter("space", "first", "last")):
        if furthest and furthest.space == stretch.space and stretch.first <= furthest.last:
            yield _overlap(*sorted((furthest, stretch), key=lambda one: one.register.span))
        if not furthest or furthest.space != stretch.space or stretch.last > furthest.last:
            furthest = stretch


def _overlap(earlier: TakenAddresses, later: TakenAddresses) -> Finding:
    return Finding.at(
        later.register,
        f"takes {later}, which overlaps {earlier} of `{earlier.register.path}`",
        "correct `at`, the type or the array's stride of one of them",
        Related(f"`{earlier.register.path}` takes {earlier}", earlier.register.span),
    )


@register_rule(
    "RS0402", "Address outside the address space", "A Modbus address is 16 bits; function 07 has one address, 0."
)
def outside_space(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Look at the first and the last address of each view and alias."""
    for stretch in stretches(register):
        limit = 0 if stretch.space is Space.STATUS else LAST_ADDRESS
        if stretch.first < 0 or stretch.last > limit:
            yield Finding.at(register, f"takes {stretch}, outside 0..{limit}", "correct `at` or the view's offset")


@register_rule(
    "RS0403", "Alias equals an address that the register has", "An alias says nothing if it is no other address."
)
def alias_of_itself(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Compare aliases with the base address and with one another."""
    for place, alias in enumerate(register.aliases):
        if alias == register.address or alias in register.aliases[:place]:
            yield Finding.at(register, f"lists alias {alias}, which it has already", "remove this alias")


@register_rule("RS0404", "Register at a reserved address", "The manual cannot both reserve an address and describe it.")
def reserved(register: Register, scope: RuleScope) -> Iterator[Finding]:
    """Compare each stretch with the reserved ones."""
    yield from _listed(register, "reserved", scope.register_map.reserved)


@register_rule(
    "RS0407", "Register at an unused address", "The manual cannot both list an address as unused and describe it."
)
def unused(register: Register, scope: RuleScope) -> Iterator[Finding]:
    """Compare each stretch with those that the model does not use."""
    yield from _listed(register, "unused", scope.model.unused)


def _listed(register: Register, word: str, without_register: Iterable[tuple[Space, int, int]]) -> Iterator[Finding]:
    for space, first, last in without_register:
        for stretch in stretches(register):
            if stretch.space == space and stretch.first <= last and stretch.last >= first:
                help_text = f"correct `at`, or shorten the entry under `{word}`"
                yield Finding.at(register, f"takes {stretch}, but {first}..{last} are {word}", help_text)


@model_rule(
    "RS0662", "Addresses without a register listed twice", "They are reserved or unused, and need one entry only."
)
def listed_twice(scope: RuleScope) -> Iterator[Finding]:
    """Compare all entries of `reserved` and `unused` that count on the model in pairs."""
    entries = [("reserved", *one) for one in scope.register_map.reserved]
    entries += [("unused", *one) for one in scope.model.unused]
    for (key, space, first, last), (other, other_space, low, high) in combinations(entries, 2):
        if space == other_space and first <= high and low <= last:
            message = f"`{other}` lists {space} {low}..{high}, of which `{key}` has {first}..{last} already"
            yield Finding(MAP, scope.register_map.span, message, "remove one entry, or shorten it")


@map_rule("RS0405", "Notation declared twice", "Two offsets under one name leave a printed address with two meanings.")
def notation_twice(register_map: RegisterMap, _: Scopes) -> Iterator[Finding]:
    """Find a notation whose name and space were seen before."""
    seen: set[tuple[str, Space]] = set()
    for notation in register_map.notations:
        if (notation.name, notation.space) in seen:
            message = (
                f"notation `{notation.name}` of space {notation.space} is declared twice (offset {notation.offset})"
            )
            yield Finding(MAP, register_map.span, message, "remove one, or give it another name")
        seen.add((notation.name, notation.space))


@register_rule(
    "RS0406",
    "The device has no function for this access",
    "A register that can be read or written needs a function code of its space that the device supports.",
)
def no_function(register: Register, scope: RuleScope) -> Iterator[Finding]:
    """Look for a function of the device for each way in which drivers reach the register."""
    has = scope.register_map.protocol.functions
    for verb, view, functions in _accesses(register):
        if not set(functions) & set(has) & set(view.functions or functions):
            need = " or ".join(f"{code:02d}" for code in functions) or "that does not exist"
            where = f"view {view.name} by functions {list(view.functions)}" if view.functions else f"space {view.space}"
            message = f"is to be {verb} in {where}, which needs function {need}"
            yield Finding.at(
                register, message, f"correct `access`, `space`, `functions` or `protocol.functions` ({list(has)})"
            )


def _accesses(register: Register) -> Iterator[tuple[str, View, tuple[int, ...]]]:
    """How drivers reach a register: read or written, in which view, by which functions."""
    for view in register.views if register.access.readable else ():
        if view.readable or view is register.read_view:
            yield "read", view, (view.space.read_function,)
    for view in register.views if register.access.writable else ():
        if view.writable or view is register.write_view:
            yield "written", view, view.space.write_functions[1 if view.words > 1 else 0 :]


@map_rule(
    "RS0636",
    "Addresses in a notation",
    "`at` is the address in the request, which counts from 0; a printed 40001 is address 0 on the wire.",
    warns=True,
)
def in_a_notation(register_map: RegisterMap, scopes: Scopes) -> Iterator[Finding]:
    """Look for spaces most of whose registers stand where a notation of the map counts, not at wire addresses."""
    for notation in register_map.notations:
        found = {
            register.path: register
            for scope in scopes
            for register in scope.model.registers
            if register.base.space is notation.space
        }
        inside = [one for one in found.values() if one.address >= notation.offset]
        if notation.offset >= FAR and 2 * len(inside) > len(found):
            first = min(inside, key=lambda one: one.address)
            meant = f"is `at: {first.address - notation.offset}` meant? The offset is added for the docs"
            where = f"which notation `{notation.name}` (offset {notation.offset}) would"
            print_as = f"print as {first.address + notation.offset}"
            yield Finding.at(first, f"stands at wire address {first.address}, {where} {print_as}", meant)
