"""The tables below a register's facts: views, scale and range by condition, values, bits, addresses of elements."""

from collections.abc import Callable, Iterable
from operator import attrgetter

from regscribe.emit.common_values import Merged, Stated, models_by
from regscribe.emit.markdown.context import SPACES, PageContext
from regscribe.emit.markdown.escape import Md, code, escape, md, prose
from regscribe.emit.markdown.page_values import Titled, table
from regscribe.emit.markdown.register_facts import transmission, view_type
from regscribe.emit.outline import Leaf, formula
from regscribe.emit.words import bits_words, conversion_words, one_line, part_words, range_words, when_words
from regscribe.model import Enum, Kind, Model, Register, View

Rows = tuple[tuple[Md, ...], ...]

_WHEN = attrgetter("when")


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
    return md(escape(view.space.spelled(address)), space), notations


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


def values(leaf: Leaf) -> tuple[Titled, ...]:
    """Return the members of a register's enum and the codes that the manual calls invalid."""
    enums = [register.enum for _, register in leaf.register.versions if register.enum]
    columns = max((enum.columns for enum in enums), key=len, default=())
    rows = _by_model(leaf.register, lambda register: _enum_rows(register.enum, len(columns)))
    heads = (one_line(column).replace("_", " ") for column in columns)
    headers = ("Code", "Meaning", "In Python", *heads, "Remark", "Models")
    found = table(headers, sorted(rows, key=lambda row: int(row[0])))
    return (Titled("Values", found),) if found.rows else ()


def _enum_rows(enum: Enum | None, columns: int) -> Rows:
    """A label that only repeats the cells is left out: they stand beside it."""
    rows: list[tuple[Md, ...]] = []
    for member in enum.members if enum else ():
        cells = [escape(one_line(cell)) for cell in member.cells] + [Md()] * columns
        label = "" if member.label == ", ".join(member.cells) else one_line(member.label)
        number = escape(str(member.code))
        rows.append((number, escape(label), code(member.id), *cells[:columns], prose(member.description)))
    for invalid, why in enum.invalid if enum else ():
        rows.append((escape(str(invalid)), md("invalid"), Md(), *[Md()] * columns, prose(why)))
    return tuple(rows)


def bits(leaf: Leaf) -> tuple[Titled, ...]:
    """Return the bits and fields of a register's word."""
    headers = ("Bits", "Meaning", "In Python", "Values", "Remark", "Models")
    rows = _by_model(leaf.register, _bit_rows)
    found = table(headers, sorted(rows, key=lambda row: int(row[0].partition("..")[0])))
    return (Titled("Bits (0 is the least significant)", found),) if found.rows else ()


def _bit_rows(register: Register) -> Rows:
    rows: list[tuple[Md, ...]] = []
    for field in register.fields:
        name = field.id.upper() if register.kind is Kind.FLAGS else field.id  # a flag is an enum's member
        members = field.enum.members if field.enum else ()
        codes = ", ".join(f"{member.code} = {one_line(member.label)}" for member in members) or part_words(field)
        label = escape(one_line(field.label))
        rows.append((escape(bits_words(field)), label, code(name), escape(codes), prose(field.description)))
    return tuple(rows)


def _by_model(shared: Merged[Register], rows: Callable[[Register], Rows]) -> list[tuple[Md, ...]]:
    """Return the rows of all models, each once, with the models that have it where not all have."""
    found = models_by((model.name, row) for model, register in shared.versions for row in rows(register))
    every = len(shared.versions)
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

    def rows(model: Model, _: Register) -> Rows:
        items = context.elements[model.name, leaf.register.key]
        return tuple(
            (code(item.path), *(escape(view.space.spelled(view.address(item.at))) for view in item.views))
            for item in items
        )

    headers = ("Element", *(view.name for view in leaf.register.first.views))
    return titled("Address of every element", headers, leaf.register.states(rows), folded=True)
