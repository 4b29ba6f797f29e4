"""Commands: each step must be a request that the device accepts."""

from bisect import bisect_left
from collections.abc import Iterator
from operator import attrgetter
from typing import NamedTuple

from regscribe.checks.addresses import LAST_ADDRESS, TakenAddresses, stretches
from regscribe.checks.rule import Finding, RuleScope, model_rule
from regscribe.model import Command, CommandStep, Related, Space, View

ONE_VALUE = (5, 6)
LONGEST = 125
"""Words of the longest value: no request reads more."""


class SentStep(NamedTuple):
    """A step that is a request, its command, the path of the register that it names, and the space that is meant."""

    command: Command
    step: CommandStep
    register: str
    space: Space


def requests(scope: RuleScope) -> Iterator[SentStep]:
    """All steps of a model that are requests."""
    for command in scope.model.commands:
        for step, path in command.named_steps:
            if step.words:
                yield SentStep(command, step, path, _space(step, path, scope))


def _space(step: CommandStep, path: str, scope: RuleScope) -> Space:
    """Where the register stands that a step names; without one, what the function of the step writes."""
    register = scope.registers.get(path)
    views = [view for view in register.views if view.address(register.at) == step.address] if register else ()
    return next((view.space for view in views), step.space)


def _at(command: Command, message: str, help_text: str, *related: Related) -> Finding:
    return Finding(command.id, command.span, f"command `{command.id}` {message}", help_text, related)


def _stretches(space: Space, scope: RuleScope) -> list[TakenAddresses]:
    """The stretches of a space in the order of their addresses; sorted once for a model."""
    every = (one for register in scope.model.registers for one in stretches(register) if one.space is space)
    return scope.once(("stretches", space), lambda: sorted(every, key=attrgetter("first", "last")))


def _last(step: CommandStep) -> int:
    return step.address + len(step.words) - 1


def touched(step: CommandStep, space: Space, scope: RuleScope) -> Iterator[TakenAddresses]:
    """The stretches of registers that a step writes to, in whole or in part."""
    last = _last(step)
    every = _stretches(space, scope)
    start = bisect_left(every, step.address - LONGEST, key=attrgetter("first"))
    for place in range(start, len(every)):
        stretch = every[place]
        if stretch.first > last:
            return
        if stretch.last >= step.address:
            yield stretch


def _around(step: CommandStep, space: Space, scope: RuleScope) -> Iterator[View]:
    """Views in whose region a step begins, one for each region with its own alignment and functions."""
    for view in scope.once("regions", lambda: _regions(scope)):
        if view.region and view.space is space and view.region[0] <= step.address <= view.region[1]:
            yield view


def _regions(scope: RuleScope) -> list[View]:
    views = (view for register in scope.model.registers for view in register.views if view.region)
    return list({(view.space, view.region, view.align, view.functions): view for view in views}.values())


@model_rule("RS0478", "Command writes a read-only register", "The device refuses it: address or access was misread.")
def step_on_read_only(scope: RuleScope) -> Iterator[Finding]:
    """Look at the access of every register that a step touches."""
    for command, step, _, space in requests(scope):
        for stretch in touched(step, space, scope):
            if not stretch.register.access.writable:
                register = stretch.register
                related = Related(f"`{register.path}` has access {register.access}", register.span)
                message = f"writes `{register.path}` ({stretch}), which can only be read"
                yield _at(command, message, "correct the step's address, or `access`", related)


@model_rule(
    "RS0637", "Command by a function that a view does not allow", "The device refuses it, as it would a driver."
)
def step_by_another_function(scope: RuleScope) -> Iterator[Finding]:
    """Compare the function of a step with those of the views that it touches."""
    for command, step, _, space in requests(scope):
        for stretch in touched(step, space, scope):
            if stretch.view.functions and step.function not in stretch.view.functions:
                related = Related(f"`{stretch.register.path}` takes {stretch}", stretch.register.span)
                message = f"uses function {step.function:02d} at {stretch} of `{stretch.register.path}`, which is"
                message = f"{message} by functions {list(stretch.view.functions)} only"
                yield _at(command, message, "name another `view` or `function`, or correct `functions`", related)
        for view in () if any(touched(step, space, scope)) else _around(step, space, scope):
            if not view.allows(step.function):
                message = (
                    f"uses function {step.function:02d} at {step.address}, in the region of view {view.name}, which is"
                )
                message = f"{message} by functions {list(view.functions)} only"
                yield _at(command, message, "correct the step's address or `function`, or the `region`")


@model_rule(
    "RS0479",
    "Command at an address that it cannot mean",
    "Commands may go to addresses of no register, but not to reserved or unused ones, nor to a part of a value.",
)
def step_into_the_middle(scope: RuleScope) -> Iterator[Finding]:
    """Compare the addresses of a step with the ends of the space, with reserved ones, and with those of values."""
    for command, step, path, space in requests(scope):
        first, last = step.address, _last(step)
        if first < 0 or last > LAST_ADDRESS:
            yield _at(command, f"writes {first}..{last}, outside 0..{LAST_ADDRESS}", "correct the step's address")
        for word, low, high in _without_register(space, scope):
            if first <= high and last >= low:
                message = f"writes {first}..{last}, but {low}..{high} are {word}"
                yield _at(command, message, "correct the step's address")
        yield from _misaligned(command, step, _around(step, space, scope))
        found = list(touched(step, space, scope))
        yield from _values_in_part(command, step, path, found)
        if not path:
            yield from _values_and_none(command, step, found)


def _misaligned(command: Command, step: CommandStep, around: Iterator[View]) -> Iterator[Finding]:
    for view in around:
        if step.address % view.align or len(step.words) % view.align:
            where = f"{step.address}..{_last(step)} in the region of view {view.name}"
            message = f"writes {where}, where all is multiples of {view.align}"
            yield _at(command, message, "correct the step's address and words, or `align`")


def _without_register(space: Space, scope: RuleScope) -> Iterator[tuple[str, int, int]]:
    """The reserved and the unused addresses of a space: which they are, the first and the last."""
    for word, listed in (("reserved", scope.register_map.reserved), ("unused", scope.model.unused)):
        yield from ((word, low, high) for there, low, high in listed if there is space)


def _values_in_part(command: Command, step: CommandStep, path: str, found: list[TakenAddresses]) -> Iterator[Finding]:
    """Values of which a step writes a part, or more than the one that it names."""
    first, last = step.address, _last(step)
    for stretch in found:
        related = Related(f"`{stretch.register.path}` takes {stretch}", stretch.register.span)
        if stretch.first < first or stretch.last > last:
            message = f"writes {first}..{last}, a part of `{stretch.register.path}` ({stretch}) only"
            yield _at(command, message, "write the whole value in one step", related)
        elif stretch.register.path == path and stretch.last < last:
            message = f"writes {first}..{last}, more than `{path}` ({stretch})"
            yield _at(command, message, "give as many words as the register has", related)


def _values_and_none(command: Command, step: CommandStep, found: list[TakenAddresses]) -> Iterator[Finding]:
    """A step that writes registers and addresses of none."""
    first, last = step.address, _last(step)
    covered = {address for stretch in found for address in range(stretch.first, stretch.last + 1)}
    bare = [address for address in range(first, last + 1) if address not in covered]
    if covered and bare:
        message = f"writes {first}..{last}: registers, but at {bare[0]} there is none"
        yield _at(command, message, "correct the address or the words, or split the step")


@model_rule(
    "RS0480", "Command longer than a request", "A step is one request; the device refuses or ignores longer ones."
)
def step_too_long(scope: RuleScope) -> Iterator[Finding]:
    """Compare the words of a step with the limit, and with the one of functions 05 and 06."""
    protocol = scope.register_map.protocol
    for command, step, _, space in requests(scope):
        what, limit = ("bits", protocol.write_bits) if space.is_bits else ("words", protocol.write_words)
        most = 1 if step.function in ONE_VALUE else limit
        if len(step.words) > most:
            message = f"writes {len(step.words)} {what} by function {step.function:02d}, which takes {most} at most"
            yield _at(command, message, f"split the step, or correct `function` or `protocol.limits.write_{what}`")


@model_rule(
    "RS0481", "Command by a function that the device lacks", "The device answers such a request with an exception."
)
def step_function(scope: RuleScope) -> Iterator[Finding]:
    """Compare the function of a step with those of the protocol and with those that write its space."""
    has = scope.register_map.protocol.functions
    for command, step, _, space in requests(scope):
        if step.function not in has:
            message = f"uses function {step.function:02d}, which `protocol.functions` {list(has)} lacks"
            yield _at(command, message, "correct one of them")
        elif step.function not in (writing := space.write_functions):
            message = f"uses function {step.function:02d}, which does not write space {space}"
            help_text = f"use function {' or '.join(map(str, writing))}" if writing else "nothing writes that space"
            yield _at(command, message, help_text)


@model_rule("RS0650", "Command with words that are no bits", "A coil is 1 (on) or 0 (off), whatever is sent for it.")
def step_of_no_bits(scope: RuleScope) -> Iterator[Finding]:
    """Look for other numbers than 0 and 1 in steps that write coils."""
    for command, step, _, space in requests(scope):
        strange = [word for word in step.words if space.is_bits and word not in {0, 1}]
        if strange:
            message = f"writes {strange[0]} to a coil by function {step.function:02d}"
            yield _at(command, message, "write 1 for on (FF00 in a frame of function 05) and 0 for off")


@model_rule("RS0485", "Command without a request", "A command that sends nothing does nothing.")
def no_request(scope: RuleScope) -> Iterator[Finding]:
    """Find commands that have no steps but waits."""
    for command in scope.model.commands:
        if not any(step.words for step in command.steps):
            yield _at(command, "sends no request", "give it a step with words, or remove it")
