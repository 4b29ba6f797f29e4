"""The state of one simulated device: one stored value per register, shown coherently through all its views."""

from collections.abc import Mapping
from fractions import Fraction

from regscribe.model import (
    IDENTITY,
    BitField,
    Cases,
    Condition,
    Conversion,
    Decimals,
    Kind,
    Model,
    Order,
    Register,
    RegisterMap,
    Rounding,
    Space,
    View,
    exact,
)
from regscribe.model.reference import version_text
from regscribe.simulate import codec
from regscribe.simulate.blueprint import Blueprint, Image, Shelf, Stored, draw
from regscribe.simulate.errors import SimulatorError
from regscribe.simulate.givens import GivenValue, T
from regscribe.simulate.initial import initial_value
from regscribe.simulate.values import Plain, field_value, number_of, with_field

Value = Fraction | str
"""A value of use: what a person would say the register is."""

_SHELF = Shelf()


class State:
    """Stored values of one device, and the image of words that they show.

    The image is kept up to date at every change, so a read is a look-up. A write through any view sets the stored
    value, from which every other view and alias follows. What is as on a new device is kept once for all of its model.
    """

    __slots__ = ("_image", "_initial", "_model", "_stored", "blueprint", "givens")

    def __init__(self, blueprint: Blueprint) -> None:
        self.blueprint = blueprint
        self.givens = blueprint.givens
        self._model = blueprint.model
        self._stored: dict[str, Stored] = {}
        self._initial: set[str] = set()
        self._image: Image = {}

    @classmethod
    def of(cls, register_map: RegisterMap, model: Model, givens: Mapping[str, GivenValue]) -> "State":
        """The state of a new device. SimulatorError where the model needs givens that are not there."""
        givens = {name: value if isinstance(value, bool | str) else tuple(value) for name, value in givens.items()}
        blueprint = _SHELF.find(register_map, model, givens)
        if blueprint is None:
            blueprint = draw(register_map, model, givens)
            cls(blueprint)._begin()  # noqa: SLF001 - its own
            _SHELF.put(blueprint, givens)
        return cls(blueprint)

    def _begin(self) -> None:
        """Fill the blueprint with what a new device holds and shows."""
        for register in self._model.registers:
            self.blueprint.stored[register.path] = self.stored(register.path)
        for register in self._model.registers:
            self._show(register, self.blueprint.image)

    # -- the wire side ------------------------------------------------------------------------------------------

    def words(self, space: Space, address: int, count: int) -> list[int | None]:
        """Return what a read shows at each address; None where no readable register stands."""
        base = self.blueprint.image[space].get
        own = self._image.get(space)
        if own is None:
            return [base(each) for each in range(address, address + count)]
        return [own.get(each, base(each)) for each in range(address, address + count)]

    def stored(self, path: str) -> Stored:
        """Return what the device holds for the register `path`."""
        for kept in (self._stored, self.blueprint.stored):
            if path in kept:
                return kept[path]
        self._stored[path] = first = self._first(self._model.register(path))
        return first

    def store(self, path: str, stored: Stored) -> None:
        """Set what the device holds for the register `path`, and with it all words that depend on it."""
        register = self._model.register(path)
        self._stored[path] = stored if isinstance(stored, str) else self.quantise(register, stored)
        self._show(register, self._image)
        for dependent in self.blueprint.ordered_by.get(path, ()):
            self._show(dependent, self._image)

    def order(self, view: View) -> Order:
        """Return the word order of `view` now; where a register sets it to a code without meaning, the map's first."""
        if isinstance(view.word_order, Order):
            return view.word_order
        code = self.lookup(view.word_order.register)
        orders = dict(view.word_order.codes)
        return next((order for known, order in orders.items() if known == code), next(iter(orders.values()), Order.BIG))

    def quantise(self, register: Register, stored: Fraction) -> Fraction:
        """Round `stored` to what the device can hold: to the scale's step, else to what its views can tell apart."""
        step = self.conversion(register).step
        if step is None:
            if any(view.type.is_float for view in register.views):
                return stored
            step = 1 / max(view.factor for view in register.views)
        rounding = next((view.rounding for view in register.views if view.rounding is not Rounding.NONE), Rounding.NONE)
        return codec.round_to_whole(stored / step, rounding) * step

    # -- values of use ------------------------------------------------------------------------------------------

    def peek(self, path: str) -> Value:
        """Return the present value of a register, or of `register.field`: exact number, text, or the id of a sentinel.

        A number is in the unit of use: scale and decimals are applied as the present state has them. SimulatorError
        if there is no such register.
        """
        register, field = self._find(path)
        stored = self.stored(register.path)
        if isinstance(stored, str):
            return stored.rstrip("\0 ")
        if field is not None:
            return field_value(stored, field)
        sentinel = next((each.id for each in register.sentinels if each.stored == stored), None)
        if sentinel is not None:
            return sentinel
        value = self.to_value(register, stored)
        if register.kind is Kind.VERSION:
            return version_text(register, value) or value
        return next((each.means for each in register.specials if each.code == value and each.means is not None), value)

    def poke(self, path: str, value: Plain) -> None:
        """Set a register, or `register.field`, to a value of use, whatever its access and range (as a process would).

        A text is a text, a number in decimals, or the id of a sentinel, a special value or an enum member.
        """
        register, field = self._find(path)
        stored = self.stored(register.path)
        if field is None or isinstance(stored, str):
            self.store(register.path, self._to_stored(register, value))
        else:
            self.store(register.path, with_field(stored, field, number_of(register, field, value)))

    def peek_words(self, path: str, view: str = "") -> tuple[int, ...]:
        """Return the words that a view (default: the base view) transmits now; of a write-only register too."""
        register, _ = self._find(path)
        shown = next((each for each in register.views if view in ("", each.name)), None)
        if shown is None:
            names = ", ".join(each.name for each in register.views)
            message = f"register {register.path!r} has no view {view!r}: it has {names}"
            raise SimulatorError(message)
        return codec.encode(shown, self.stored(register.path), self.order(shown))

    def lookup(self, subject: str) -> Fraction:
        """Return the present number of a register, or of `register.field`, as conditions and limits count it."""
        register, field = self._find(subject)
        stored = self.stored(register.path)
        if isinstance(stored, str):
            return Fraction(0)
        return self.to_value(register, stored) if field is None else field_value(stored, field)

    def to_value(self, register: Register, stored: Fraction) -> Fraction:
        """Turn a stored number into the value of use."""
        scale = self.conversion(register)
        return (scale.multiply * stored + scale.add) / self.power(scale.decimals)

    def from_value(self, register: Register, value: Fraction) -> Fraction:
        """Turn a value of use into a stored number (exact: as finely as asked, whatever the device can hold)."""
        scale = self.conversion(register)
        return (value * self.power(scale.decimals) - scale.add) / scale.multiply

    def conversion(self, register: Register) -> Conversion:
        """Return the scale that holds now; none holding counts as identity."""
        return self.choose(register.scale) or IDENTITY

    def power(self, decimals: Decimals | None) -> int:
        """10 to the number of decimals that a register holds now."""
        if decimals is None:
            return 1
        digits = max(0, int(self.lookup(decimals.register)))
        return int(10 ** (digits if decimals.at_most is None else min(digits, decimals.at_most)))

    def holds(self, condition: Condition) -> bool:
        """Whether `condition` holds now."""
        return self.givens.holds(condition, self.lookup)

    def choose(self, cases: Cases[T]) -> T | None:
        """Return what the first case that holds now says; None if none holds."""
        return self.givens.choose(cases, self.lookup)

    # -- inside -------------------------------------------------------------------------------------------------

    def _first(self, register: Register) -> Stored:
        if register.path in self._initial:  # a circle of dependencies: one of them must begin
            return Fraction(0)
        self._initial.add(register.path)
        value = initial_value(self.blueprint.register_map, self._model, register, self)
        stored = self._to_stored(register, value)
        return stored if isinstance(stored, str) else self.quantise(register, stored)

    def _find(self, path: str) -> tuple[Register, BitField | None]:
        try:
            return self._model.register(path), None
        except KeyError:
            owner, _, name = path.rpartition(".")
        try:
            register = self._model.register(owner)
        except KeyError:
            register = None
        field = next((each for each in register.fields if each.id == name), None) if register else None
        if register is None or field is None:
            message = f"model {self._model.name} has no register or field {path!r}"
            raise SimulatorError(message)
        return register, field

    def _to_stored(self, register: Register, value: Plain) -> Stored:
        if register.kind is Kind.STRING:
            return str(value)
        if isinstance(value, str):
            fault = next((each.stored for each in register.sentinels if each.id.lower() == value.lower()), None)
            if fault is not None:
                return fault
            if register.kind is Kind.VERSION:
                return exact(value.replace(".", ""))
        return self.from_value(register, number_of(register, None, value))

    def _show(self, register: Register, image: Image) -> None:
        if not register.access.readable:
            return
        stored = self.stored(register.path)
        for place in self.blueprint.places[register.path]:
            words = codec.encode(place.view, stored, self.order(place.view))
            image.setdefault(place.view.space, {}).update(zip(place.covers(), words, strict=True))
