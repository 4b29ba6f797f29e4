"""The state of one simulated device: one stored value per register, shown coherently through all its views."""

from collections.abc import Collection, Mapping
from fractions import Fraction
from functools import reduce
from operator import or_
from threading import Lock
from types import MappingProxyType

from regscribe.model import NAN, BitField, CommandStep, Kind, Model, NotANumber, Register, RegisterMap, Space, parse
from regscribe.model.located import arrays_in, layout_of, located
from regscribe.reference import (
    Surroundings,
    existing_members,
    holds,
    part_bits,
    part_value,
    present_sentinels,
    version_text,
)
from regscribe.simulate.device import codec, octets
from regscribe.simulate.device.device_plan import AddressSpan, Blueprint, Image, Stored, draw
from regscribe.simulate.device.existence import exists, leaving_out
from regscribe.simulate.device.initial_values import initial_value
from regscribe.simulate.device.present_meaning import PresentMeaning
from regscribe.simulate.device.value_arguments import (
    GivenValue,
    Plain,
    fault_named,
    known_givens,
    number_of,
    with_field,
)
from regscribe.simulate.errors import SimulatorError
from regscribe_runtime.values.blocks import stated_bases
from regscribe_runtime.values.kinds import OCTETS

Value = Fraction | str
"""A value of use: the number in the unit of use, a text, or the id of a sentinel."""

_BLUEPRINTS: dict[tuple[int, str, tuple[object, ...]], Blueprint] = {}
"""The latest blueprints by map (the id of the object, which the blueprint keeps alive), model and givens."""
_MOST_BLUEPRINTS = 64
_LOCK = Lock()


def _key(known: Surroundings) -> frozenset[object]:
    every = (known.codes, known.facts, known.numbers, known.texts)
    return frozenset(item for each in every for item in each.items())


class DeviceState(PresentMeaning):
    """Stored values of one device, and the image of words that they show.

    The image is kept up to date at every change, so a read is a look-up. A write through any view sets the stored
    value, from which every other view and alias follows. What is as on a new device is kept once for all of its model.
    `touched` are the registers that changed since someone cleared it.
    """

    __slots__ = ("_driven", "_image", "_initial", "_pending", "_settling", "_stored", "touched")

    def __init__(self, blueprint: Blueprint) -> None:
        super().__init__(blueprint)
        self._stored: dict[str, Stored] = {}
        self._initial: set[str] = set()
        self._image: Image = {}
        self._pending: dict[str, Stored] = {}
        self._driven: frozenset[str] = frozenset()
        self._settling: frozenset[str] = frozenset()
        self.touched: set[str] = set()

    @classmethod
    def of(
        cls,
        register_map: RegisterMap,
        model: Model,
        givens: Mapping[str, GivenValue],
        bases: Mapping[str, int] = MappingProxyType({}),
        without: Collection[str] = (),
    ) -> "DeviceState":
        """The state of a new device; `bases` as in `layout_of`. SimulatorError where givens are not there."""
        known = known_givens(register_map, model, givens)
        model = leaving_out(model, without)
        bases = stated_bases(register_map.blocks, known.numbers) | dict(bases)
        layout = layout_of(register_map, model, bases)
        key = id(register_map), model.name, (*_key(known), *sorted(bases.items()), *sorted(without))
        blueprint = _BLUEPRINTS.get(key)
        if blueprint is None:
            placed = located(model, layout) if layout.headers else model
            blueprint = draw(register_map, placed, known, layout.words)
            cls(blueprint)._begin()  # noqa: SLF001 - its own
            with _LOCK:
                _BLUEPRINTS[key] = blueprint
                while len(_BLUEPRINTS) > _MOST_BLUEPRINTS:
                    del _BLUEPRINTS[next(iter(_BLUEPRINTS))]
        return cls(blueprint)

    def _begin(self) -> None:
        """Fill the blueprint with the stored values and the image of a new device."""
        for register in self._model.registers:
            self.stored(register.path)
        for register in self._model.registers:
            self._follow(register)
        self.wake()
        self.blueprint.stored.update(self._stored)
        for register in self._model.registers:
            self._show(register, self.blueprint.image)

    def words(self, space: Space, address: int, count: int) -> list[int | None]:
        """Return the word at each address as a read shows it; None where no readable register stands."""
        if self.blueprint.layout.conditional:
            return [self._word(space, each) for each in range(address, address + count)]
        base = self.blueprint.image[space].get
        own = self._image.get(space)
        if own is None:
            return [base(each) for each in range(address, address + count)]
        return [own.get(each, base(each)) for each in range(address, address + count)]

    def _word(self, space: Space, address: int) -> int | None:
        """As `words`, where registers may not exist, or several share an address."""
        if (space, address) not in self.blueprint.layout.conditional:
            return self._image.get(space, {}).get(address, self.blueprint.image[space].get(address))
        spans = self.blueprint.layout.conditional[space, address]
        shown = [self._shown(one, address) for one in spans if one.serves(writing=False) and self.exists(one.register)]
        bytes_only = all(one.view.is_byte for one in spans)  # the two bytes of a word are of two registers
        return None if not shown else reduce(or_, shown) if bytes_only else shown[0]

    def _shown(self, place: AddressSpan, address: int) -> int:
        words = codec.encode(self.seen(place.view), self.stored(place.register.path), self.order(place.view))
        return words[address - place.start]

    def place(self, space: Space, address: int, *, writing: bool = False) -> AddressSpan | None:
        """The value of a register that exists now and has a word at `address`; None if there is none."""
        return self.blueprint.layout.place_now(space, address, self.exists, writing=writing)

    def exists(self, register: Register) -> bool:
        """Whether a register exists now: its condition holds, and so do those of the registers that it asks."""
        return register.when.always or exists(register.when, self)

    def stored(self, path: str) -> Stored:
        """Return the stored value of the register `path`."""
        if path in self.blueprint.rereading:
            return self._reread(self._model.register(path))
        for kept in (self._stored, self.blueprint.stored):
            if path in kept:
                return kept[path]
        self._stored[path] = first = self._first(self._model.register(path))
        return first

    def _reread(self, register: Register) -> Stored:
        """What the words of another register are to one that reads them again; NaN where they are no value."""
        stored = codec.decode(self.seen(register.base), self.peek_words(register.path), self.order(register.base))
        return NAN if stored is None else stored

    def _store_again(self, register: Register, stored: Stored) -> None:
        """Give another register the words that one which reads them again is to have; none that are no value to it."""
        held, words = self._model.register(register.rereads), list(self.peek_words(register.rereads))
        words[self._inside(register)] = codec.encode(self.seen(register.base), stored, self.order(register.base))
        new = codec.decode(self.seen(held.base), words, self.order(held.base))
        if new is not None:
            self.store(held.path, new)

    def _inside(self, register: Register) -> slice:
        """Where the words of a register that reads again stand among those of the other."""
        before = register.address - self._model.register(register.rereads).address
        return slice(before, before + register.base.words)

    def store(self, path: str, stored: Stored) -> None:
        """Set the stored value of the register `path`, and all words that depend on it."""
        register = self._model.register(path)
        if register.rereads:
            self._store_again(register, stored)
            return
        self._stored[path] = self.quantise(register, stored) if isinstance(stored, Fraction) else stored
        self._show(register, self._image)
        if path not in self._pending:
            self._touch(path)

    def hold_back(self, path: str, former: Stored) -> None:
        """Keep `former` in effect for a register, although it shows another value, until `take_effect`."""
        self._pending.setdefault(path, former)
        self._touch(path)

    def take_effect(self, path: str) -> None:
        """Let the value that a register shows come into effect."""
        if self._pending.pop(path, None) is not None:
            self._touch(path)

    def wake(self) -> None:
        """Let each shadow take the value of its origin (which may be a shadow itself), as when power comes."""
        for register in self.blueprint.shadows:
            self.put(register.path, self._origin_value(register))

    @property
    def pending(self) -> Mapping[str, Stored]:
        """The stored values in effect of the registers whose shown value is not in effect yet, by path."""
        return dict(self._pending)

    def copy(self) -> "DeviceState":
        """Return a state of its own that holds the same."""
        other = DeviceState(self.blueprint)
        other.adopt(self)
        return other

    def adopt(self, other: "DeviceState") -> None:
        """Take over the stored values and the image of another state of the model."""
        stored, image, pending, self._driven = other._held()  # noqa: SLF001 - of its own kind
        self.touched.update(self._stored, stored)
        self._stored, self._pending = dict(stored), dict(pending)
        self._image = {space: dict(words) for space, words in image.items()}

    def _held(self) -> tuple[dict[str, Stored], Image, dict[str, Stored], frozenset[str]]:
        return self._stored, self._image, self._pending, self._driven

    def drive(self, path: str, *, alone: bool) -> None:
        """Stop a register from following others (`alone`), or let it follow them again."""
        self._driven = self._driven | {path} if alone else self._driven - {path}

    def put(self, subject: str, value: Plain) -> None:
        """Set a register or `register.field` to a value of use, as `poke` does, if it is not there already."""
        register, field = self.find(subject)
        new = self._changed(register, field, value)
        new = self.kept(register, new) if isinstance(new, Fraction) else new
        if new != self.stored(register.path):
            self.store(register.path, new)

    def _touch(self, path: str) -> None:
        """Update all that depends on the value in effect of a register: words in its order, and its followers."""
        self.touched.add(path)
        for dependent in self.blueprint.ordered_by.get(path, ()):
            self._show(dependent, self._image)
        for follower in self.blueprint.followers.get(path, ()):
            self._follow(follower)

    def set_bits(self, register: Register) -> None:
        """Set and clear the bits of a register that follow a condition, whatever was written there."""
        held = self.stored(register.path)
        stored = self._with_bits(register, held)
        if stored != held and register.path not in self._driven:
            self.store(register.path, stored)

    def _follow(self, register: Register) -> None:
        path = register.path
        if path in self._driven or path in self._settling:  # the latter: a circle, which has to end somewhere
            return
        before = self._settling
        self._settling = before | {path}
        try:
            stored = self._followed(register)
            if stored != self.stored(path):
                self.store(path, stored)
        finally:
            self._settling = before

    def _followed(self, register: Register) -> Stored:
        stored = self.stored(register.path)
        source = self.source(register)
        if source:
            stored = self.in_effect(source)
            if isinstance(stored, Fraction) and self._model.register(source).scale != register.scale:
                stored = self.quantise(register, self.from_value(register, self.look_up(source)))
        return self._with_bits(register, stored)

    def _with_bits(self, register: Register, stored: Stored) -> Stored:
        for field in register.fields:
            if field.follows is not None and isinstance(stored, Fraction):
                stored = with_field(stored, field, Fraction(int(holds(field.follows, self))))
        return stored

    def in_effect(self, path: str) -> Stored:
        """Return the stored value that counts now: that which a register shows, or the one before it if held back."""
        return self._pending[path] if path in self._pending else self.stored(path)

    def peek(self, path: str) -> Value:
        """Return the present value of a register, or of `register.field`: exact number, text, or the id of a sentinel.

        A number is in the unit of use: scale and decimals are applied as the present state has them. SimulatorError
        if there is no such register.
        """
        register, field = self.find(path)
        stored = self.stored(register.path)
        if field is None or not isinstance(stored, Fraction):
            return self.meant(register, stored)
        value = part_value(field, int(stored))
        return value if isinstance(value, Fraction) else value.id

    def fault(self, register: Register, stored: Stored) -> str:
        """Return the id of the sentinel that a stored number is; empty where it is none."""
        return next((each.id for each in present_sentinels(register, self) if each.reports(stored)), "")

    def meant(self, register: Register, stored: Stored) -> Value:
        """Return the value of use of a stored value, or the id of the sentinel that it is (`nan` without one)."""
        if isinstance(stored, str):
            return octets.meant(register, stored, present_sentinels(register, self))
        fault = self.fault(register, stored)
        if fault or not isinstance(stored, Fraction):
            return fault or NAN.value
        if register.kind is Kind.VERSION:
            value = self.to_value(register, stored)
            return version_text(register, value) or value
        return self.number(register, stored)

    def poke(self, path: str, value: Plain) -> None:
        """Set a register, or `register.field`, to a value of use, whatever its access and range (as a process would).

        A text is a text, a number in decimals, or the id of a sentinel, a special value or an enum member; LOW_FAULT
        and HIGH_FAULT are the register's own sentinels. SimulatorError for a register that counts packed elements: a
        simulated device has as many as there may be.
        """
        register, field = self.find(path)
        if any(array.packed and array.counted == register.path for array in arrays_in(self._model.members)):
            message = f"register {path!r} counts elements, of which a simulated device has as many as there may be"
            raise SimulatorError(message)
        self._pending.pop(register.path, None)
        self.store(register.path, self._changed(register, field, value))

    def peek_words(self, path: str, view: str = "") -> tuple[int, ...]:
        """Return the words that a view (default: the base view) transmits now; of a write-only register too."""
        register, _ = self.find(path)
        if register.rereads:
            return self.peek_words(register.rereads)[self._inside(register)]
        shown = next((each for each in register.views if view in ("", each.name)), None)
        if shown is None:
            names = ", ".join(each.name for each in register.views)
            message = f"register {register.path!r} has no view {view!r}: it has {names}"
            raise SimulatorError(message)
        return codec.encode(self.seen(shown), self.stored(register.path), self.order(shown))

    def shows(self, step: CommandStep, path: str) -> bool:
        """Whether a register holds what a step writes to it."""
        register = self._model.register(path)
        view = next(each for each in register.views if each.address(register.at) == step.address)
        return self.peek_words(path, view.name) == step.words

    def _first(self, register: Register) -> Stored:
        if register.path in self._initial:  # a circle of dependencies: one of them must begin
            return Fraction(0)
        self._initial.add(register.path)
        value = self._origin_value(register) if register.shadows else initial_value(register, self)
        stored = self._to_stored(register, value)
        return self.quantise(register, stored) if isinstance(stored, Fraction) else stored

    def _origin_value(self, shadow: Register) -> Stored:
        return self.usable(self._model.register(shadow.shadows), self.stored(shadow.shadows))

    def _changed(self, register: Register, field: BitField | None, value: Plain) -> Stored:
        """Return the stored value of a register after it, or its bit field, is set to a value of use."""
        stored = self.stored(register.path)
        if field is None or not isinstance(stored, Fraction):
            return self._to_stored(register, value)
        number = number_of(register, field, value)
        bits = part_bits(field, number) if field.is_number else None
        return with_field(stored, field, number if bits is None else Fraction(bits))

    def _to_stored(self, register: Register, value: Plain) -> Stored:
        if register.kind in OCTETS:
            return octets.stored(register, str(value))
        if isinstance(value, NotANumber):
            whole = [view.name for view in register.views if not view.type.is_float]
            if whole:
                message = (
                    f"register {register.path!r} cannot hold {value.value}: view {whole[0]} has whole numbers only"
                )
                raise SimulatorError(message)
            return value
        if isinstance(value, str):
            named = fault_named(register, value)
            if named is not None:
                return named
            if register.kind is Kind.VERSION:
                return parse(value.replace(".", ""))
        names = {each.id: self.special(register, each) for each in register.specials}
        names |= {each.id: Fraction(each.code) for each in existing_members(register, self)}
        names |= {register.none: Fraction(0)} if register.none else {}
        return self.from_value(register, number_of(register, None, value, names))

    def _show(self, register: Register, image: Image) -> None:
        if not register.access.readable:
            return
        stored = self.stored(register.path)
        for place in self.blueprint.places[register.path]:
            if not place.view.readable:
                continue
            words = codec.encode(self.seen(place.view), stored, self.order(place.view))
            image.setdefault(place.view.space, {}).update((each, words[each - place.start]) for each in place.addresses)
