"""How values are transmitted: views with formulas, named conditions, givens, identification, addresses not in use."""

from collections import Counter
from fractions import Fraction

from regscribe.emit.common_values import models_by
from regscribe.emit.markdown.context import SPACES, PageContext
from regscribe.emit.markdown.escape import Md, code, escape, md, prose
from regscribe.emit.markdown.notations import span
from regscribe.emit.markdown.page_values import PageTable, Titled, table
from regscribe.emit.markdown.register_facts import transmission, view_type
from regscribe.emit.outline import leaves
from regscribe.emit.words import condition_words, given_words, listed, one_line, when_words
from regscribe.model import Kind, Register, RegisterBlock, View, show

Shape = tuple[tuple[str, View], ...]
"""Address formula in n (the base view's address) and the rest of each view, its address left out."""


def plain(context: PageContext) -> tuple[Md, ...]:
    """Return sentences on the types of registers with one view, and on registers without a scale."""
    registers = [leaf.register.first for leaf in leaves(context.nodes)]
    counts = Counter(view_type(register.base) for register in registers if len(register.views) == 1)
    raw = sum(register.kind is Kind.RAW for register in registers)
    counted = listed([f"{count} as {name}" for name, count in counts.items()], last="and")
    found = [md(f"Registers with one view: {counted}.")] if counts else []
    if raw:
        found.append(md(f"Of {raw} registers the manual does not state the scale; they are read and written raw."))
    return tuple(found)


def views(context: PageContext) -> tuple[Titled, ...]:
    """Return each set of views that registers share, with the address of each view from the base address n.

    What is written at an address of its own tells so itself.
    """
    found: Counter[Shape] = Counter()
    for leaf in leaves(context.nodes):
        several = (one for _, one in leaf.register.versions if len(one.views) > 1 and not one.is_written_apart)
        found.update(dict.fromkeys(map(_shape, several)).keys())
    return tuple(
        Titled(
            f"{count} registers in {len(shape)} views (n is the wire address in the first)",
            _table(context, shape),
        )
        for shape, count in found.items()
    )


def _shape(register: Register) -> Shape:
    return tuple(
        (view_formula(view, register.base), view._replace(offset=0, preferred=view is register.preferred))
        for view in register.views
    )


def view_formula(view: View, base: View) -> str:
    """Return a view's address from the base address n: `n + 1000`, `8000 + 2*n`."""
    if view is base:
        return "n"
    step = Fraction(view.stride, base.stride)
    offset = view.offset - step * base.offset
    slope = "n" if step == 1 else f"{show(step)}*n"
    return slope if not offset else f"{show(offset)} + {slope}" if offset > 0 else f"{slope} - {show(-offset)}"


def _table(context: PageContext, shape: Shape) -> PageTable:
    headers = ("View", "Wire address", "Addresses", "Type", "Transmitted")
    rows = (
        (
            md(code(view.name), " (preferred)" if view.preferred else ""),
            code(formula),
            escape(f"{view.region[0]} to {view.region[1]}") if view.region else Md(),
            escape(view_type(view)),
            transmission(context, view),
        )
        for formula, view in shape
    )
    return table(headers, rows)


def conditions(context: PageContext) -> PageTable:
    """Return the named conditions with their meaning; each name is an anchor."""
    rows = (
        (
            _target(context.anchor("condition", name), name.replace("_", " ")),
            Md(condition_words(item, model, context.wording(model))),
        )
        for name, (model, item) in context.conditions.items()
    )
    return table(("Condition", "Holds if"), rows)


def _target(anchor: str, name: str) -> Md:
    return md(Md(f'<a id="{anchor}"></a>'), name)


def units(context: PageContext) -> PageTable:
    """Return the units that depend on a condition; each name is an anchor."""
    rows = (
        (
            _target(context.anchor("unit", name), name) if index == 0 else Md(),
            Md(when_words(case.when, context.wording(model))),
            escape(one_line(case.then)),
        )
        for name, (model, cases) in context.units.items()
        for index, case in enumerate(cases)
    )
    return table(("Unit", "When", "Symbol"), rows)


def unit_notes(context: PageContext) -> PageTable:
    """Return what unit symbols of the map stand for."""
    return table(("Unit", "What it stands for"), ((code(name), prose(text)) for name, text in context.map.unit_notes))


def givens(context: PageContext) -> PageTable:
    """Return the arguments that the user of a driver must give, with their reasons."""
    rows = (
        (
            code(item.id),
            given_words(item),
            context.register(item.register) if item.register else Md(),
            prose(item.description),
            prose(item.reason),
        )
        for item in context.map.givens
    )
    return table(("Argument", "Type", "Codes of", "What it is", "Why it is asked"), rows)


def identity(context: PageContext) -> PageTable:
    """Return which models answer how."""
    wording = context.wording(context.map.models[0])
    rows: list[tuple[str, str]] = []
    for rule in context.map.identity:
        when, texts = rule.identity
        tests = [] if when.always and texts else [when_words(when, wording)]
        tests += [f"{wording.register(path)} begins with {wording.text(text)}" for path, text in texts]
        rows.append((Md(" and ".join(tests)), listed([one_line(name) for name in rule.models])))
    return table(("If", "The device is"), rows)


def blocks(context: PageContext) -> PageTable:
    """Return the blocks, and how a device tells where each begins."""
    rows = ((code(block.id), _base(block)) for block in context.map.blocks)
    return table(("Block", "Its base"), rows)


def _base(block: RegisterBlock) -> Md:
    if block.chain is None:
        return md("stated by the given ", code(block.given))
    which = f"the header of id {' or '.join(map(str, block.ids))}"
    which += f", number {block.number} of them" if block.number > 1 else ""
    chain = block.chain
    marker = f" behind the marker {' '.join(f'{word:04X}' for word in chain.marker)}" if chain.marker else ""
    at = " or ".join(map(str, chain.at))
    return md(f"{which}, in the chain of headers{marker} at {at}, whose end is id {chain.end}")


def reserved(context: PageContext) -> PageTable:
    """Return the addresses that the manual reserves."""
    found = context.map.reserved
    rows = ((SPACES[space], span(context.map, space, (low, high), space.spelled)) for space, low, high in found)
    return table(("Space", "Wire addresses"), rows)


def unused(context: PageContext) -> PageTable:
    """Return the addresses that the manual lists as unused, with the models where not all agree."""
    found = models_by(
        (model.name, (space, (low, high))) for model in context.map.models for space, low, high in model.unused
    )
    rows = (
        (SPACES[space], span(context.map, space, ends, space.spelled), context.covers(models))
        for (space, ends), models in found.items()
    )
    return table(("Space", "Wire addresses", "Models"), rows)
