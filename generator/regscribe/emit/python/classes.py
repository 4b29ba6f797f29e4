"""The classes of a generated module: shared parts, array elements, commands, groups and models."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from regscribe.emit.python.declare import Declarations
from regscribe.emit.python.families import Shared, bases, partition, suffix
from regscribe.emit.python.layout import INDENT, Expression, call, group, lay
from regscribe.emit.python.literals import camel, docstring, literal
from regscribe.emit.python.named import NamedClasses
from regscribe.emit.python.names import free
from regscribe.emit.python.pool import Pool
from regscribe.emit.python.specs import Specs
from regscribe.emit.text import one_line
from regscribe.model import Array, Command, Model, Register, RegisterMap

Members = Mapping[str, Sequence[Register | Array]]


@dataclass(slots=True)
class Classes:
    """Builds the class definitions of a map; `lines` grows in the order in which the module needs them."""

    register_map: RegisterMap
    named: NamedClasses
    pool: Pool
    stem: str
    lines: list[str] = field(default_factory=list)
    public: list[str] = field(default_factory=list)
    elements: dict[tuple[str, ...], str] = field(default_factory=dict)

    def build(self) -> None:
        """Emit everything."""
        models = self.register_map.models
        shared = self._family(self.stem, {model.name: model.members for model in models})
        commands = self._commands()
        self._groups()
        for model in models:
            self._model(model, bases(shared, model.name), commands.get(model.name))

    def _family(self, stem: str, members: Members) -> list[Shared[Register | Array]]:
        shared = partition(members, stem)
        for one in shared:
            declarations = Declarations(Specs(self.register_map.model(one.models[0]), self.pool), self.named)
            body: list[str] = []
            for item in one.items:
                body += self._array(item, one.models) if isinstance(item, Array) else declarations.lines(item)
            self._class(one.name, [], f"Registers of {', '.join(one.models)}.", body)
        return shared

    def _class(self, name: str, parents: Sequence[str], about: str, body: Sequence[str]) -> None:
        head = lay(call(name, *parents), head="class ", tail=":") if parents else [f"class {name}:"]
        blank = [""] if body else []
        self.lines += ["", "", *head, *docstring(about, 1), *blank, *body]

    def _array(self, array: Array, models: tuple[str, ...]) -> list[str]:
        # an array that models fill differently has an element class for each filling; the usual one has the plain name
        same = [one for model in self.register_map.models for one in _arrays(model.members) if one.id == array.id]
        usual = max(same, key=same.count)
        plain = camel(array.name) if camel(array.name).isidentifier() else camel(array.id)
        used = {*self.named.taken, *self.named.wanted, *self.public}
        name = free(plain + ("" if array == usual else suffix(models)), used, "Element")
        members = dict.fromkeys(models, array.members)
        parents = bases(self._family(name, members), models[0])
        about = f"One {one_line(array.name)} of {array.id} ({one_line(array.section)})."
        self._class(name, [*parents, "Part"], about, [])
        self._class(f"Async{name}", [*parents, "AsyncPart"], about, [])
        self.public += [name, f"Async{name}"]
        numbers = {"first": str(array.first), "count": str(array.count), "stride": str(array.stride)}
        what = f"{one_line(array.name)} {array.first} to {array.first + array.count - 1}: {one_line(array.section)}."
        return [
            *lay(call("Array", name, f"Async{name}", **numbers), head=f"{array.id} = ", depth=1),
            *docstring(what, 1),
        ]

    def _commands(self) -> dict[str, str]:
        owned = {model.name: model.commands for model in self.register_map.models if model.commands}
        shared = partition(owned, f"{self.stem}Commands")
        for one in shared:
            body: list[str] = []
            for command in one.items:
                body += [*lay(_steps(command), head=f"{command.id} = ", depth=1), *docstring(_command_text(command), 1)]
            self._class(one.name, [], f"Commands of {', '.join(one.models)}.", body)
        names: dict[tuple[str, ...], str] = {}
        parts = {model: tuple(bases(shared, model)) for model in owned}
        usual = max(parts.values(), key=list(parts.values()).count, default=())
        for own in parts.values():
            if own not in names:
                same = [model for model in owned if parts[model] == own]
                names[own] = f"{self.stem}Commands{'' if own == usual else suffix(same)}"
                self._class(names[own], [*own, "Part"], "The commands of a synchronous driver.", [])
                self._class(f"Async{names[own]}", [*own, "AsyncPart"], "The commands of an asyncio driver.", [])
        return {model: names[own] for model, own in parts.items()}

    def _groups(self) -> None:
        merged: dict[str, tuple[str, dict[str, None]]] = {}
        for model in sorted(self.register_map.models, key=lambda model: -len(model.registers)):
            for one in model.groups:
                _, members = merged.setdefault(one.id, (one.name, {}))
                members.update(dict.fromkeys(path.split("[")[0] for path in one.members))
        body: list[str] = []
        for name, (title, members) in merged.items():
            body += lay(call("Group", literal(one_line(title)), *map(literal, members)), head=f"{name} = ", depth=1)
        self._class(
            f"{self.stem}Groups", [], "Groups in the order of the manual; a model has what it has of them.", body
        )

    def _model(self, model: Model, parents: list[str], commands: str | None) -> None:
        about = [f"{one_line(self.register_map.maker)} {one_line(model.name)}", one_line(model.description)]
        for prefix in ("", "Async"):
            name, device = f"{prefix}{model.class_name}", f"{prefix}Device"
            if self.register_map.givens:
                device = f"_{prefix}{self.stem}Device"
            body = [
                f"{INDENT}model = {literal(model.name)}",
                f"{INDENT}map_id = {literal(self.register_map.id)}",
                f"{INDENT}protocol = _PROTOCOL",
                *self._identity(model),
                f"{INDENT}groups = {self.stem}Groups",
            ]
            if commands:
                body.append(f"{INDENT}commands = Section({commands}, Async{commands})")
            kind = "asyncio driver" if prefix else "synchronous driver"
            self._class(name, [*parents, device], f"{': '.join(filter(None, about))} ({kind}).", body)
            self.public.append(name)

    def _identity(self, model: Model) -> list[str]:
        specs = Specs(model, self.pool)
        shown = [
            call(
                "Identity",
                specs.when(one.when),
                *([group([group([literal(path), literal(text)]) for path, text in one.texts])] if one.texts else []),
            )
            for one in self.register_map.identity
            if model.name in one.models
        ]
        return lay(group(shown), head="identity = ", depth=1) if shown else []


def _arrays(members: Sequence[Register | Array]) -> Iterator[Array]:
    for member in members:
        if isinstance(member, Array):
            yield member
            yield from _arrays(member.members)


def _steps(command: Command) -> Expression:
    steps = []
    for step in command.steps:
        words = group([str(word) for word in step.words])
        steps.append(
            group(["0", str(step.wait), "()"] if step.wait else [str(step.function), str(step.address), words])
        )
    return call("Command", *steps, danger=literal(one_line(command.danger)) if command.danger else None)


def _command_text(command: Command) -> str:
    parts = [one_line(part) for part in (command.name, command.description, command.section) if part]
    danger = f"; dangerous: {one_line(command.danger)}" if command.danger else ""
    return f"{'; '.join(parts)}{danger}."
