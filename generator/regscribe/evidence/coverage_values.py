"""What a map covers, as `regscribe coverage` shows it: frozen values."""

from dataclasses import astuple, dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Addresses:
    """How many addresses of a space are known, and as what; an address counts once in each column.

    `mapped` transmit a register in one of its views, `aliases` transmit it again, `commands` are only written by
    commands, `unused` and `reserved` the manual lists as such; `documented` are all of these together.
    """

    space: str
    documented: int
    mapped: int
    aliases: int
    commands: int
    unused: int
    reserved: int


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelCoverage:
    """The registers of one model, arrays expanded, and how many of them have each fact.

    `coded` have values or bits with a meaning of their own; `examples` are checked by a worked example of the manual.
    `inferred` say something the manual does not; `open_limits` have a limit that the manual names without giving it;
    `raw` are whole numbers whose decimals the manual does not state.
    """

    name: str
    addresses: tuple[Addresses, ...]
    registers: int
    ranged: int
    coded: int
    defaults: int
    units: int
    sections: int
    examples: int
    inferred: int
    open_limits: int
    raw: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Remark:
    """Something inferred or open: `kind` is `inferred`, `open limit`, `decimals not stated` or `given`.

    `at` are paths of registers (`[i]` for every element of an array) or the id of a given; no models: all of them.
    """

    kind: str
    at: tuple[str, ...]
    text: str
    models: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class MapCoverage:
    """What a map covers: its models, what is inferred and open, and the number of errata, waivers, overrides..."""

    id: str
    title: str
    models: tuple[ModelCoverage, ...]
    remarks: tuple[Remark, ...]
    errata: int
    waivers: int
    overrides: int
    givens: int
    examples: int


def counts(found: Addresses | ModelCoverage | MapCoverage) -> tuple[int, ...]:
    """The numbers alone, in the order of the fields."""
    return tuple(value for value in astuple(found) if isinstance(value, int))
