"""Context of a page: anchors, named conditions, notations of addresses, words with links."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from regscribe.emit.common_values import Merged, T
from regscribe.emit.markdown.escape import Md, code, escape, lines, link, md, slug
from regscribe.emit.markdown.notations import bracketed, notations
from regscribe.emit.markdown.page_values import PageTable, table
from regscribe.emit.outline import Node, leaves, outline, pattern
from regscribe.emit.words import Wording, condition_words, one_line, spelled
from regscribe.model import Condition, Inferred, Model, Register, RegisterMap, Space, Units

SPACES = {
    Space.HOLDING: "Holding registers",
    Space.INPUT: "Input registers",
    Space.COIL: "Coils",
    Space.DISCRETE: "Discrete inputs",
    Space.STATUS: "Exception status",
    Space.FILE: "Records of files",
    Space.QUEUE: "FIFO queues",
    Space.IDENTIFICATION: "Device identification",
    Space.ENRON: "Registers of 32 bits (Enron)",
}


@dataclass(frozen=True, slots=True)
class PageContext:
    """A map, its registers merged over the models, and the anchors of everything that can be linked to.

    `conditions` are the named ones with a model that has them; `elements` the registers by model and pattern;
    `units` those that depend on a condition, with a model that uses them.
    """

    map: RegisterMap
    nodes: tuple[Node, ...]
    anchors: dict[str, str]
    conditions: dict[str, tuple[Model, Condition]]
    elements: dict[tuple[str, str], list[Register]]
    units: dict[str, tuple[Model, Units]]

    def anchor(self, kind: str, key: str) -> str:
        """Return the anchor of a register, group, command or condition; empty if the page has none."""
        return self.anchors.get(f"{kind} {key}", "")

    def register(self, path: str) -> Md:
        """Return a register's path as code, with a link to its details."""
        return link(code(spelled(path)), self.anchor("register", pattern(path)))

    def command(self, name: str) -> Md:
        """Return a command's id as code, with a link to its details."""
        return link(code(name), self.anchor("command", name))

    def wording(self, model: Model) -> Wording:
        """Return how phrases about one model are written."""
        return Wording(text=escape, register=self.register, condition=lambda item: self.condition(item, model))

    def condition(self, condition: Condition, model: Model) -> Md:
        """Return a condition's name with a link to its meaning, or its words."""
        listed = self.conditions.get(condition.name)
        if listed and listed[1] == condition:  # in an array, the same name may ask for registers of the same element
            return link(condition.name.replace("_", " "), self.anchor("condition", condition.name))
        return Md(condition_words(condition, model, self.wording(model)))

    def covers(self, models: Iterable[str]) -> Md:
        """Return the models in words; nothing if they are all models of the map."""
        names = tuple(models)
        return Md() if len(names) == len(self.map.models) else escape(", ".join(map(one_line, names)))

    def notations(self, space: Space, address: int) -> Md:
        """Return the other notations of an address: `0xFD1, absolute 44050`."""
        return notations(self.map, space, address)

    def place(self, space: Space, address: int) -> str:
        """Return an address as a model that has its page spells it."""
        page = space.page(address)
        models = (model for model in self.map.models if page and model.pages[page - 1].unit)
        return next(models, self.map.models[0]).spelled(space, address)

    def address(self, space: Space, address: int, block: str = "") -> Md:
        """Return an address with its other notations in brackets; none of one that counts from the base of a block."""
        return bracketed(self.place(space, address), Md() if block else self.notations(space, address))


def context(register_map: RegisterMap) -> PageContext:
    """Merge the models and name the anchors."""
    nodes = outline(register_map.models)
    versions = [version for leaf in leaves(nodes) for version in leaf.register.versions]
    conditions: dict[str, tuple[Model, Condition]] = {}
    for model, condition in _conditions(register_map, versions):
        if condition.name:
            conditions.setdefault(condition.name, (model, condition))
    units: dict[str, tuple[Model, Units]] = {}
    for model, register in versions:
        if register.unit_id and len(register.unit) > 1:
            units.setdefault(register.unit_id, (model, register.unit))
    elements: dict[tuple[str, str], list[Register]] = {}
    for model in register_map.models:
        for register in model.registers:
            elements.setdefault((model.name, pattern(register.path)), []).append(register)
    anchors = _anchors(_keys(register_map, nodes, conditions, units))
    return PageContext(register_map, nodes, anchors, conditions, elements, units)


def _conditions(
    register_map: RegisterMap, versions: Iterable[tuple[Model, Register]]
) -> Iterator[tuple[Model, Condition]]:
    """Yield every condition that a fact of a register or of an identification depends on."""
    for model, register in versions:
        for cases in (register.scale, register.unit, register.range, register.valid):
            yield from ((model, case.when) for case in cases)
        if register.writable:
            yield model, register.writable.when
        yield model, register.when
        yield from ((model, case.when) for case in register.partial)
        yield from ((model, sentinel.when) for sentinel in register.sentinels)
        yield from ((model, case.when) for case in register.follows)
        yield from ((model, field.follows) for field in register.fields if field.follows is not None)
    for model in register_map.models:
        for one in model.computed:
            yield model, one.when
            yield from ((model, case.when) for case in one.valid)
        for command in model.commands:
            yield model, command.when
            yield from ((model, step.when) for step in command.steps)
        for program in model.programs:
            yield from ((model, when) for when in program.conditions)
    for identity in register_map.identity:
        yield register_map.models[0], identity.identity.when


def _keys(
    register_map: RegisterMap, nodes: Iterable[Node], conditions: Iterable[str], units: Iterable[str]
) -> Iterator[str]:
    """Yield the kind and the key of everything that can be linked to."""
    yield from (f"register {leaf.register.key}" for leaf in leaves(nodes))
    for model in register_map.models:
        yield from (f"group {group.id}" for group in model.groups)
        yield from (f"command {command.id}" for command in model.commands)
        yield from (f"program {program.id}" for program in model.programs)
    yield from (f"condition {name}" for name in conditions)
    yield from (f"unit {name}" for name in units)


def _anchors(keys: Iterable[str]) -> dict[str, str]:
    anchors: dict[str, str] = {}
    taken: set[str] = set()
    for key in dict.fromkeys(keys):
        name = stem = slug(key)
        count = 2
        while name in taken:
            name, count = f"{stem}-{count}", count + 1
        anchors[key] = name
        taken.add(name)
    return anchors


def by_model(shared: Merged[T], fact: Callable[[Model, T], Md]) -> Md:
    """Return a fact on one line for each set of models that share it; models for which it is empty are left out."""
    if len(shared.versions) == 1:
        return fact(*shared.versions[0])
    return lines(
        *(
            md(Md("**"), ", ".join(item.models), Md(":** "), item.value) if item.models else item.value
            for item in shared.states(fact)
            if item.value
        )
    )


def fact_table(
    headers: tuple[str, str], shared: Merged[T], facts: Callable[[Model, T], Iterable[tuple[str, Md]]]
) -> PageTable:
    """Return the table of facts by label, each once or by model; one that is empty for every model is left out."""
    found = Merged(shared.key, tuple((model, dict(facts(model, item))) for model, item in shared.versions))

    def row(label: str) -> tuple[str, Md]:
        return label, by_model(found, lambda _, words: words[label])

    return table(headers, [row(label) for label in found.first if any(words[label] for _, words in found.versions)])


def source(section: str) -> Md:
    """Return the section of the manual; empty if the map does not say."""
    return md("section ", one_line(section)) if section else Md()


def only(context: PageContext, models: Iterable[str]) -> Md:
    """Return `only` with the models that have something; empty if all have it."""
    names = context.covers(models)
    return md("only ", names) if names else Md()


def conclusions(found: Iterable[Inferred]) -> tuple[Md, ...]:
    """Return remarks on what was inferred, not read in the manual, each once."""
    return tuple(md("Inferred: ", item.what, " (", item.why, ")") for item in dict.fromkeys(found))
