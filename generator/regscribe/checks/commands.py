"""Commands: each step must be a request that the device accepts."""

from bisect import bisect_left
from collections.abc import Iterator
from operator import attrgetter

from regscribe.checks.addresses import Stretch, stretches
from regscribe.checks.registry import Finding, Scope, model_rule
from regscribe.model import Command, Register, Related, Rule, Space, Step

WRITE_WORDS = (6, 16)
ONE_WORD = 6
LONGEST = 125
"""Words of the longest value: no request reads more."""


def requests(scope: Scope) -> Iterator[tuple[Command, Step]]:
    """All steps of a model that are requests, with their commands."""
    for command in scope.model.commands:
        yield from ((command, step) for step in command.steps if step.words)


def _at(command: Command, message: str, help_text: str, *related: Related) -> Finding:
    return Finding(command.id, command.span, f"command `{command.id}` {message}", help_text, related)


def _holding(scope: Scope) -> list[Stretch]:
    """The stretches of space holding in the order of their addresses; sorted once for a model."""
    if "holding" not in scope.memo:
        every = (stretch for register in scope.model.registers for stretch in stretches(register))
        mine = [stretch for stretch in every if stretch.space is Space.HOLDING]
        scope.memo["holding"] = sorted(mine, key=attrgetter("first", "last"))
    found = scope.memo["holding"]
    return found if isinstance(found, list) else []


def touched(step: Step, scope: Scope) -> Iterator[Stretch]:
    """The stretches of registers that a step writes to, in whole or in part."""
    last = step.address + len(step.words) - 1
    every = _holding(scope)
    start = bisect_left(every, step.address - LONGEST, key=attrgetter("first"))
    for place in range(start, len(every)):
        stretch = every[place]
        if stretch.first > last:
            return
        if stretch.last >= step.address:
            yield stretch


@model_rule(
    Rule("RS0478", "Command writes a read-only register", "The device refuses it: address or access was misread.")
)
def step_on_read_only(scope: Scope) -> Iterator[Finding]:
    """Look at the access of every register that a step touches."""
    for command, step in requests(scope):
        for stretch in touched(step, scope):
            if not stretch.register.access.writable:
                register: Register = stretch.register
                related = Related(f"`{register.path}` has access {register.access}", register.span)
                message = f"writes `{register.path}` ({stretch}), which can only be read"
                yield _at(command, message, "correct the step's address, or `access`", related)


@model_rule(
    Rule("RS0637", "Command by a function that a view does not allow", "The device refuses it, as it would a driver.")
)
def step_by_another_function(scope: Scope) -> Iterator[Finding]:
    """Compare the function of a step with those of the views that it touches."""
    for command, step in requests(scope):
        for stretch in touched(step, scope):
            if stretch.functions and step.function not in stretch.functions:
                related = Related(f"`{stretch.register.path}` takes {stretch}", stretch.register.span)
                message = f"uses function {step.function:02d} at {stretch} of `{stretch.register.path}`, which is"
                message = f"{message} by functions {list(stretch.functions)} only"
                yield _at(command, message, "name another `view` or `function`, or correct `functions`", related)


@model_rule(
    Rule(
        "RS0479",
        "Command at an address that it cannot mean",
        "Commands may go to addresses of no register, but not to reserved ones, nor into the middle of a value.",
    )
)
def step_into_the_middle(scope: Scope) -> Iterator[Finding]:
    """Compare the addresses of a step with reserved ones and with the ends of longer values."""
    for command, step in requests(scope):
        first, last = step.address, step.address + len(step.words) - 1
        for space, low, high in scope.register_map.reserved:
            if space is Space.HOLDING and first <= high and last >= low:
                message = f"writes {first}..{last}, but {low}..{high} are reserved"
                yield _at(command, message, "correct the step's address")
        for stretch in touched(step, scope):
            if stretch.first < first or stretch.last > last:
                related = Related(f"`{stretch.register.path}` takes {stretch}", stretch.register.span)
                message = f"writes {first}..{last}, a part of `{stretch.register.path}` ({stretch}) only"
                yield _at(command, message, "write the whole value in one step", related)


@model_rule(
    Rule("RS0480", "Command longer than a request", "A step is one request; the device refuses or ignores longer ones.")
)
def step_too_long(scope: Scope) -> Iterator[Finding]:
    """Compare the words of a step with the limit, and with the one word of function 06."""
    limit = scope.register_map.protocol.write_words
    for command, step in requests(scope):
        most = 1 if step.function == ONE_WORD else limit
        if len(step.words) > most:
            message = f"writes {len(step.words)} words by function {step.function:02d}, which takes {most} at most"
            yield _at(command, message, "split the step, or correct `function` or `protocol.limits.write_words`")


@model_rule(
    Rule(
        "RS0481", "Command by a function that the device lacks", "The device answers such a request with an exception."
    )
)
def step_function(scope: Scope) -> Iterator[Finding]:
    """Compare the function of a step with those of the protocol and with those that write words."""
    has = scope.register_map.protocol.functions
    for command, step in requests(scope):
        if step.function not in has:
            message = f"uses function {step.function:02d}, which `protocol.functions` {list(has)} lacks"
            yield _at(command, message, "correct one of them")
        elif step.function not in WRITE_WORDS:
            message = f"uses function {step.function:02d}, which writes no words"
            yield _at(command, message, "use function 6 or 16")


@model_rule(Rule("RS0485", "Command without a request", "A command that sends nothing does nothing."))
def no_request(scope: Scope) -> Iterator[Finding]:
    """Find commands that have no steps but waits."""
    for command in scope.model.commands:
        if not any(step.words for step in command.steps):
            yield _at(command, "sends no request", "give it a step with words, or remove it")
