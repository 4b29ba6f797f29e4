"""The tables below a register's facts: views, scale and range by condition, values, bits, addresses of elements."""

from collections.abc import Iterable, Iterator, Sequence
from operator import attrgetter

from regscribe.emit.common_values import Merged, Stated, models_by
from regscribe.emit.markdown.context import SPACES, PageContext
from regscribe.emit.markdown.escape import Md, code, escape, md, prose
from regscribe.emit.markdown.notations import bracketed
from regscribe.emit.markdown.page_values import Titled, table
from regscribe.emit.markdown.register_facts import transmission, view_type
from regscribe.emit.outline import Leaf, formula
from regscribe.emit.words import (
    Wording,
    bits_words,
    conversion_words,
    one_line,
    part_words,
    range_words,
    when_words,
)
from regscribe.model import Condition, Enum, Kind, Model, Register, View

Rows = tuple[tuple[Md, ...], ...]

_WHEN = attrgetter("when")
MANY_BITS = 1 << 16
"""More bits than any value has."""


def views(context: PageContext, leaf: Leaf) -> tuple[Titled, ...]:
    """Return the table of views of a register that has several, once or by model."""

    def rows(_: Model, register: Register) -> Rows:
        found: list[tuple[Md, ...]] = []
        apart = register.is_written_apart
        for view in register.views if len(register.views) > 1 else ():
            name = md(code(view.name), " (preferred)" if view is register.preferred and not apart else "")
            address, notations = _place(context, leaf, register, view)
            sent = transmission(context, view) if apart else Md()
            found.append((name, address, notations, escape(view_type(view)), sent))
        return tuple(found)

    headers = ("View", "Wire address", "Other notation", "Type", "Transmitted")
    return titled("Views", headers, leaf.register.states(rows))


def _place(context: PageContext, leaf: Leaf, register: Register, view: View) -> tuple[Md, Md]:
    """Return the address of a view, with its space where that is another than the base view's, and other notations."""
    space = f" ({SPACES[view.space]})" if view.space is not register.base.space else ""
    if leaf.arrays:
        return md(code(formula(view, register.at, leaf.arrays)), space), Md()
    address = view.address(register.at)
    notations = Md() if register.block else context.notations(view.space, address)
    return md(escape(context.place(view.space, address)), space), notations


def by_condition(context: PageContext, leaf: Leaf) -> tuple[Titled, ...]:
    """Return scale and range by condition: in one table where they depend on the same."""
    versions = ((model, _condition_rows(context, model, register)) for model, register in leaf.register.versions)
    shared = Merged(leaf.register.key, tuple(versions))

    def tables(title: str, headers: tuple[str, ...]) -> tuple[Titled, ...]:
        return titled(title, headers, shared.states(lambda _, rows: rows.get(title, ())))

    return (
        *tables("Scale and range", ("When", "Value from the stored number x", "Range")),
        *tables("Scale", ("When", "Value from the stored number x")),
        *tables("Range", ("When", "Range")),
    )


def _condition_rows(context: PageContext, model: Model, register: Register) -> dict[str, Rows]:
    """Return the rows of each table by its title."""
    wording = context.wording(model)
    scale, limits = register.scale, register.range
    scales: Rows = ()
    if len(scale) > 1:
        scales = tuple((Md(when_words(case.when, wording)), code(conversion_words(case.then))) for case in scale)
    ranges: Rows = ()
    if len(limits) != 1 or not limits[0].when.always:
        ranges = tuple((Md(when_words(case.when, wording)), Md(range_words(case.then, wording))) for case in limits)
    if scales and list(map(_WHEN, scale)) == list(map(_WHEN, limits)):
        return {"Scale and range": tuple((*row, words) for row, (_, words) in zip(scales, ranges, strict=True))}
    return {"Scale": scales, "Range": ranges}


def values(context: PageContext, leaf: Leaf) -> tuple[Titled, ...]:
    """Return the members of a register's enum and the codes that the manual calls invalid, a table for each case."""
    versions = leaf.register.versions
    columns = max((one.columns for _, each in versions if each.enum for one in each.enum.each), key=len, default=())
    rows: dict[str, list[tuple[str, tuple[Md, ...]]]] = {}
    for model, register in versions:
        for title, enum in _enums(register.enum, context.wording(model)):
            found = _enum_rows(enum, len(columns), context.wording(model))
            rows.setdefault(title, []).extend((model.name, row) for row in found)
    heads = (one_line(column).replace("_", " ") for column in columns)
    headers = ("Code", "Meaning", "In Python", *heads, "Exists while", "Remark", "Models")
    tables = (
        Titled(title, table(headers, sorted(_once(pairs, len(versions)), key=lambda row: int(row[0]))))
        for title, pairs in rows.items()
    )
    return tuple(one for one in tables if one.table.rows)


def _enums(enum: Enum | None, wording: Wording) -> Iterator[tuple[str, Enum]]:
    """Yield the enum of each case with the title of its table."""
    if enum and enum.cases:
        yield from ((Md(f"Values: {when_words(case.when, wording)}"), case.then) for case in enum.cases)
    elif enum:
        yield "Values", enum


def _enum_rows(enum: Enum, columns: int, wording: Wording) -> Rows:
    """A label that only repeats the cells is left out: they stand beside it."""
    rows: list[tuple[Md, ...]] = []
    for member in enum.members:
        cells = [escape(one_line(cell)) for cell in member.cells] + [Md()] * columns
        label = "" if member.label == ", ".join(member.cells) else one_line(member.label)
        number, while_ = escape(str(member.code)), _existence(member.when, wording)
        rows.append((number, escape(label), code(member.id), *cells[:columns], while_, prose(member.description)))
    for invalid, why in enum.invalid:
        rows.append((escape(str(invalid)), md("invalid"), Md(), *[Md()] * columns, Md(), prose(why)))
    return tuple(rows)


def _existence(when: Condition, wording: Wording) -> Md:
    return Md() if when.always else Md(wording.condition(when))


def bits(context: PageContext, leaf: Leaf) -> tuple[Titled, ...]:
    """Return the bits and fields of a register's word."""
    headers = ("Bits", "Meaning", "In Python", "Values", "Exists while", "Remark", "Models")
    versions = leaf.register.versions
    pairs = [(model.name, row) for model, one in versions for row in _bit_rows(one, context.wording(model))]
    rows = _once(pairs, len(versions))
    found = table(headers, sorted(rows, key=_lowest))
    return (Titled("Bits (0 is the least significant)", found),) if found.rows else ()


def _lowest(row: Sequence[str]) -> int:
    """The lowest bit of a row, behind all bits for that of none."""
    first = row[0].partition("..")[0]
    return int(first) if first.isdecimal() else MANY_BITS


def _bit_rows(register: Register, wording: Wording) -> Rows:
    rows: list[tuple[Md, ...]] = []
    for field in register.fields:
        name = field.id.upper() if register.kind is Kind.FLAGS else field.id  # a flag is an enum's member
        members = field.enum.members if field.enum else ()
        codes = ", ".join(f"{member.code} = {one_line(member.label)}" for member in members) or part_words(field)
        said = (escape(bits_words(field)), escape(one_line(field.label)), code(name), escape(codes))
        rows.append((*said, _existence(field.when, wording), prose(field.description)))
    if register.none:
        rows.append((md("none"), escape(one_line(register.none)), Md(), Md(), Md(), Md()))
    return tuple(rows)


def _once(pairs: Iterable[tuple[str, tuple[Md, ...]]], every: int) -> list[tuple[Md, ...]]:
    """Return the rows of models, each once, with the models that have it where not all have."""
    found = models_by(pairs)
    return [(*row, escape(", ".join(names)) if len(names) < every else Md()) for row, names in found.items()]


def titled(
    title: str, headers: tuple[str, ...], facts: Iterable[Stated[Rows]], *, folded: bool = False
) -> tuple[Titled, ...]:
    """Return a table for each set of models that share its rows; none where there are no rows."""
    return tuple(
        Titled(f"{title} ({', '.join(fact.models)})" if fact.models else title, table(headers, fact.value), folded)
        for fact in facts
        if fact.value
    )


def elements(context: PageContext, leaf: Leaf) -> tuple[Titled, ...]:
    """Return every address of a register in an array, folded."""
    if not leaf.arrays:
        return ()

    def address(model: Model, register: Register, view: View) -> Md:
        place = view.address(register.at)
        others = Md() if register.block else context.notations(view.space, place)
        return bracketed(model.spelled(view.space, place), others)

    def rows(model: Model, _: Register) -> Rows:
        items = context.elements[model.name, leaf.register.key]
        return tuple((code(item.path), *(address(model, item, view) for view in item.views)) for item in items)

    headers = ("Element", *(view.name for view in leaf.register.first.views))
    return titled("Address of every element", headers, leaf.register.states(rows), folded=True)
