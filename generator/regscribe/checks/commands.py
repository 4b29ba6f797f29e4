"""Commands: each step must be a request that the device accepts."""

from bisect import bisect_left
from collections.abc import Callable, Iterator
from operator import attrgetter
from typing import NamedTuple

from regscribe.checks.addresses import TakenAddresses, stretches, without_register
from regscribe.checks.probe_states import verdict
from regscribe.checks.rule import Finding, Problem, RuleScope, model_rule, rule_of_models
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

    @property
    def last(self) -> int:
        """The last address that the step writes."""
        return self.step.address + len(self.step.words) - 1


def requests(scope: RuleScope) -> Iterator[SentStep]:
    """All steps of a model that are requests."""
    for command in scope.model.commands:
        for step, path in command.named_steps:
            if step.words:
                yield SentStep(command, step, path, _space(step, path, scope))


def _space(step: CommandStep, path: str, scope: RuleScope) -> Space:
    """The space of the register that a step names; without one, the space that the function of the step writes."""
    register = scope.registers.get(path)
    views = [view for view in register.views if view.address(register.at) == step.address] if register else ()
    return next((view.space for view in views), step.space)


StepCheck = Callable[[SentStep, RuleScope], Iterator[Problem]]


def step_rule(rule_id: str, title: str) -> Callable[[StepCheck], StepCheck]:
    """Declare a rule whose function looks at one request of a command; findings stand at the command."""

    def walk(check: StepCheck, scope: RuleScope) -> Iterator[Finding]:
        for sent in requests(scope):
            for problem in check(sent, scope):
                yield _at(sent.command, *problem)

    return rule_of_models(rule_id, title, walk)


def _at(command: Command, message: str, help_text: str, related: Related | None = None) -> Finding:
    return Finding(command.id, command.span, f"command `{command.id}` {message}", help_text, related)


def touched(sent: SentStep, scope: RuleScope) -> Iterator[TakenAddresses]:
    """The addresses of registers that a step writes to, in whole or in part."""
    ground = sent.step.block, sent.space
    here = (one for register in scope.model.registers for one in stretches(register) if one.ground == ground)
    every = scope.once(("stretches", ground), lambda: sorted(here, key=attrgetter("first", "last")))
    start = bisect_left(every, sent.step.address - LONGEST, key=attrgetter("first"))
    for place in range(start, len(every)):
        stretch = every[place]
        if stretch.first > sent.last:
            return
        if stretch.last >= sent.step.address:
            yield stretch


def _around(sent: SentStep, scope: RuleScope) -> Iterator[View]:
    """Views in whose region a step begins, one for each region with its own alignment and functions."""
    views = (view for register in scope.model.registers for view in register.views if view.region)
    distinct = scope.once(
        "regions", lambda: {(view.space, view.region, view.align, view.functions): view for view in views}
    )
    for view in distinct.values():
        if view.region and view.space is sent.space and view.region[0] <= sent.step.address <= view.region[1]:
            yield view


@step_rule("RS0478", "Command writes a read-only register")
def step_on_read_only(sent: SentStep, scope: RuleScope) -> Iterator[Problem]:
    """The device refuses it: address or access was misread."""
    every = list(touched(sent, scope))
    written = [one for one in every if one.serves(reading=False)]
    for stretch in every:
        register = stretch.register
        hidden = any(one.first <= stretch.first and stretch.last <= one.last for one in written)
        if not register.access.writable and not hidden:
            related = Related(f"`{register.path}` has access {register.access}", register.span)
            message = f"writes `{register.path}` ({stretch}), which can only be read"
            yield message, "correct the step's address, or `access`", related


@step_rule("RS0638", "Step that writes a register that need not exist")
def step_on_absent(sent: SentStep, scope: RuleScope) -> Iterator[Problem]:
    """A step with its own `when` is sent by that alone; another register may stand at the address then."""
    for target in scope.named((sent.register,)):
        if sent.step.when.always or target.when.always:
            continue
        if 1 in verdict((target.when, sent.step.when), scope).reached:
            related = Related(f"`{target.path}` exists under a condition", target.span)
            message = f"writes `{target.path}` in a step whose `when` also holds while that register does not exist"
            yield message, f"repeat the condition of `{target.path}` in the step's `when`", related


@step_rule("RS0637", "Command by a function that a view does not allow")
def step_by_another_function(sent: SentStep, scope: RuleScope) -> Iterator[Problem]:
    """The device refuses it, as it would a driver."""
    step = sent.step
    for stretch in touched(sent, scope):
        functions = stretch.view.functions
        if functions and step.function not in functions:
            related = Related(f"`{stretch.register.path}` takes {stretch}", stretch.register.span)
            where = f"at {stretch} of `{stretch.register.path}`"
            message = f"uses function {step.function:02d} {where}, which is by functions {list(functions)} only"
            yield message, "name another `view` or `function`, or correct `functions`", related
    for view in () if any(touched(sent, scope)) else _around(sent, scope):
        if not view.allows(step.function):
            where = f"at {step.address}, in the region of view {view.name}"
            message = f"uses function {step.function:02d} {where}, which is by functions {list(view.functions)} only"
            yield message, "correct the step's address or `function`, or the `region`"


@step_rule("RS0479", "Command at an address that it cannot mean")
def step_into_the_middle(sent: SentStep, scope: RuleScope) -> Iterator[Problem]:
    """Commands may go to addresses of no register, but not to reserved or unused ones, nor to a part of a value."""
    step, first, last = sent.step, sent.step.address, sent.last
    end = (first | sent.space.last) if sent.space.part_bits else sent.space.last
    if sent.register and (page := sent.space.page(first)):
        unit = scope.model.pages[page - 1].unit
        where = f"at unit id {unit}" if unit else "on a page"
        yield f"writes `{sent.register}`, which stands {where}, where no step writes", "write that register by itself"
        return
    if first < 0 or last > end:
        yield f"writes {first}..{last}, outside 0..{sent.space.last}", "correct the step's address"
    for word, space, low, high in without_register(scope) if not step.block else ():
        if space is sent.space and first <= high and last >= low:
            yield f"writes {first}..{last}, but {low}..{high} are {word}", "correct the step's address"
    for view in _around(sent, scope):
        if first % view.align or len(step.words) % view.align:
            where = f"{first}..{last} in the region of view {view.name}"
            message = f"writes {where}, where all is multiples of {view.align}"
            yield message, "correct the step's address and words, or `align`"
    yield from _values_in_part(sent, list(touched(sent, scope)))


def _values_in_part(sent: SentStep, found: list[TakenAddresses]) -> Iterator[Problem]:
    """Values of which a step writes a part, or more than the one that it names, or addresses of none as well."""
    first, last = sent.step.address, sent.last
    for stretch in found:
        path = stretch.register.path
        related = Related(f"`{path}` takes {stretch}", stretch.register.span)
        if stretch.first < first or stretch.last > last:
            message = f"writes {first}..{last}, a part of `{path}` ({stretch}) only"
            yield message, "write the whole value in one step", related
        elif path == sent.register and stretch.last < last:
            message = f"writes {first}..{last}, more than `{path}` ({stretch})"
            yield message, "give as many words as the register has", related
    bare = set(range(first, last + 1)).difference(*(range(stretch.first, stretch.last + 1) for stretch in found))
    if found and bare and not sent.register:
        message = f"writes {first}..{last}: registers, but at {min(bare)} there is none"
        yield message, "correct the address or the words, or split the step"


@step_rule("RS0480", "Command longer than a request")
def step_too_long(sent: SentStep, scope: RuleScope) -> Iterator[Problem]:
    """A step is one request; the device refuses or ignores longer ones."""
    step, protocol = sent.step, scope.register_map.protocol
    what = "bits" if sent.space.is_bits else "words"
    most = 1 if step.function in ONE_VALUE else protocol.most_written(sent.space)
    if len(step.words) > most:
        message = f"writes {len(step.words)} {what} by function {step.function:02d}, which takes {most} at most"
        yield message, f"split the step, or correct `function` or `protocol.limits.write_{what}`"


@step_rule("RS0481", "Command by a function that the device lacks")
def step_function(sent: SentStep, scope: RuleScope) -> Iterator[Problem]:
    """The device answers such a request with an exception."""
    has = scope.register_map.protocol.functions
    writing = sent.space.write_functions
    uses = f"uses function {sent.step.function:02d}, which"
    if sent.step.function not in has:
        yield f"{uses} `protocol.functions` {list(has)} lacks", "correct one of them"
    elif sent.step.function not in writing:
        help_text = f"use function {' or '.join(map(str, writing))}" if writing else "nothing writes that space"
        yield f"{uses} does not write space {sent.space}", help_text


@step_rule("RS0650", "Command with words that are no bits")
def step_of_no_bits(sent: SentStep, _: RuleScope) -> Iterator[Problem]:
    """A coil is 1 (on) or 0 (off), whatever is sent for it."""
    strange = [word for word in sent.step.words if sent.space.is_bits and word not in {0, 1}]
    if strange:
        message = f"writes {strange[0]} to a coil by function {sent.step.function:02d}"
        yield message, "write 1 for on (FF00 in a frame of function 05) and 0 for off"


@model_rule("RS0687", "Command with arguments where nobody gives them")
def arguments_of_nobody(scope: RuleScope) -> Iterator[Finding]:
    """What unlocks a write or applies it runs by itself, and knows no values."""
    taking = {command.id: command for command in scope.model.commands if command.arguments}
    for register in scope.model.registers:
        for key, name in (("unlock", register.unlock), ("apply", register.apply)):
            if name in taking:
                related = Related(f"command `{name}` has arguments", taking[name].span)
                message = f"has `{key}: {name}`, which takes {', '.join(dict(taking[name].arguments))}"
                yield Finding.at(register, message, "give a command without arguments, or leave it out", related)


@model_rule("RS0485", "Command without a request")
def no_request(scope: RuleScope) -> Iterator[Finding]:
    """A command that sends nothing does nothing."""
    for command in scope.model.commands:
        if not any(step.words for step in command.steps):
            yield _at(command, "sends no request", "give it a step with words, or remove it")
