"""Views: regions, alignment, request limits and functions."""

from collections.abc import Iterator
from itertools import combinations

from regscribe.checks.addresses import stretches
from regscribe.checks.rule import Finding, Problem, RuleScope, Scopes, map_rule, model_rule, register_rule
from regscribe.model import Register, RegisterMap, Related, Space
from regscribe_runtime.values.kinds import DIVISIBLE

FURTHER_FUNCTIONS = {Space.HOLDING: (22, 23)}
"""Functions of a space besides those that drivers use: mask write, and write and read."""

Region = tuple[Space, str, int, int]
"""Where the views of one name stand: their space, their name, the first and the last address."""


def regions(scope: RuleScope) -> dict[Region, Register]:
    """The regions of a model, each with the first register that has it; view sets that state one alike share it."""
    found: dict[Region, Register] = {}
    for register in scope.model.registers:
        for view in register.views:
            if view.region:
                found.setdefault((view.space, view.name, *view.region), register)
    return found


@register_rule("RS0455", "View outside its region")
def outside_region(register: Register, _: RuleScope) -> Iterator[Problem]:
    """The manual gives each kind of view its own addresses."""
    for stretch in stretches(register):
        region = stretch.view.region
        if region and not region[0] <= stretch.first <= stretch.last <= region[1]:
            where = f"{stretch.by or f'view {stretch.view.name}'} at {stretch.first}..{stretch.last}"
            message = f"has {where}, outside its region {region[0]}..{region[1]}"
            yield message, "correct `at`, the alias, or the view's offset, stride or region"


@model_rule("RS0660", "Register in the region of a view")
def in_a_region(scope: RuleScope) -> Iterator[Finding]:
    """Nothing else stands where a view has addresses of its own."""
    every = regions(scope)
    for register in scope.model.registers:
        for stretch in stretches(register):
            for (space, name, first, last), owner in every.items() if not stretch.view.region else ():
                if space == stretch.space and stretch.first <= last and first <= stretch.last:
                    message = f"takes {stretch}, in the region {first}..{last} of view {name}"
                    related = Related(f"`{owner.path}` has this view", owner.span)
                    yield Finding.at(register, message, "correct `at`, the alias, or `region` of the view", related)


@register_rule("RS0456", "Misaligned view")
def misaligned(register: Register, _: RuleScope) -> Iterator[Problem]:
    """The device refuses an address or a number of words that splits a value."""
    for view in register.views:
        where = view.address(register.at)
        if view.align > 1 and (where % view.align or view.words % view.align):
            message = f"has view {view.name} at {where} with {view.words} words, not multiples of {view.align}"
            yield message, "correct `at`, the view's offset and stride, or `align`"


@model_rule("RS0457", "View regions overlap")
def regions_overlap(scope: RuleScope) -> Iterator[Finding]:
    """An address in two regions would have two meanings."""
    for (one, register), (other, owner) in combinations(regions(scope).items(), 2):
        (space, name, low, high), (other_space, other_name, first, last) = one, other
        if space == other_space and low <= last and first <= high:
            message = f"has a view whose region overlaps another: {name} {low}..{high}, {other_name} {first}..{last}"
            related = Related(f"`{owner.path}` has view {other_name}", owner.span)
            yield Finding.at(register, message, "correct `region` of one view", related)


@register_rule("RS0458", "Value longer than a request")
def longer_than_request(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """A number that does not fit one request can never be read whole; a text is read in several."""
    protocol, access = scope.register_map.protocol, register.access
    if register.kind in DIVISIBLE and not register.reading.clears and not register.base.space.is_whole:
        return
    limits = (("read", access.readable, protocol.most_read), ("write", access.writable, protocol.most_written))
    for view in register.views:
        for way, allowed, limit in limits:
            most = limit(view.space)
            if view.words > most and allowed and not view.space.is_bits:
                message = f"has view {view.name} of {view.words} words; a {way} request takes {most} at most"
                yield message, f"correct the type, `length` or `protocol.limits.{way}_words`"
                break


@register_rule("RS0459", "View by a function that the device lacks")
def unsupported_function(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """Only a function that the device supports can reach it."""
    has = scope.register_map.protocol.functions
    for view in register.views:
        lacking = [code for code in view.functions if code not in has]
        if lacking:
            codes = ", ".join(f"{code:02d}" for code in lacking)
            message = f"has view {view.name} by function {codes}, which `protocol.functions` {list(has)} lacks"
            yield message, "correct one of the two lists"


@register_rule("RS0635", "View by a function of another space")
def function_of_another_space(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A function code reads or writes in one space only."""
    for view in register.views:
        known = (view.space.read_function, *view.space.write_functions, *FURTHER_FUNCTIONS.get(view.space, ()))
        strange = [code for code in view.functions if code not in known]
        if strange:
            codes = ", ".join(f"{code:02d}" for code in strange)
            message = f"has view {view.name} by function {codes}, which does not reach space {view.space}"
            yield message, f"correct `functions` (of this space: {list(known)}) or `space`"


@map_rule("RS0460", "More than one preferred view")
def preferred_twice(_: RegisterMap, scopes: Scopes) -> Iterator[Finding]:
    """A driver uses one view unless told otherwise."""
    seen: set[tuple[object, ...]] = set()
    for register in (register for scope in scopes for register in scope.model.registers):
        names = [view.name for view in register.views if view.preferred]
        shape = tuple((v.name, v.space, v.type, v.region, v.preferred, v.words) for v in register.views)
        if len(names) > 1 and shape not in seen:
            seen.add(shape)  # registers whose views differ in their addresses alone have one view set
            yield Finding.at(register, f"has preferred views {', '.join(names)}", "prefer one of them")
