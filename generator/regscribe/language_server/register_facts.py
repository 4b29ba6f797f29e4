"""What a register compiles to, in Markdown: addresses, unit, range, its line in the driver, an example."""

import re
from collections.abc import Iterator
from contextlib import suppress
from fractions import Fraction

from regscribe.checks.rule import RuleScope
from regscribe.checks.worked_values import described, hexadecimal
from regscribe.emit import python as driver
from regscribe.emit.markdown.escape import escape
from regscribe.emit.markdown.notations import columns
from regscribe.emit.python.library_modules import module_path
from regscribe.emit.python.register_lines import DESCRIPTORS
from regscribe.emit.words import cases_words, default_words, map_cases, range_words, span_words, value_words
from regscribe.model import Kind, Model, Register, RegisterMap, Span, View
from regscribe.model.address_text import hexadecimal as hex_address
from regscribe.reference import (
    Known,
    Meaning,
    Reading,
    RefusedError,
    Surroundings,
    UnknownValueError,
    choose,
    decode,
    encode,
    limits,
)
from regscribe.visible import safe


def found_at(register_map: RegisterMap, span: Span) -> tuple[Model, Register, list[str]] | None:
    """The register that is declared at a place, on the first model that has it, and the names of all that have."""
    found = [(model, one) for model in register_map.models for one in model.registers if one.span == span]
    return (*found[0], list(dict.fromkeys(model.name for model, _ in found))) if found else None


def facts(register_map: RegisterMap, model: Model, register: Register, models: list[str]) -> str:
    """All that is worth to be known beside the line that is being written."""
    names = f" ({escape(register.symbol)})" if register.symbol else ""
    whole = len(models) == len(register_map.models)
    which = "" if whole else f", on {escape(', '.join(models))}"
    head = (
        f"**{escape(register.name)}**{names} `{register.path}`: {register.access.value}, {register.kind.value}{which}"
    )
    parts = [head, "\n".join(_addresses(register_map, register)), "\n".join(f"- {line}" for line in _meaning(register))]
    example = example_words(register_map, model, register)
    if example:
        parts.append(f"Example: {escape(example)}")
    if line := declaration(register_map, register):
        parts.append(f"```python\n{safe_block(line)}\n```")
    return "\n\n".join(filter(None, parts))


def safe_block(text: str) -> str:
    """Lines for a block of code."""
    return "\n".join(safe(line).replace("```", "'''") for line in text.split("\n"))


def _addresses(register_map: RegisterMap, register: Register) -> Iterator[str]:
    """A table of the views with their addresses in every notation."""
    notations = {view.space: dict(columns(register_map, view.space)) for view in register.views}
    heads = list(dict.fromkeys(name for named in notations.values() for name in named))
    yield f"| view | space | type | address | hex |{''.join(f' {escape(name)} |' for name in heads)}"
    yield f"|{'---|' * (5 + len(heads))}"
    for view in register.views:
        address = view.address(register.at)
        named = notations[view.space]
        more = "".join(f" {escape(named[name](address)) if name in named else ''} |" for name in heads)
        name = escape(view.name or "value")
        shown = _span(view, address)
        yield f"| {name} | {view.space.value} | {view.type.value} | {shown} | {hex_address(address)} |{more}"
    if register.block:
        yield f"\nCounted from the base of the block `{register.block}`."
    if register.aliases:
        yield f"\nAlso at {', '.join(map(str, register.aliases))}."


def _span(view: View, address: int) -> str:
    """The addresses of a view: from the first to the last, or each where they stand apart."""
    if view.is_apart:
        return ", ".join(str(address + offset) for offset in view.offsets)
    return span_words(address, address + view.words - 1)


def _meaning(register: Register) -> Iterator[str]:
    """Unit, range, default and what stands in its way, by condition."""
    texts = {
        "unit": cases_words(register.unit),
        "range": cases_words(map_cases(register.range, range_words)),
        "valid": cases_words(map_cases(register.valid, range_words)),
        "default": default_words(register, register.default, register.default_cases),
        "danger": register.danger,
    }
    yield from (f"{name}: {escape(text)}" for name, text in texts.items() if text)


def example_words(register_map: RegisterMap, model: Model, register: Register) -> str:
    """Words of the preferred view and what they mean with all else at its default; empty where nothing can be said."""
    scope = RuleScope.of(register_map, model)
    known, view = scope.at_defaults, register.preferred
    for value in _candidates(register, scope):
        with suppress(RefusedError, UnknownValueError, ValueError, ArithmeticError):
            words = encode(register, view, value, known, rounded=True)
            return f"{hexadecimal(words)} = {read_as(register, decode(register, view, words, known), known)}"
    return ""


def read_as(register: Register, reading: Reading, known: Known | None = None) -> str:
    """A reading in words: the value with its label and unit, or why there is none."""
    if reading.meaning is not Meaning.VALUE:
        return described(reading)
    unit = ""
    with suppress(UnknownValueError):
        unit = choose(register.unit, known or Surroundings()) or ""
    return f"{value_words(register, reading.value)} {unit}".rstrip()


def _candidates(register: Register, scope: RuleScope) -> Iterator[Fraction | str]:
    """Values that may do as an example: the default, a limit, a code, a small number."""
    if register.default is not None:
        yield register.default
    with suppress(UnknownValueError, RefusedError, ValueError, ArithmeticError):
        if cases := choose(register.range, scope.at_defaults):
            yield from (low for low, _ in limits(cases, scope.at_defaults) if low is not None)
    if register.enum and register.enum.members:
        yield Fraction(register.enum.members[0].code)
    yield from (Fraction(1), Fraction(0)) if register.kind is not Kind.STRING else ("A",)


def declaration(register_map: RegisterMap, register: Register) -> str:
    """The lines that declare a register in the driver."""
    kinds = "|".join(DESCRIPTORS.values())
    start = re.compile(rf"^    {re.escape(register.id)} = (?:{kinds})\(\s*{register.at}\b", re.MULTILINE)
    text = driver.render(register_map)[module_path(register_map.id)]
    found = start.search(text)
    if found is None:
        return ""
    lines = text[found.start() :].split("\n")
    end = next(number for number, line in enumerate(lines[1:], 1) if not line.startswith(("     ", "    )")))
    return "\n".join(line[4:] for line in lines[:end])
