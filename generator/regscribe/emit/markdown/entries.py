"""Registers, arrays and commands with their details, in groups."""

from collections.abc import Iterable

from regscribe.emit.common_values import Merged, merge
from regscribe.emit.markdown.alt_text import bit_fields, structure
from regscribe.emit.markdown.context import PageContext, by_model, conclusions, only, source
from regscribe.emit.markdown.details import Rows, bits, by_condition, elements, titled, values, views
from regscribe.emit.markdown.escape import Md, code, escape, join, lines, link, md, prose
from regscribe.emit.markdown.overview import addresses
from regscribe.emit.markdown.page_values import PageSection, PageTable, RegisterEntry, Titled
from regscribe.emit.markdown.process import effects
from regscribe.emit.markdown.register_facts import KINDS, facts, indices, scale, specials, transmission, view_type
from regscribe.emit.outline import Branch, Leaf, Node, lettered
from regscribe.emit.words import LETTERS, one_line, range_words, spelled
from regscribe.model import Array, Command, CommandStep, Enum, Group, Model, Register

HEADING = "####"
DOT = " · "
STEPS = ("Step", "Request", "Function", "Wire address", "Register", "Words", "Words (hex)")
LONG = 4
"""Values that a table may have and still be repeated at each register that uses them."""


def sections(context: PageContext) -> tuple[PageSection, ...]:
    """Return the groups of all models in the manual's order, each with its registers."""
    nodes: dict[str, list[Node]] = {}
    for node in context.nodes:
        nodes.setdefault(node.group, []).append(node)
    groups = merge(context.map.models, lambda model: model.groups, lambda group: group.id)
    shown: dict[PageTable, Leaf] = {}
    found = [_section(context, group, _entries(context, nodes.pop(group.key, []), shown, HEADING)) for group in groups]
    rest = [node for members in nodes.values() for node in members]
    if rest:
        entries = _entries(context, rest, shown, HEADING)
        found.append(PageSection(anchor="other-registers", name="Other registers", summary=Md(), entries=entries))
    return tuple(found)


def _section(context: PageContext, group: Merged[Group], entries: tuple[RegisterEntry, ...]) -> PageSection:
    order = f"number {group.first.order} in the order of writing" if group.first.order is not None else ""
    page = by_model(group, lambda model, item: _page(context, model, item))
    parts = (code(group.key), source(group.first.section), md(order), page, context.covers(group.models))
    return PageSection(
        anchor=context.anchor("group", group.key),
        name=one_line(group.first.name),
        summary=join(DOT, parts),
        paragraphs=_paragraphs(by_model(group, lambda _, item: prose(item.description))),
        entries=entries,
    )


def _page(context: PageContext, model: Model, group: Group) -> Md:
    """Return the page that the registers of a group stand on, and what is written to select it."""
    number = next((model.register(path).page for path in group.members), 0)
    if not number:
        return Md()
    page = model.pages[number - 1]
    written = (
        md(context.register(path), " = ", value) for path, value in zip(page.selectors, page.values, strict=True)
    )
    if page.unit:
        return md(f"unit id {page.unit}")
    how = "selected by function 23 in the request that reads" if page.at_once else "selected by"
    return md(f"page {number}, {how} ", join(", ", written))


def _entries(
    context: PageContext, nodes: Iterable[Node], shown: dict[PageTable, Leaf], marks: str
) -> tuple[RegisterEntry, ...]:
    found: list[RegisterEntry] = []
    for node in nodes:
        if isinstance(node, Leaf):
            found.append(_register(context, node, shown, marks))
        else:
            found.append(_array(context, node, marks))
            found += _entries(context, node.children, shown, marks + "#" if len(marks) < len("######") else marks)
    return tuple(found)


def _register(context: PageContext, leaf: Leaf, shown: dict[PageTable, Leaf], marks: str) -> RegisterEntry:
    shared = leaf.register
    first = shared.first
    known, reference = _values(context, leaf, shown)
    cases = (*views(context, leaf), *by_condition(context, leaf))
    return RegisterEntry(
        marks=Md(marks),
        anchor=context.anchor("register", shared.key),
        name=one_line(first.name),
        summary=_summary(context, leaf),
        paragraphs=_paragraphs(
            by_model(shared, lambda _, item: prose(item.description)),
            by_model(shared, lambda _, item: prose(item.enum.description if item.enum else "")),
            reference,
        ),
        danger=_paragraphs(by_model(shared, lambda _, item: prose(item.danger))),
        pictures=bit_fields(context, leaf),
        facts=facts(context, leaf),
        tables=(*cases, *known, *bits(context, leaf), *elements(context, leaf)),
        remarks=conclusions(item for _, version in shared.versions for item in version.inferred),
    )


def _summary(context: PageContext, leaf: Leaf) -> Md:
    shared = leaf.register
    symbols = dict.fromkeys(_symbol(register) for _, register in shared.versions)
    sources = dict.fromkeys(one_line(register.section) for _, register in shared.versions)
    parts = (
        join(" or ", dict.fromkeys(_place(context, leaf, register) for _, register in shared.versions)),
        code(lettered(shared.first.path)),
        escape(", ".join(filter(None, symbols))),
        source(", ".join(filter(None, sources))),
        only(context, shared.models),
    )
    return join(DOT, parts)


def _place(context: PageContext, leaf: Leaf, register: Register) -> Md:
    """Return the space and the address, of an array from the first element to the last: `holding 4049 (0xFD1)`."""
    base = register.base
    if leaf.arrays:
        return md(f"{base.space} ", addresses(context, leaf, base, register))
    address = md(f"{base.space} ", context.address(base.space, register.address, register.block))
    return md(address, " from the base of block ", code(register.block)) if register.block else address


def _symbol(register: Register) -> str:
    """Return the short code; where it is a cleaned reading, with the code as printed."""
    symbol, printed = one_line(register.symbol), one_line(register.printed)
    if not printed or printed == symbol:
        return symbol
    return f"{symbol} (printed {printed})" if symbol else f"printed {printed}"


def _values(context: PageContext, leaf: Leaf, shown: dict[PageTable, Leaf]) -> tuple[tuple[Titled, ...], Md]:
    """Return the table of values, or where a long one was shown before."""
    found = values(context, leaf)
    if len(found) != 1 or len(found[0].table.rows) <= LONG:
        return found, Md()
    earlier = shown.setdefault(found[0].table, leaf)
    if earlier is leaf:
        return found, Md()
    name, anchor = one_line(earlier.register.first.name), context.anchor("register", earlier.register.key)
    return (), md("Values: the same as of ", link(name, anchor), ".")


def _array(context: PageContext, branch: Branch, marks: str) -> RegisterEntry:
    array = branch.array.first
    arrays = (*branch.arrays, array)
    parts = (
        code(".".join(f"{item.id}[{letter}]" for item, letter in zip(arrays, LETTERS, strict=False))),
        escape(f"{array.count} elements{_fewer(array)}"),
        Md("what stands behind moves up by those that a device lacks" if array.packed else ""),
        indices(arrays),
        escape(f"each {array.stride} addresses after the one before" if array.stride > 1 else ""),
        source(array.section),
        only(context, branch.array.models),
    )
    return RegisterEntry(
        marks=Md(marks),
        anchor="",
        name=f"{one_line(array.name)} {array.first} to {array.first + array.count - 1}",
        summary=join(DOT, parts),
        paragraphs=_paragraphs(by_model(branch.array, lambda _, item: prose(item.description))),
        pictures=structure(context, branch),
    )


def _paragraphs(*parts: Md) -> tuple[Md, ...]:
    return tuple(part for part in parts if part)


def commands(context: PageContext) -> tuple[RegisterEntry, ...]:
    """Return the commands of all models with their steps and dangers."""
    found = merge(context.map.models, lambda model: model.commands, lambda command: command.id)
    return tuple(_command(context, shared) for shared in found)


def _command(context: PageContext, shared: Merged[Command]) -> RegisterEntry:
    taken = ", ".join(f"{name}=..." for name, _ in shared.first.arguments)
    parts = (code(f"commands.{shared.key}({taken})"), source(shared.first.section), only(context, shared.models))
    return RegisterEntry(
        marks=Md("###"),
        anchor=context.anchor("command", shared.key),
        name=one_line(shared.first.name),
        summary=join(DOT, parts),
        paragraphs=_paragraphs(
            by_model(shared, lambda _, item: prose(item.description)),
            by_model(shared, lambda model, item: _exists(context, model, item)),
            by_model(shared, lambda model, item: effects(context, model, item.effects)),
        ),
        danger=_paragraphs(by_model(shared, lambda _, item: prose(item.danger))),
        tables=(
            *titled("Arguments", ARGUMENTS, shared.states(lambda model, command: _arguments(context, model, command))),
            *titled("Steps", STEPS, shared.states(lambda model, command: _steps(context, model, command))),
        ),
    )


def _exists(context: PageContext, model: Model, command: Command) -> Md:
    return Md() if command.when.always else md("It exists only if ", context.condition(command.when, model), ".")


ARGUMENTS = ("Name", "Value", "Range", "Unit", "Transmitted as", "What it is")


def _arguments(context: PageContext, model: Model, command: Command) -> Rows:
    return tuple(
        (
            code(name),
            lines(_taken(register), specials(register, context.wording(model))),
            Md("; ".join(range_words(case.then, context.wording(model)) for case in register.range)),
            escape(", ".join(case.then for case in register.unit if case.then)),
            join("; ", (md(view_type(register.base)), transmission(context, register.base), scale(register))),
            prose(register.description),
        )
        for name, register in command.arguments
    )


def _taken(register: Register) -> Md:
    return md(KINDS.get(register.kind, register.kind)) if register.enum is None else md(_codes(register.enum))


def _codes(enum: Enum) -> str:
    return ", ".join(f"{member.code} {one_line(member.label)}" for member in enum.members)


def _steps(context: PageContext, model: Model, command: Command) -> Rows:
    return tuple(_step(context, model, number, *each) for number, each in enumerate(command.named_steps, start=1))


def _step(context: PageContext, model: Model, number: int, step: CommandStep, path: str) -> tuple[Md, ...]:
    if not step.words:
        return md(str(number)), md(f"wait {step.wait} ms"), *[Md()] * (len(STEPS) - 2)
    register = context.register(path) if path else Md()
    words = step.argument or " ".join(map(str, step.words))
    hexadecimal = "" if step.space.is_bits or step.argument else " ".join(f"{word & 0xFFFF:04X}" for word in step.words)
    address = md(f"{step.block} + {step.address}") if step.block else context.address(step.space, step.address)
    when = md(" only if ", context.condition(step.when, model)) if not step.when.always else Md()
    cells = (str(number), md("write", when), f"{step.function:02d}", address, register, words, hexadecimal)
    return tuple(map(md, cells))


def _fewer(array: Array) -> str:
    """What says that a device may have fewer elements."""
    if array.counted:
        return f", or as many as {spelled(array.counted)} says"
    return ", or as many as the block has room for" if array.to_end else ""
