"""How values are transmitted: views with their address formulas, named conditions, givens, identification."""

from fractions import Fraction

from regscribe.emit.markdown.context import SPACES, PageContext
from regscribe.emit.markdown.escape import Md, code, escape, md, prose
from regscribe.emit.markdown.page_values import PageTable, Titled, table
from regscribe.emit.markdown.register_facts import transmission, view_type
from regscribe.emit.outline import leaves
from regscribe.emit.words import Wording, condition_words, listed, one_line, span_words, when_words
from regscribe.model import GivenKind, IdentityRule, Kind, Register, View, show

Shape = tuple[tuple[str, View], ...]
"""Address formula in n (the base view's address) and the rest of each view, its address left out."""


def plain(context: PageContext) -> tuple[Md, ...]:
    """Return how the registers with one view are transmitted, and what cannot be scaled."""
    counts: dict[str, int] = {}
    raw = 0
    for leaf in leaves(context.nodes):
        register = leaf.register.first
        raw += register.kind is Kind.RAW
        if len(register.views) == 1:
            counts[view_type(register.base)] = counts.get(view_type(register.base), 0) + 1
    found = [md(f"Registers with one view: {_counted(counts)}.")] if counts else []
    if raw:
        found.append(md(f"Of {raw} registers the manual does not state the scale; they are read and written raw."))
    return tuple(found)


def _counted(counts: dict[str, int]) -> str:
    return listed([f"{count} as {name}" for name, count in counts.items()], last="and")


def views(context: PageContext) -> tuple[Titled, ...]:
    """Return each set of views that registers share, with the address of each view from the base address n."""
    found: dict[Shape, int] = {}
    for leaf in leaves(context.nodes):
        shapes = dict.fromkeys(_shape(register) for _, register in leaf.register.versions if len(register.views) > 1)
        for shape in shapes:
            found[shape] = found.get(shape, 0) + 1
    return tuple(Titled(_title(shape, count), _table(context, shape)) for shape, count in found.items())


def _title(shape: Shape, count: int) -> str:
    return f"{count} registers in {len(shape)} views (n is the wire address in the first)"


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
            _named(context.anchor("condition", name), name.replace("_", " ")),
            Md(condition_words(item, model, context.wording(model))),
        )
        for name, (model, item) in context.conditions.items()
    )
    return table(("Condition", "Holds if"), rows)


def _named(anchor: str, name: str) -> Md:
    return md(Md(f'<a id="{anchor}"></a>'), name)


def units(context: PageContext) -> PageTable:
    """Return the units that depend on a condition; each name is an anchor."""
    rows = (
        (
            _named(context.anchor("unit", name), name) if index == 0 else Md(),
            Md(when_words(case.when, context.wording(model))),
            escape(one_line(case.then)),
        )
        for name, (model, cases) in context.units.items()
        for index, case in enumerate(cases)
    )
    return table(("Unit", "When", "Symbol"), rows)


def givens(context: PageContext) -> PageTable:
    """Return what the user of a driver must supply, and why."""
    rows = (
        (
            code(item.id),
            "set of codes" if item.kind is GivenKind.CODES else "True or False",
            context.register(item.register) if item.register else Md(),
            prose(item.description),
            prose(item.reason),
        )
        for item in context.map.givens
    )
    return table(("Argument", "Type", "Codes of", "What it is", "Why it is asked"), rows)


def identity(context: PageContext) -> PageTable:
    """Return which models answer how."""
    first = context.map.models[0]
    rows = (
        (_identity_words(item, context.wording(first)), listed([one_line(name) for name in item.models]))
        for item in context.map.identity
    )
    return table(("If", "The device is"), ((Md(when), names) for when, names in rows))


def _identity_words(rule: IdentityRule, wording: Wording) -> str:
    item = rule.identity
    texts = [f"{wording.register(path)} begins with {wording.text(text)}" for path, text in item.texts]
    asked = [] if item.when.always and texts else [when_words(item.when, wording)]
    return " and ".join([*asked, *texts])


def reserved(context: PageContext) -> PageTable:
    """Return the addresses that the manual reserves."""
    rows = ((SPACES[space], span_words(low, high)) for space, low, high in context.map.reserved)
    return table(("Space", "Wire addresses"), rows)
