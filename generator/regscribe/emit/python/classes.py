"""The classes of a generated module: shared parts, array elements, commands, groups and models."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeVar

from regscribe.emit.header import HASH_DIGITS
from regscribe.emit.python import sets
from regscribe.emit.python.class_sharing import Shared, partition, suffix
from regscribe.emit.python.constants import Pool
from regscribe.emit.python.enum_classes import NamedClasses
from regscribe.emit.python.expressions import Specs
from regscribe.emit.python.formatting import INDENT, call, group, lay, mapping
from regscribe.emit.python.groups import groups_body, groups_of, same_groups
from regscribe.emit.python.keys import Keys, arrays, command_key
from regscribe.emit.python.literals import camel, docstring, literal, member
from regscribe.emit.python.offer import Declared, Groups, Offer, Origin, Part, chosen
from regscribe.emit.python.programs import programs
from regscribe.emit.python.register_lines import Declarations, command_call, command_text
from regscribe.emit.python.reserved_names import free
from regscribe.emit.words import one_line
from regscribe.model import Array, Command, Model, Register, RegisterMap

Members = Mapping[str, Sequence[Register | Array]]
T = TypeVar("T", Register | Array, Command)
COMMANDS = "commands"
"""What the parts of commands are parts of."""
IGNORED = "  # type: ignore[misc]"
"""Behind the head of a class that overrides something inherited by a declaration of another type, as it is meant to."""


@dataclass(frozen=True, slots=True)
class Parents:
    """The classes that together declare what a model has; whether one overrides another with another type."""

    origins: tuple[Origin, ...]
    clash: bool = False

    @property
    def names(self) -> list[str]:
        """Their names."""
        return [origin.name for origin in self.origins]


@dataclass(slots=True)
class Classes:
    """Builds the class definitions of a map; `lines` grows in the order in which the module needs them.

    `below` are those of the base, `offer` is what other modules have, `imports` what was taken of it. `built` and
    `told` (sets as this map uses them) by what they are parts of, `elements` and `commands` are what others may take of
    this one. `given` are the private names.
    """

    register_map: RegisterMap
    named: NamedClasses
    pool: Pool
    stem: str
    module: str
    offer: Offer
    below: "Classes | None" = None
    lines: list[str] = field(default_factory=list)
    public: list[str] = field(default_factory=list)
    imports: set[Origin] = field(default_factory=set)
    given: set[str] = field(default_factory=set)
    built: dict[str, list[Shared[Register | Array]]] = field(default_factory=dict)
    built_commands: list[Shared[Command]] = field(default_factory=list)
    told: dict[str, list[Part]] = field(default_factory=dict)
    elements: list[tuple[Array, str, Origin]] = field(default_factory=list)
    commands: dict[tuple[Origin, ...], Origin] = field(default_factory=dict)
    groups: Groups | None = None

    def build(self) -> None:
        """Emit everything."""
        models = self.register_map.models
        self._import_elements()
        parents = self._family(self.stem, "", {model.name: model.members for model in models})
        commands = self._commands()
        groups = self._groups()
        for model in models:
            self._model(model, parents[model.name], commands.get(model.name), groups)

    def build_library(self) -> None:
        """Emit the sets of a library, which stand for models here, and its commands."""
        declared = {model.name: model.members for model in self.register_map.models if model.members}
        for one in partition(declared, lambda names: self._free(f"_{suffix(names)}")):
            self._declare(
                one, "", ["RegisterSet"], f"Registers of {', '.join(one.models)}; each map tells their section."
            )
        self._commands()

    def keys(self, model: str) -> Keys:
        """The keys of what a model has."""
        return Keys(self.register_map.model(model), self.named)

    def _import_elements(self) -> None:
        for model in self.register_map.models if self.offer.elements else ():
            for array in arrays(model.members):
                found = self.offer.elements.get(self.keys(model.name).element(array))
                if found and found.name not in self.named.taken | self.named.imported:
                    self._import(found, Origin(found.module, f"Async{found.name}"), public=True)

    def _import(self, *origins: Origin, public: bool = False) -> None:
        self.imports.update(origins)
        self.public += [origin.name for origin in origins if public and origin.name not in self.public]

    def _family(self, stem: str, owner: str, members: Members) -> dict[str, Parents]:
        declared = {model: self._declared(owner, model, own) for model, own in members.items()}
        left, inherited, clashes = self._inherited(owner, members, declared)
        shared = partition(left, self._namer(stem, members))
        for one in shared:
            self._declare(one, owner, [], f"Registers of {', '.join(one.models)}.")
        return self._parents(shared, self._told(stem, owner, inherited), clashes)

    def _namer(self, stem: str, every: Iterable[str]) -> Callable[[Sequence[str]], str]:
        """What names the class of some of the models `every`."""
        everyone = tuple(every)
        return lambda models: self._free(f"_{stem}" if tuple(models) == everyone else f"_{stem}Of{suffix(models)}")

    def _declare(self, one: Shared[Register | Array], owner: str, parents: Sequence[str], about: str) -> None:
        """Emit the class that declares what some models share."""
        declarations = Declarations(Specs(self.register_map.model(one.models[0]), self.pool), self.named)
        body: list[str] = []
        for item in one.items:
            body += self._array(item, one.models, owner) if isinstance(item, Array) else declarations.lines(item)
        self._class(one.name, parents, about, body)
        self.built.setdefault(owner, []).append(one)

    def _told(self, stem: str, owner: str, inherited: Mapping[str, list[Part]]) -> dict[str, list[Part]]:
        """Emit the classes that tell of sets what this map says, and let them stand for the sets."""
        kept = {model: [part for part in parts if part.telling is None] for model, parts in inherited.items()}
        for telling in dict.fromkeys(part.telling for parts in inherited.values() for part in parts if part.telling):
            same = {model: [part for part in parts if part.telling == telling] for model, parts in inherited.items()}
            for one in partition(same, self._namer(f"{stem}{sets.name_of(telling)}", inherited)):
                names = [part.origin.name for part in one.items]
                self._class(one.name, names, sets.about(telling, one.models), [], told=sets.words(telling))
                items = {name: declared for part in one.items for name, declared in part.items.items()}
                part = Part(Origin(self.module, one.name), items)
                self.told.setdefault(owner, []).append(part)
                for model in one.models:
                    kept[model].append(part)
        return kept

    def _declared(self, owner: str, model: str, members: Sequence[Register | Array]) -> dict[str, Declared]:
        """Keys of a model's items, where there is something that they could be the same as."""
        offered = self.offer.sets or owner in self.offer.parts
        return {item.id: self.keys(model).of(item) for item in members} if offered else {}

    def _inherited(
        self, owner: str, members: Mapping[str, Sequence[T]], declared: Mapping[str, Mapping[str, Declared]]
    ) -> tuple[dict[str, list[T]], dict[str, list[Part]], set[str]]:
        """What each model still has to declare, the parts that it inherits, and the models that change a type."""
        left: dict[str, list[T]] = {}
        inherited: dict[str, list[Part]] = {}
        clashes = set()
        for model, own in members.items():
            found = declared[model]
            used: list[Part] = sets.told(self.offer.sets, found, own)
            parts = chosen([*self.offer.parts.get(owner, ()), *used], found)
            base = {name: one for part in parts for name, one in part.items.items()}
            changed = {name for name, one in base.items() if one != found[name]}
            left[model] = [item for item in own if item.id not in base or item.id in changed]
            inherited[model] = parts
            if any(base[name].type != found[name].type for name in changed):
                clashes.add(model)
            self._import(*(part.origin for part in parts))
        return left, inherited, clashes

    def _parents(
        self, shared: Sequence[Shared[Any]], inherited: Mapping[str, list[Part]], clashes: set[str]
    ) -> dict[str, Parents]:
        return {
            model: Parents(
                (
                    *(Origin(self.module, one.name) for one in shared if model in one.models),
                    *(part.origin for part in parts),
                ),
                clash=model in clashes,
            )
            for model, parts in inherited.items()
        }

    def _free(self, name: str) -> str:
        found = free(name, self.offer.names() | self.given, "Own")
        self.given.add(found)
        return found

    def _class(
        self,
        name: str,
        parents: Sequence[str],
        about: str,
        body: Sequence[str],
        *,
        more: str = "",
        clash: bool = False,
        told: Mapping[str, str] | None = None,
    ) -> None:
        keywords = {key: literal(text) for key, text in (told or {}).items()}
        head = lay(call(name, *parents, **keywords), head="class ", tail=":") if parents else [f"class {name}:"]
        head[0] += IGNORED if clash else ""
        blank = [""] if body else []
        self.lines += ["", "", *head, *docstring(about, 1, more), *blank, *body]

    def _array(self, array: Array, models: tuple[str, ...], owner: str) -> list[str]:
        name = self._element(array, models, owner)
        numbers = {"first": str(array.first), "count": str(array.count), "stride": str(array.stride)}
        what = f"{one_line(array.name)} {array.first} to {array.first + array.count - 1}: {one_line(array.section)}."
        return [
            *lay(call("Array", name, f"Async{name}", **numbers), head=f"{array.id} = ", depth=1),
            *docstring(what, 1),
        ]

    def _element(self, array: Array, models: tuple[str, ...], owner: str) -> str:
        """The element class of an array that these models have, defined now unless it is imported."""
        key = self.keys(models[0]).element(array) if self.offer.elements else ""
        if key and self.offer.elements.get(key) in self.imports:
            return self.offer.elements[key].name
        # an array that models fill differently has an element class for each filling; the usual one has the plain name
        same = [one for model in self.register_map.models for one in arrays(model.members) if one.id == array.id]
        usual = max(same, key=same.count)
        plain = camel(array.name) if camel(array.name).isidentifier() else camel(array.id)
        used = {*self.named.taken, *self.named.wanted, *self.named.imported, *self.public}
        name = free(plain + ("" if array == usual else suffix(models)), used, "Element")
        parents = self._family(name, f"{owner}/{array.id}", dict.fromkeys(models, array.members))[models[0]]
        about = f"One {one_line(array.name)} of {array.id} ({one_line(array.section)})."
        self._class(name, [*parents.names, "Part"], about, [], clash=parents.clash)
        self._class(f"Async{name}", [*parents.names, "AsyncPart"], about, [], clash=parents.clash)
        self.public += [name, f"Async{name}"]
        self.elements.append((array, models[0], Origin(self.module, name)))
        return name

    def _commands(self) -> dict[str, str]:
        owned = {model.name: model.commands for model in self.register_map.models if model.commands}
        declared = {model: {command.id: command_key(command) for command in own} for model, own in owned.items()}
        left, inherited, clashes = self._inherited(COMMANDS, owned, declared)
        shared = partition(left, self._namer(f"{self.stem}Commands", owned))
        for one in shared:
            body: list[str] = []
            for command in one.items:
                declaration = lay(command_call(command), head=f"{command.id} = ", depth=1)
                body += [*declaration, *docstring(command_text(command), 1)]
            self._class(one.name, [], f"Commands of {', '.join(one.models)}.", body)
        self.built_commands = shared
        parents = self._parents(shared, inherited, clashes)
        usual = max(parents.values(), key=list(parents.values()).count, default=None)
        for own in dict.fromkeys(parents.values()):
            same = [model for model, found in parents.items() if found == own]
            self.commands[own.origins] = self._command_class(own, "" if own == usual else suffix(same))
        return {model: self.commands[own.origins].name for model, own in parents.items()}

    def _command_class(self, parents: Parents, ending: str) -> Origin:
        offered = self.offer.commands.get(parents.origins)
        if offered:
            self._import(offered, Origin(offered.module, f"Async{offered.name}"))
            return offered
        name = self._free(f"{self.stem}Commands{ending}")
        self._class(name, [*parents.names, "Part"], "The commands of a synchronous driver.", [])
        self._class(f"Async{name}", [*parents.names, "AsyncPart"], "The commands of an asyncio driver.", [])
        return Origin(self.module, name)

    def _groups(self) -> str:
        own, base = groups_of(self.register_map), self.offer.groups
        if base and not base.groups.keys() <= own.keys():
            base = None  # a group that the map does not have must not be reachable
        same = same_groups(base.groups, own, self.register_map) if base else set()
        if base and same == own.keys():
            self._import(base.origin, public=True)
            self.groups = base
            return base.origin.name
        self._import(*([base.origin] if base and same else []))
        name = self._free(f"{self.stem}Groups")
        body = groups_body({group_id: one for group_id, one in own.items() if group_id not in same})
        about = "Groups in the order of the manual; a model has what it has of them."
        self._class(name, [base.origin.name] if base and same else [], about, body)
        self.groups = Groups(Origin(self.module, name), own)
        self.public.append(name)
        return name

    def _model(self, model: Model, parents: Parents, commands: str | None, groups: str) -> None:
        about = [f"{one_line(self.register_map.maker)} {one_line(model.name)}", one_line(model.description)]
        sections = {
            module: self.offer.sections[module]
            for module in sorted({origin.module for origin in parents.origins})
            if self.offer.sections.get(module)
        }
        for prefix in ("", "Async"):
            body = [
                f"{INDENT}model = {literal(model.name)}",
                f"{INDENT}map_id = {literal(self.register_map.id)}",
                f"{INDENT}map_sha256 = {literal(self.register_map.content_hash[:HASH_DIGITS])}",
                f"{INDENT}protocol = _PROTOCOL",
                *([f"{INDENT}_unused = {self._unused(model)}"] if model.unused else []),
                *self._identity(model),
                f"{INDENT}groups = {groups}",
                *([f"{INDENT}commands = SubPart({commands}, Async{commands})"] if commands else []),
                *([f"{INDENT}setpoint_programs = {self._programs(model)}"] if model.programs else []),
                *([f"{INDENT}_sections = {self._sections(sections)}"] if sections else []),
            ]
            kind = "asyncio driver" if prefix else "synchronous driver"
            told, more = f"{': '.join(filter(None, about))} ({kind}).", self.cited(sections)
            name = f"{prefix}{model.class_name}"
            self._class(name, [*parents.names, self._device(prefix)], told, body, more=more, clash=parents.clash)
            self.public.append(name)

    def cited(self, modules: Iterable[str]) -> str:
        """Which manuals inherited docstrings cite, if they number sections in another way."""
        below, titles = self.below, []
        found = {module for module in modules if self.offer.sections.get(module)}
        while below:
            titles += [below.register_map.title] if below.module in found else []
            below = below.below
        return (
            f" Inherited docstrings cite sections as the manual of {' and '.join(titles)} has them." if titles else ""
        )

    def _sections(self, sections: Mapping[str, Mapping[str, str]]) -> str:
        rows = [
            (literal(module), mapping([(literal(old), literal(new)) for old, new in chapters.items()]))
            for module, chapters in sections.items()
        ]
        return self.pool.share(
            "sections", mapping(rows), "chapters of manuals of siblings, as this manual numbers them"
        )

    def _programs(self, model: Model) -> str:
        return self.pool.share("programs", programs(model, Specs(model, self.pool)), "setpoint programs")

    def _unused(self, model: Model) -> str:
        rows = [group([member(space), str(first), str(last)]) for space, first, last in model.unused]
        return self.pool.share("unused", group(rows), "addresses that read as 0")

    def _device(self, prefix: str) -> str:
        """The class that a model's class stands on: that of the runtime, or one that takes the map's givens."""
        if not self.register_map.givens:
            return f"{prefix}Device"
        offered = self.offer.devices.get(givens_key(self.register_map))
        if offered is None:
            return f"_{prefix}{self.stem}Device"
        name = offered.name if not prefix else f"_{prefix}{offered.name.removeprefix('_')}"
        self._import(Origin(offered.module, name))
        return name

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


def givens_key(register_map: RegisterMap) -> str:
    """What makes the constructors of two maps the same."""
    return " ".join(f"{given.id}:{given.kind}" for given in register_map.givens)
