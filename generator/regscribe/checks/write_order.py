"""Groups in their write order, and what surrounds a write: conditions, unlocking, applying, endurance."""

from collections import defaultdict
from collections.abc import Iterator

from regscribe.checks.commands import requests, touched
from regscribe.checks.rule import Finding, Problem, RuleScope, Scopes, doubled, map_rule, model_rule, register_rule
from regscribe.model import Group, Register, RegisterMap, Related


@model_rule("RS0475", "Place in the write order used twice")
def order_twice(scope: RuleScope) -> Iterator[Finding]:
    """Two groups cannot both be written second."""
    groups = [group for group in scope.model.groups if group.order is not None]
    for first, group in doubled(groups, lambda one: [one.order]):
        related = Related(f"group `{first.id}` has it", first.span)
        message = f"group `{group.id}` has place {group.order} of the write order, which `{first.id}` has"
        yield Finding(group.id, group.span, message, "give one of them another `order`", related)


@model_rule("RS0476", "Written before what rescales it", warns=True)
def rescaled_after(scope: RuleScope) -> Iterator[Finding]:
    """Writing the unit of measure converts values that were written before: the unit must come first."""
    places = {group.id: group.order for group in scope.model.groups}
    earliest: dict[str, tuple[int, Register]] = {}
    for other in scope.model.registers:
        place = places.get(other.group)
        if other.unit_id and place is not None and place < earliest.get(other.unit_id, (place + 1,))[0]:
            earliest[other.unit_id] = (place, other)
    for register in scope.model.registers:
        mine = places.get(register.group)
        if mine is None or register.rescales not in earliest:
            continue
        place, other = earliest[register.rescales]
        if place < mine:
            related = Related(f"`{other.path}` in `{other.group}` ({place}) is rescaled", other.span)
            message = f"rescales {register.rescales}, but its group `{register.group}` has place {mine} in the order"
            yield Finding.at(register, message, f"write it before `{other.group}`: give it a lower `order`", related)


@map_rule("RS0477", "Group without members")
def empty_group(_: RegisterMap, scopes: Scopes) -> Iterator[Finding]:
    """A group that no model has a register of is a heading of nothing."""
    groups: defaultdict[str, list[Group]] = defaultdict(list)
    for scope in scopes:
        for group in scope.model.groups:
            groups[group.id].append(group)
    for name, on_models in groups.items():
        if not any(group.members for group in on_models):
            yield Finding(name, on_models[0].span, f"group `{name}` has no members", "give it registers, or remove it")


@model_rule("RS0482", "Unlocking needs itself")
def unlock_circle(scope: RuleScope) -> Iterator[Finding]:
    """A command that is needed before its own write can never be sent."""
    for command in scope.model.commands:
        for register in {one.path: one for one in _written(command.id, scope)}.values():
            if command.id in (register.unlock, register.apply):
                how = "unlock" if register.unlock == command.id else "apply"
                related = Related(f"`{register.path}` has {how}: {command.id}", register.span)
                message = f"command `{command.id}` writes `{register.path}`, which needs `{command.id}` to {how} it"
                help_text = f"remove `{how}` from the register, or the step"
                yield Finding(command.id, command.span, message, help_text, related)


@register_rule("RS0630", "Unlocked in another element")
def unlocked_elsewhere(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """A command writes the same registers whichever element of an array it is run for."""
    for how, name in (("unlock", register.unlock), ("apply", register.apply)):
        for other in _written(name, scope) if name and register.index else ():
            if _another_element(register, other):
                message = f"has {how}: {name}, which writes `{other.path}`, in another element"
                help_text = f"leave out `{how}` and say in its `description` what must be written: programs do it"
                related = Related(f"`{name}` writes `{other.path}`, whatever the element", other.span)
                yield message, help_text, related
                break


def _written(command: str, scope: RuleScope) -> list[Register]:
    """The registers that the steps of a command write, once for each step."""
    sent = (one for one in requests(scope) if one.command.id == command)
    stretches = (stretch for one in sent for stretch in touched(one, scope))
    return scope.once(("written", command), lambda: [stretch.register for stretch in stretches])


def _another_element(register: Register, other: Register) -> bool:
    """Whether two registers stand in different elements of an array that is around both."""
    mine, its = (zip(one.array.split("."), one.index, strict=False) for one in (register, other))
    for (array, index), (name, number) in zip(mine, its, strict=False):
        if array != name:
            return False
        if index != number:
            return True
    return False


@register_rule("RS0483", "Facts about writing a read-only register")
def write_facts_of_read_only(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A register that cannot be written needs no permission."""
    if register.access.writable:
        return
    facts = {
        "writable": register.writable is not None,
        "unlock": bool(register.unlock),
        "apply": bool(register.apply),
        "rescales": bool(register.rescales),
        "endurance": register.endurance is not None,
        "stays": bool(register.stays),
        "governs": register.governs is not None,
        "settle": bool(register.settle),
    }
    keys = [key for key, is_stated in facts.items() if is_stated]
    if keys:
        message = f"has access {register.access} but {', '.join(keys)}"
        yield message, "correct `access`, or remove what speaks of writing"


@register_rule("RS0671", "Dangerous to write, but copied to other devices", warns=True)
def danger_is_copied(register: Register, _: RuleScope) -> Iterator[Problem]:
    """Settings that are cloned or restored are written one after the other: this one would be among them."""
    if register.danger and not (register.stays or register.governs or register.rescales):
        help_text = (
            "`stays: operation` if it makes the device act, `stays: calibration` (or another) if it belongs to it"
        )
        yield "has `danger`, but no `stays`", f"give it {help_text}; waive this if it is a setting like others"


@register_rule("RS0484", "Endurance that is no number of writes")
def endurance(register: Register, _: RuleScope) -> Iterator[Problem]:
    """Endurance counts the writes that a memory survives."""
    if register.endurance is None:
        return
    if register.endurance <= 0:
        yield f"has an endurance of {register.endurance} writes", "give the number of writes"
    elif register.persistence == "ram":
        message = f"has an endurance of {register.endurance} writes, but its persistence is ram"
        yield message, "correct `persistence`, or remove `endurance`"


@register_rule("RS0640", "Conversion that never happens")
def idle_conversion(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """Values are converted when the unit that they are in changes; if none depends on the register, nothing does."""
    if not register.rescales:
        return
    units = [one.unit for one in scope.model.registers if one.unit_id == register.rescales]
    if not any(register.path in case.when.registers for unit in units for case in unit):
        why = "whose cases do not ask for it" if units else "in which no register counts"
        message = f"rescales {register.rescales}, {why}"
        yield message, "remove `rescales`, or let the cases of the unit ask for the register"


@register_rule("RS0641", "Distance in a unit that nothing converts")
def idle_difference(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """Only where the device converts values does it matter that a distance has no zero point."""
    if register.difference and not any(one.rescales == register.unit_id for one in scope.model.registers):
        message = f"is a difference in {register.unit_id}, which no register rescales"
        yield message, "remove `difference`, or give `rescales` to what makes the device convert"
