"""The register at an address that somebody typed: which one it is, in which view, and at which of its words."""

from collections.abc import Iterable, Iterator, Mapping
from itertools import groupby
from operator import itemgetter
from typing import NamedTuple

from regscribe.model.address_text import MODICON, AddressReading, hexadecimal, modicon, readings
from regscribe.tools.live.errors import TargetError
from regscribe_runtime.planning.address_ranges import places
from regscribe_runtime.values.views import Placed, View, read_view
from regscribe_runtime.values.wire_types import Space


class NoRegisterError(TargetError):
    """No register stands at an address; its word can be read as it is."""


class AddressHit(NamedTuple):
    """A register at an address: the view that stands there, the first address of that, and which word it is from 0."""

    register: Placed
    view: View
    first: int
    word: int

    @property
    def is_usual(self) -> bool:
        """Whether the view is the one that is read by name."""
        return self.view == read_view(self.register)

    @property
    def spelled(self) -> str:
        """For people: `word 2 of 2 of setpoint_ram in the view ieee, which begins at 8004`."""
        words = self.view.words // self.view.space.each
        name = self.register.path if self.is_usual else f"{self.register.path} in the view {self.view.name}"
        return f"word {self.word + 1} of {words} of {name}, which begins at {self.first}" if words > 1 else name


def is_address(text: str) -> bool:
    """Whether a text may be an address in any notation."""
    return bool(readings(text))


def found_at(text: str, registers: Mapping[str, Placed], model: str) -> tuple[AddressReading, list[AddressHit]]:
    """What a text means as an address, its space known, and the registers there.

    TargetError where no register is there, and where registers of several spaces or notations are: it names them.
    """
    meanings = {meaning: hits for one in readings(text) for meaning, hits in _meanings(one, registers.values())}
    if not meanings:
        raise NoRegisterError(_nobody(text, registers.values(), model))
    if len(meanings) > 1:
        every = "; ".join(f"{_name(one)} is {hits[0].spelled}" for one, hits in meanings.items())
        message = f"`{text}` may be several addresses of {model}: {every}: write {' or '.join(map(_name, meanings))}"
        raise TargetError(message)
    ((meaning, hits),) = meanings.items()
    return meaning, hits


def raw_place(text: str) -> AddressReading:
    """The one address that a text means where no register is known: a holding register unless it says otherwise."""
    meanings = [one._replace(space=one.space or Space.HOLDING) for one in readings(text)]
    if len(meanings) > 1:
        message = f"`{text}` may be {' or '.join(map(spelled, meanings))}: write {' or '.join(map(_name, meanings))}"
        raise TargetError(message)
    return meanings[0]


def spelled(meaning: AddressReading) -> str:
    """An address in the usual notations: `holding 4049 (0xFD1, 44050)`."""
    space = meaning.space or Space.HOLDING
    return f"{space} {meaning.address} ({hexadecimal(meaning.address)}, {modicon(space, meaning.address)})"


def _name(meaning: AddressReading) -> str:
    """An address as it is typed without any doubt: `holding:4049`."""
    return f"{meaning.space or Space.HOLDING}:{meaning.address}"


def _meanings(one: AddressReading, registers: Iterable[Placed]) -> Iterator[tuple[AddressReading, list[AddressHit]]]:
    """A reading in each space that has registers at its address, with these, those that can be read by name first."""
    hits = sorted(_hits(one, registers), key=lambda hit: hit.view.space)
    for space, inside in groupby(hits, key=lambda hit: hit.view.space):
        usual_first = sorted(inside, key=lambda hit: not hit.is_usual)
        each: dict[str, AddressHit] = {}
        for hit in usual_first:
            each.setdefault(hit.register.path, hit)
        yield one._replace(space=space, notation=""), list(each.values())


def _hits(one: AddressReading, registers: Iterable[Placed]) -> Iterator[AddressHit]:
    for register, view, first in _placed(registers):
        words = view.words // view.space.each
        if one.space in {None, view.space} and first <= one.address < first + words:
            yield AddressHit(register, view, first, one.address - first)


def _placed(registers: Iterable[Placed]) -> Iterator[tuple[Placed, View, int]]:
    """Every place of registers in the plain spaces; where a block stands is known of a device alone."""
    for register in registers:
        if getattr(register, "origin", 0) is None:
            continue
        for view, address in places(register):
            if view.space in MODICON:
                yield register, view, view.space.inside(address)


def _nobody(text: str, registers: Iterable[Placed], model: str) -> str:
    """That no register has an address, its neighbours, and how to read it nevertheless."""
    one = readings(text)[-1]
    every = [each for each in _placed(registers) if one.space in {None, each[1].space}]
    below = max((each for each in every if each[2] < one.address), key=itemgetter(2), default=None)
    above = min((each for each in every if each[2] > one.address), key=itemgetter(2), default=None)
    beside = [f"{each[0].path} is at {each[1].space} {each[2]}" for each in (below, above) if each]
    told = f": {' and '.join(beside)}" if beside else ""
    which = " or ".join(map(_name, readings(text)))
    raw = "read --raw" if len(readings(text)) == 1 else f"read --raw with {which}"
    return f"no register of {model} has the address {text}{told}; {raw} reads the word there as it stands"
