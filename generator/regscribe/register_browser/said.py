"""What the reference in Markdown says of a map, its registers and its commands, as runs of text (see `inline_text`).

The page draws pictures and computes addresses of elements itself; it has all the rest from here.
"""

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Any

from regscribe.emit.markdown.computed import computed
from regscribe.emit.markdown.context import PageContext
from regscribe.emit.markdown.entries import commands, sections
from regscribe.emit.markdown.escape import Md, escape, prose
from regscribe.emit.markdown.examples import examples
from regscribe.emit.markdown.page_values import PageTable, RegisterEntry, Titled, table
from regscribe.emit.markdown.programs import programs
from regscribe.emit.markdown.protocol import exceptions, faults, latency, line
from regscribe.emit.markdown.transmission import conditions, givens, identity, unit_notes, units, views
from regscribe.emit.outline import Leaf, leaves, pattern
from regscribe.emit.words import one_line
from regscribe.model import Erratum, FrameExample, Register, TimingExample, ValueExample
from regscribe.register_browser.errata import concerning
from regscribe.register_browser.inline_text import Runs, runs

Json = Any


def said(context: PageContext) -> dict[str, Json]:
    """Return by anchor what is said of registers and commands, with what is said of a register's group and arrays."""
    concerned = _concerned(context)
    found = {
        entry.anchor: _entry(entry) | {"group": group} | ({"array": arrays} if arrays else {}) | concerned[entry.anchor]
        for section in sections(context)
        for group in [[*map(_runs, (section.name, section.summary, *section.paragraphs))]]
        for entry, arrays in _in_arrays(section.entries)
    }
    return found | {entry.anchor: _entry(entry) for entry in commands(context)}


def _in_arrays(entries: Iterable[RegisterEntry]) -> Iterator[tuple[RegisterEntry, list[Runs]]]:
    """Yield the registers of a group with the texts of the arrays that they are in: these have no anchor."""
    above: list[tuple[int, list[Runs]]] = []
    for entry in entries:
        depth = len(entry.marks)
        above = [(level, texts) for level, texts in above if level < depth]
        if entry.anchor:
            yield entry, [text for _, texts in above for text in texts]
        else:
            above.append((depth, [*map(_runs, (entry.name, entry.summary, *entry.paragraphs))]))


def about(context: PageContext) -> Json:
    """Return what is said of a map: `paragraphs`, `programs`, `errata`, and `tables`, to which links lead."""
    register_map = context.map
    shown = {
        "Which model answers": identity(context),
        "Serial line and limits": line(context),
        "From the end of a request to the start of its answer": latency(context),
        "What a driver must be told": givens(context),
        "Conditions": conditions(context),
        "Units that depend on other registers": units(context),
        "What units stand for": unit_notes(context),
        "Computed values": computed(context),
        "When a request is refused": faults(context),
        "What the device means by its exception codes": exceptions(context),
    }
    tables = (*views(context), *(Titled(title, one) for title, one in shown.items()), *_examples(context))
    texts = (register_map.description, *register_map.notes)
    return {
        "paragraphs": [runs(prose(text)) for text in texts if text],
        "tables": [_table(one) for one in tables if one.table.rows],
        "errata": [_table(Titled("", _errata(register_map.errata)))] if register_map.errata else [],
        "programs": [{"name": one.name, "anchor": one.anchor} | _entry(one) for one in programs(context)],
    }


def _entry(entry: RegisterEntry) -> Json:
    found = {
        "summary": runs(entry.summary),
        "paragraphs": [*map(runs, entry.paragraphs)],
        "danger": [*map(runs, entry.danger)],
        "facts": [[*map(_runs, row)] for row in entry.facts.rows],
        "tables": [_table(one) for one in entry.tables if not one.folded],
        "remarks": [*map(runs, entry.remarks)],
    }
    return {key: value for key, value in found.items() if value}


def _table(one: Titled) -> Json:
    rows = [[*map(_runs, row)] for row in one.table.rows]
    return {"title": _runs(one.title), "headers": [*map(_runs, one.table.headers)], "rows": rows}


def _runs(text: str) -> Runs:
    """Return the runs of a text, which is plain unless it is ready Markdown."""
    return runs(text if isinstance(text, Md) else escape(text))


def _concerned(context: PageContext) -> dict[str, Json]:
    """Return by anchor the worked examples and the errata of a register, and the places of its section's errata."""
    return {context.anchor("register", leaf.register.key): _tables(context, leaf) for leaf in leaves(context.nodes)}


def _tables(context: PageContext, leaf: Leaf) -> Json:
    shared = leaf.register
    elements = [one for model, _ in shared.versions for one in context.elements[model.name, shared.key]]
    errata = context.map.errata
    own, of_section = concerning(errata, elements)
    found = {
        "examples": [_table(one) for one in _examples(context, shared.key, elements)],
        "errata": [_table(Titled("", _errata(errata[place] for place in own)))] if own else [],
        "section_errata": of_section,
    }
    return {key: value for key, value in found.items() if value}


def _examples(context: PageContext, key: str = "", elements: Sequence[Register] = ()) -> tuple[Titled, ...]:
    """Return the tables of worked examples: all of a map, or those that read or write a register."""
    register_map = context.map
    if key:
        addresses = {view.address(one.at) for one in elements for view in one.views}
        kept = tuple(one for one in register_map.examples if _shows(one, key, addresses))
        context = replace(context, map=replace(register_map, examples=kept))
    found = examples(context)
    return tuple(replace(one, title=f"Worked examples: {one.title.lower()}") for one in found)


def _shows(example: ValueExample | FrameExample | TimingExample, key: str, addresses: Collection[int | None]) -> bool:
    if isinstance(example, ValueExample):
        return pattern(example.register) == key
    if isinstance(example, TimingExample):
        return False
    return example.address in addresses or key in {pattern(path) for path, _ in example.writes}


def _errata(errata: Iterable[Erratum]) -> PageTable:
    rows = ((one_line(one.where), *map(prose, (one.printed, one.read, one.why))) for one in errata)
    return table(("Where", "The manual says", "Read as", "Why"), rows)
