"""The classes of a generated module: shared parts, array elements, commands, groups and models."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from regscribe.emit.common_values import models_by
from regscribe.emit.header import HASH_DIGITS
from regscribe.emit.python.class_sharing import Shared, partition, suffix
from regscribe.emit.python.constants import Pool
from regscribe.emit.python.enum_classes import NamedClasses
from regscribe.emit.python.expressions import Specs, expression
from regscribe.emit.python.formatting import INDENT, call, flat, group, lay
from regscribe.emit.python.groups import groups_body, with_group_facts
from regscribe.emit.python.literals import camel, docstring, literal, member
from regscribe.emit.python.register_lines import (
    Declarations,
    command_call,
    command_text,
    declaration_lines,
    takes_lines,
)
from regscribe.emit.python.reserved_names import free
from regscribe.emit.words import one_line, term_words
from regscribe.model import Array, Chain, Model, Register, RegisterMap
from regscribe_runtime.values.facts import Page as PageFacts

Members = Mapping[str, Sequence[Register | Array]]


@dataclass(slots=True)
class Classes:
    """Builds the class definitions of a map; `lines` grows in the order in which the module needs them.

    `homes` are the classes that declare the registers and arrays of the models, by id.
    """

    register_map: RegisterMap
    named: NamedClasses
    pool: Pool
    stem: str
    lines: list[str] = field(default_factory=list)
    public: list[str] = field(default_factory=list)
    homes: dict[str, str] = field(default_factory=dict)

    def build(self) -> None:
        """Emit everything."""
        models = self.register_map.models
        shared = self._family(self.stem, {model.name: model.members for model in models})
        for one in shared:
            self.homes = {item.id: one.name for item in one.items} | self.homes
        commands = self._commands()
        about = "Groups in the order of the manual; a model has what it has of them."
        self._class(f"{self.stem}Groups", [], about, groups_body(self.register_map, self.homes))
        self.public.append(f"{self.stem}Groups")
        for model in models:
            parents = [one.name for one in shared if model.name in one.models]
            self._model(model, parents, commands.get(model.name))

    def _family(self, stem: str, members: Members) -> list[Shared[Register | Array]]:
        """Emit the classes that declare what some models share."""
        shared = partition(members, self._namer(stem, members))
        for one in shared:
            self._class(one.name, [], f"Registers of {', '.join(one.models)}.", self._members(one))
        return shared

    def _members(self, shared: Shared[Register | Array]) -> list[str]:
        """The declarations of registers and arrays."""
        model = self.register_map.model(shared.models[0])
        declarations = Declarations(Specs(model, self.pool), self.named)
        registers = [item for item in shared.items if isinstance(item, Register)]
        calls = {register.id: declarations.call(register) for register in registers}
        calls = with_group_facts(registers, calls, self.pool, model)
        body: list[str] = []
        for item in shared.items:
            if isinstance(item, Array):
                body += self._array(item, shared.models)
            else:
                body += declaration_lines(item, calls[item.id])
        return body

    def _namer(self, stem: str, every: Iterable[str]) -> Callable[[Sequence[str]], str]:
        """What names the class of some of the models `every`."""
        everyone = tuple(every)
        return lambda models: self._free(f"_{stem}" if tuple(models) == everyone else f"_{stem}Of{suffix(models)}")

    def _free(self, name: str) -> str:
        found = free(name, self.pool.taken, "Own")
        self.pool.taken.add(found)
        return found

    def _class(self, name: str, parents: Sequence[str], about: str, body: Sequence[str]) -> None:
        head = lay(call(name, *parents), head="class ", tail=":") if parents else [f"class {name}:"]
        self.lines += ["", "", *head, *docstring(about, 1), *([""] if body else []), *body]

    def _array(self, array: Array, models: tuple[str, ...]) -> list[str]:
        name = self._element(array, models)
        numbers = {"first": str(array.first), "count": str(array.count), "stride": str(array.stride)}
        numbers |= {"to_end": "True"} if array.to_end else {}
        numbers |= {"counted": literal(array.counted)} if array.counted else {}
        numbers |= {"packed": "True"} if array.packed else {}
        many = ", as far as the block goes" if array.to_end else f", as {array.counted} says" if array.counted else ""
        what = (
            f"{one_line(array.name)} {array.first} to {array.first + array.count - 1}{many}: {one_line(array.section)}."
        )
        return [
            *lay(call("Array", name, f"Async{name}", **numbers), head=f"{array.id} = ", depth=1),
            *docstring(what, 1),
        ]

    def _element(self, array: Array, models: tuple[str, ...]) -> str:
        """The element class of an array that these models have, defined now."""
        # an array that models fill differently has an element class for each filling; the usual one has the plain name
        same = [one for model in self.register_map.models for one in arrays(model.members) if one.id == array.id]
        usual = max(same, key=same.count)
        plain = camel(array.name) if camel(array.name).isidentifier() else camel(array.id)
        used = {*self.named.taken, *self.named.wanted, *self.named.imported, *self.public}
        name = free(plain + ("" if array == usual else suffix(models)), used, "Element")
        shared = self._family(name, dict.fromkeys(models, array.members))
        about = f"One {one_line(array.name)} of {array.id} ({one_line(array.section)})."
        parents = [one.name for one in shared]
        self._class(name, [*parents, "Part"], about, [])
        self._class(f"Async{name}", [*parents, "AsyncPart"], about, [])
        self.public += [name, f"Async{name}"]
        return name

    def _commands(self) -> dict[str, str]:
        """Emit the classes of commands; the name of the one of each model that has commands."""
        # what a command changes in a device is no part of its declaration, so it does not tell models apart
        owned = {
            model.name: [replace(command, effects=()) for command in model.commands]
            for model in self.register_map.models
            if model.commands
        }
        shared = partition(owned, self._namer(f"{self.stem}Commands", owned))
        for one in shared:
            body: list[str] = []
            declarations = Declarations(Specs(self.register_map.model(one.models[0]), self.pool), self.named)
            for command in one.items:
                takes = self._free(f"_{command.id}") if command.arguments else ""
                self.lines += ["", "", *takes_lines(command, takes, declarations)] if takes else []
                body += lay(command_call(command, declarations, takes), head=f"{command.id} = ", depth=1)
                body += docstring(command_text(command), 1)
            self._class(one.name, [], f"Commands of {', '.join(one.models)}.", body)
        return self._command_classes({name: tuple(one.name for one in shared if name in one.models) for name in owned})

    def _command_classes(self, parents: Mapping[str, tuple[str, ...]]) -> dict[str, str]:
        """Emit a class for each set of parents; its name by model."""
        models = models_by(parents.items())
        usual = max(models, key=lambda own: len(models[own]), default=())
        names = {}
        for own, alike in models.items():
            names[own] = self._free(f"{self.stem}Commands{'' if own == usual else suffix(alike)}")
            self._class(names[own], [*own, "Part"], "The commands of a synchronous driver.", [])
            self._class(f"Async{names[own]}", [*own, "AsyncPart"], "The commands of an asyncio driver.", [])
        return {model: names[own] for model, own in parents.items()}

    def _model(self, model: Model, parents: Sequence[str], commands: str | None) -> None:
        about = [f"{one_line(self.register_map.maker)} {one_line(model.name)}", one_line(model.description)]
        device = f"{self.stem}Device" if self.register_map.givens else "Device"
        hidden = "_" if self.register_map.givens else ""
        for prefix in ("", "Async"):
            body = [
                f"{INDENT}model = {literal(model.name)}",
                f"{INDENT}map_id = {literal(self.register_map.id)}",
                f"{INDENT}map_sha256 = {literal(self.register_map.content_hash[:HASH_DIGITS])}",
                f"{INDENT}protocol = _PROTOCOL",
                *self._blocks(model),
                *self._pages(model),
                *([f"{INDENT}_unused = {self._unused(model)}"] if model.unused else []),
                *self._identity(model),
                *self._computed(model),
                f"{INDENT}groups = {self.stem}Groups",
                *([f"{INDENT}commands = SubPart({commands}, Async{commands})"] if commands else []),
                *([f"{INDENT}setpoint_programs = {self._programs(model)}"] if model.programs else []),
            ]
            kind = "asyncio driver" if prefix else "synchronous driver"
            name = f"{prefix}{model.class_name}"
            parent = f"{hidden}{prefix}{device}"
            self._class(name, [*parents, parent], f"{': '.join(filter(None, about))} ({kind}).", body)
            self.public.append(name)

    def _computed(self, model: Model) -> list[str]:
        lines = []
        for one in model.computed:
            stated = {
                "unit": literal(one.unit) if one.unit else None,
                "valid": expression(one.valid) if one.valid else None,
                "when": None if one.when.always else expression(one.when),
            }
            lines += lay(call("Computed", expression(one.term), **stated), head=f"{one.id} = ", depth=1)
            lines += docstring(f"{one_line(one.name)}: {term_words(one.term)}.", 1)
        return lines

    def _programs(self, model: Model) -> str:
        built = Specs(model, self.pool).of(model.programs)
        return self.pool.share(built, "programs", f"programs_{model.name}", comment="setpoint programs")

    def _pages(self, model: Model) -> list[str]:
        if not any(page.steps or page.unit for page in model.pages):
            return []
        pages = group([expression(PageFacts(page.steps, page.unit, page.at_once)) for page in model.pages])
        name = self.pool.share(pages, "pages", f"pages_{model.name}", comment="how each page is reached")
        return [f"{INDENT}_pages = {name}"]

    def _unused(self, model: Model) -> str:
        rows = [group([member(space), str(first), str(last)]) for space, first, last in model.unused]
        return self.pool.share(group(rows), "unused", f"unused_{model.name}", comment="addresses that read as 0")

    def _blocks(self, model: Model) -> list[str]:
        """The blocks that the model has registers or steps in."""
        used = {register.block for register in model.registers}
        used |= {step.block for command in model.commands for step in command.steps}
        blocks = [block for block in self.register_map.blocks if block.id in used]
        for chain in dict.fromkeys(block.chain for block in blocks if block.chain):
            self.pool.share(expression(chain), f"{chain.id}_chain")

        def known(value: object) -> str | None:
            return self.pool.names.get(flat(expression(value))) if isinstance(value, Chain) else None

        return lay(group([expression(block, known) for block in blocks]), head="_blocks = ", depth=1) if blocks else []

    def _identity(self, model: Model) -> list[str]:
        specs = Specs(model, self.pool)
        rules = [one for one in self.register_map.identity if model.name in one.models]
        shown = [specs.of(one.identity) for one in rules]
        return lay(group(shown), head="identity = ", depth=1) if shown else []


def arrays(members: Sequence[Register | Array]) -> list[Array]:
    """All arrays among the members and in them."""
    found = []
    for one in members:
        if isinstance(one, Array):
            found += [one, *arrays(one.members)]
    return found
