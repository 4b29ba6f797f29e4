"""Worked examples of values and of times: the map must give what the manual prints."""

from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from typing import TypeVar

from regscribe.checks.held_values import with_fields
from regscribe.checks.rule import MAP, Finding, RuleScope, Scopes, rule_of_map
from regscribe.model import (
    Example,
    GivenKind,
    Outcome,
    Register,
    TimingExample,
    ValueExample,
    View,
    show,
)
from regscribe.reference import (
    Meaning,
    Reading,
    RefusedError,
    Surroundings,
    UnknownValueError,
    decode,
    encode,
    transmit,
)
from regscribe_runtime.values.serial_line import SerialLine

HALF_A_CENT = Fraction(1, 200)
"""Manuals print milliseconds to two decimals."""

MEANINGS = {Outcome.FAULT: Meaning.FAULT, Outcome.SATURATED: Meaning.SATURATED}

HELP_EXAMPLE = "correct the map; if the manual errs, tell in `errata`"

OneExample = TypeVar("OneExample", bound=Example)
ExampleCheck = Callable[[OneExample, RuleScope], Iterator[str]]


def example_rule(
    rule_id: str, title: str, kind: type[OneExample], what: str, help_text: str = HELP_EXAMPLE
) -> Callable[[ExampleCheck[OneExample]], ExampleCheck[OneExample]]:
    """Declare a rule whose function yields what is wrong with one worked example; `what` names it in messages.

    The scope is that of the example's model, or of the first model where the example names none of the map.
    """

    def walk(check: ExampleCheck[OneExample], scopes: Scopes) -> Iterator[Finding]:
        by_name = {scope.model.name: scope for scope in scopes}
        for example in (one for one in scopes[0].register_map.examples if isinstance(one, kind)):
            owner = example.register if isinstance(example, ValueExample) else ""
            source = f" of {example.source}" if example.source else ""
            named = f"{what}{source} for `{owner}`" if owner else f"{what}{source}"
            for problem in check(example, by_name.get(getattr(example, "model", ""), scopes[0])):
                yield Finding(owner or MAP, example.span, f"{named}: {problem}", help_text)

    return rule_of_map(rule_id, title, walk)


def hexadecimal(words: tuple[int, ...]) -> str:
    """Words for a message."""
    return " ".join(f"{word:04X}" for word in words)


def shown(value: Fraction | str) -> str:
    """A value for a message."""
    return show(value) if isinstance(value, Fraction) else f'"{value}"'


def described(reading: Reading) -> str:
    """What words mean, for a message."""
    if reading.meaning is Meaning.FAULT:
        return f"fault {reading.fault}"
    return shown(reading.value) if reading.value is not None else str(reading.meaning).replace("_", " ")


def in_example(scope: RuleScope, state: Iterable[tuple[str, Fraction]]) -> Surroundings:
    """The state of a worked example: what it says, else the defaults.

    An example may name a given: then it holds that one code (a boolean given: true unless 0). A given that is not
    named holds no code and is not true.
    """
    values = scope.defaults | dict(state)
    givens = scope.register_map.givens
    codes = {
        given.id: frozenset({values.pop(given.id)} if given.id in values else ())
        for given in givens
        if given.kind is GivenKind.CODES
    }
    facts = {given.id: bool(values.pop(given.id, 0)) for given in givens if given.kind is GivenKind.BOOLEAN}
    numbers = {
        given.id: Fraction(values.pop(given.id, given.default or 0))
        for given in givens
        if given.kind is GivenKind.NUMBER
    }
    texts = {f"given.{given.id}": str(given.default or given.choices[0]) for given in givens if given.choices}
    return Surroundings(with_fields(scope.model, values), codes, facts, numbers, texts)


@example_rule("RS0446", "Worked example of a value is not reproduced", ValueExample, "the example")
def value_example(example: ValueExample, scope: RuleScope) -> Iterator[str]:
    """The manual's own figures prove the transcription: where they disagree, the map or the manual is wrong."""
    if example.model != scope.model.name:
        return
    register = scope.registers.get(example.register)
    view = next((view for view in register.views if view.name == example.view), None) if register else None
    if register is None or view is None:
        yield f"model {example.model} has no view {example.view} of it"
    elif len(example.words) != view.words:
        yield f"{len(example.words)} words, but view {view.name} has {view.words}"
    else:
        known = in_example(scope, example.state)
        wrong = judged(lambda: _sent(example, view, known) or _read(example, register, view, known))
        yield from [wrong] if wrong else []


def judged(judge: Callable[[], str]) -> str:
    """What `judge` finds wrong, or why it cannot tell."""
    try:
        return judge()
    except UnknownValueError as unknown:
        return f"it depends on `{unknown}`; say its value under `with`"
    except RefusedError as refused:
        return str(refused)


def _sent(example: ValueExample, view: View, known: Surroundings) -> str:
    if example.stored is None:
        return ""
    words = transmit(view, example.stored, known)
    sends = f"a device that holds {show(example.stored)} sends {hexadecimal(words)}"
    return "" if words == example.words else f"{sends}, the manual says {hexadecimal(example.words)}"


def _read(example: ValueExample, register: Register, view: View, known: Surroundings) -> str:
    words = example.words
    reading = decode(register, view, words, known)
    if example.outcome in MEANINGS:
        wrong = reading.meaning is not MEANINGS[example.outcome]
        wrong = wrong or (example.outcome is Outcome.FAULT and example.value not in {None, reading.fault})
        said = example.value if example.outcome is Outcome.FAULT else example.outcome
        return f"{hexadecimal(words)} is {described(reading)}, the manual says {said}" if wrong else ""
    if example.flags is not None:
        return _flags(example, register, reading)
    if example.value is None:
        return ""
    return compare(register, view, words, example.value, known, lossy=example.lossy)


def _flags(example: ValueExample, register: Register, reading: Reading) -> str:
    word = int(reading.value) if isinstance(reading.value, Fraction) else 0
    have = sorted({bits.id for bits in register.fields if bits.is_flag and word >> bits.low & 1})
    wanted = sorted(set(example.flags or ()))
    said = f"the flags are {', '.join(have) or 'none'}, the manual says {', '.join(wanted) or 'none'}"
    return "" if have == wanted else said


def compare(
    register: Register,
    view: View,
    words: tuple[int, ...],
    value: Fraction | str,
    known: Surroundings,
    *,
    lossy: bool = False,
) -> str:
    """What is wrong with words that should mean `value` (and, unless `lossy`, come from it); empty if nothing is."""
    if any(case.then.multiply == 0 for case in register.scale):
        return ""  # RS0430 reports it: nothing can be computed back
    reading = decode(register, view, words, known)
    if reading.meaning not in {Meaning.VALUE, Meaning.UNKNOWN_MEMBER} or reading.value != value:
        return f"{hexadecimal(words)} is {described(reading)}, the manual says {shown(value)}"
    sent = words if lossy else encode(register, view, value, known)
    if sent != words:
        return f"{shown(value)} becomes {hexadecimal(sent)}, the manual says {hexadecimal(words)}"
    return ""


HELP_TIMES = "correct `serial.gap_characters` or `latency`"


@example_rule("RS0449", "Worked example of a time is not reproduced", TimingExample, "the timing example", HELP_TIMES)
def timing_example(example: TimingExample, scope: RuleScope) -> Iterator[str]:
    """Gap and latency decide timeouts, so they must agree."""
    protocol = scope.register_map.protocol
    character = Fraction(SerialLine.of("", example.baud, example.format).bits * 1000, example.baud)
    gap = protocol.serial.gap * character
    latency = protocol.latency(example.function)
    if latency is None:
        yield f"no latency of function {example.function:02d} is stated"
        return
    more = latency.characters * character
    computed = {
        "gap": (gap, example.gap),
        "earliest": (gap + more + latency.minimum + example.words * latency.minimum_per_word, example.earliest),
        "latest": (gap + more + latency.maximum + example.words * latency.maximum_per_word, example.latest),
    }
    for name, (mine, printed) in computed.items():
        if abs(mine - printed) > HALF_A_CENT:
            yield f"{name} is {float(mine):.2f} ms, the manual says {show(printed)} ms"
