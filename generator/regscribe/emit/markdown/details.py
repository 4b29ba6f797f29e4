"""The tables below a register's facts: views, scale and range by condition, values, bits, addresses of elements."""

from collections.abc import Callable, Iterable

from regscribe.emit.common_values import Merged, Stated, models_by
from regscribe.emit.markdown.context import PageContext
from regscribe.emit.markdown.escape import Md, code, escape, md, prose
from regscribe.emit.markdown.page_values import Titled, table
from regscribe.emit.markdown.register_facts import view_type
from regscribe.emit.outline import Leaf, formula
from regscribe.emit.words import bits_words, conversion_words, one_line, range_words, when_words
from regscribe.model import Enum, Kind, Member, Model, Register

Rows = tuple[tuple[Md, ...], ...]


def views(context: PageContext, leaf: Leaf) -> tuple[Titled, ...]:
    """Return the table of views of a register that has several, once or by model."""
    facts = leaf.register.states(lambda _, register: _view_rows(context, leaf, register))
    return titled("Views", ("View", "Wire address", "Other notation", "Type"), facts)


def _view_rows(context: PageContext, leaf: Leaf, register: Register) -> Rows:
    if len(register.views) == 1:
        return ()
    return tuple(
        (
            md(code(view.name), " (preferred)" if view is register.preferred else ""),
            code(formula(view, register.at, leaf.arrays)) if leaf.arrays else escape(str(view.address(register.at))),
            Md() if leaf.arrays else context.notations(view.space, view.address(register.at)),
            escape(view_type(view)),
        )
        for view in register.views
    )


def by_condition(context: PageContext, leaf: Leaf) -> tuple[Titled, ...]:
    """Return scale and range by condition: in one table where they depend on the same."""
    shared = leaf.register
    both = shared.states(lambda model, register: _both_rows(context, model, register))
    scales = shared.states(lambda model, register: _scale_rows(context, model, register))
    ranges = shared.states(lambda model, register: _range_rows(context, model, register))
    return (
        *titled("Scale and range", ("When", "Value from the stored number x", "Range"), both),
        *titled("Scale", ("When", "Value from the stored number x"), scales),
        *titled("Range", ("When", "Range"), ranges),
    )


def _together(register: Register) -> bool:
    scale, limits = ([case.when for case in cases] for cases in (register.scale, register.range))
    return scale == limits and len(scale) > 1


def _both_rows(context: PageContext, model: Model, register: Register) -> Rows:
    if not _together(register):
        return ()
    pairs = zip(_scale(context, model, register), _limits(context, model, register), strict=True)
    return tuple((when, words, limits) for (when, words), (_, limits) in pairs)


def _scale_rows(context: PageContext, model: Model, register: Register) -> Rows:
    alone = len(register.scale) == 1 or _together(register)
    return () if alone else _scale(context, model, register)


def _range_rows(context: PageContext, model: Model, register: Register) -> Rows:
    plain = len(register.range) == 1 and register.range[0].when.always
    return () if plain or _together(register) else _limits(context, model, register)


def _scale(context: PageContext, model: Model, register: Register) -> Rows:
    wording = context.wording(model)
    return tuple((Md(when_words(case.when, wording)), code(conversion_words(case.then))) for case in register.scale)


def _limits(context: PageContext, model: Model, register: Register) -> Rows:
    wording = context.wording(model)
    return tuple((Md(when_words(case.when, wording)), Md(range_words(case.then, wording))) for case in register.range)


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
    if enum is None:
        return ()
    rows = [(member.code, _member_row(member, columns)) for member in enum.members]
    rows += [
        (number, (escape(str(number)), md("invalid"), Md(), *[Md()] * columns, prose(why)))
        for number, why in enum.invalid
    ]
    return tuple(row for _, row in sorted(rows, key=lambda row: row[0]))


def _member_row(member: Member, columns: int) -> tuple[Md, ...]:
    """A label that only repeats the cells is left out: they stand beside it."""
    cells = [escape(one_line(cell)) for cell in member.cells]
    label = "" if member.label == ", ".join(member.cells) else one_line(member.label)
    filled = (cells + [Md()] * columns)[:columns]
    return (escape(str(member.code)), escape(label), code(member.id), *filled, prose(member.description))


def bits(leaf: Leaf) -> tuple[Titled, ...]:
    """Return the bits and fields of a register's word."""
    headers = ("Bits", "Meaning", "In Python", "Values", "Remark", "Models")
    rows = _by_model(leaf.register, _bit_rows)
    found = table(headers, sorted(rows, key=lambda row: int(row[0].partition("..")[0])))
    return (Titled("Bits (0 is the least significant)", found),) if found.rows else ()


def _bit_rows(register: Register) -> Rows:
    return tuple(
        (
            escape(bits_words(field)),
            escape(one_line(field.label)),
            code(field.id.upper() if register.kind is Kind.FLAGS else field.id),  # a flag is an enum's member
            escape(_codes(field.enum)),
            prose(field.description),
        )
        for field in register.fields
    )


def _codes(enum: Enum | None) -> str:
    return ", ".join(f"{member.code} = {one_line(member.label)}" for member in enum.members) if enum else ""


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
    facts = leaf.register.states(lambda model, _: _element_rows(context, model, leaf))
    headers = ("Element", *(view.name for view in leaf.register.first.views))
    return titled("Address of every element", headers, facts, folded=True)


def _element_rows(context: PageContext, model: Model, leaf: Leaf) -> Rows:
    return tuple(
        (code(item.path), *(escape(str(view.address(item.at))) for view in item.views))
        for item in context.elements[model.name, leaf.register.key]
    )
