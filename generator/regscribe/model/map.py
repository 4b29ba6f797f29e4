"""A register map: the models of a device family, and what is common to them."""

from dataclasses import dataclass, field
from enum import StrEnum
from fractions import Fraction

from regscribe.model.diagnostic import NOWHERE, Span
from regscribe.model.enums import Enum
from regscribe.model.faults import Faults, ProtocolNotes
from regscribe.model.identifiers import ways_to_say
from regscribe.model.process import Effect, Process
from regscribe.model.register import Array, Computed, Group, Inferred, Register
from regscribe_runtime.values.blocks import RegisterBlock
from regscribe_runtime.values.conditions import ALWAYS, Condition
from regscribe_runtime.values.facts import CommandStep, Identity
from regscribe_runtime.values.programs import SetpointProgram
from regscribe_runtime.values.protocol import Protocol
from regscribe_runtime.values.wire_types import Space


@dataclass(frozen=True, slots=True)
class Manual:
    """The document that was transcribed."""

    title: str
    number: str = ""
    date: str = ""
    publisher: str = ""


@dataclass(frozen=True, slots=True)
class Notation:
    """Another way to write an address of a space: the wire address plus `offset`, in the `base` 10 or 16."""

    name: str
    space: Space
    offset: int
    base: int = 10

    def printed(self, address: int) -> str:
        """A wire address as the manual prints it."""
        if self.base == 16:  # noqa: PLR2004
            return f"0x{self.space.plain(address) + self.offset:04X}"
        return self.space.spelled(address, self.offset)


class GivenKind(StrEnum):
    """What a given is: a set of register codes, yes/no, a number, or one of some texts."""

    CODES = "codes"
    BOOLEAN = "boolean"
    NUMBER = "number"
    CHOICE = "choice"


@dataclass(frozen=True, slots=True)
class Given:
    """A fact that decoding needs and this manual does not hold: a constructor argument.

    A number lies between `low` and `high` (None: no end), a choice is one of `choices`; only these may have a default.
    """

    id: str
    kind: GivenKind
    description: str
    reason: str
    register: str = ""
    choices: tuple[str, ...] = ()
    low: Fraction | None = None
    high: Fraction | None = None
    default: Fraction | str | None = None
    span: Span = NOWHERE

    @property
    def is_value(self) -> bool:
        """Whether conditions compare it as they compare a register."""
        return self.kind in {GivenKind.NUMBER, GivenKind.CHOICE}


@dataclass(frozen=True, slots=True, kw_only=True)
class Command:
    """A value or a sequence that makes the device act; `danger` says what may be lost (empty: harmless).

    `step_registers` are the paths of the registers that the steps name, empty for a step that names none.
    `arguments` are what a program gives when it sends the command: pairs of a name and a register that none reads.
    It exists only while `when` holds.
    `effects` are what it changes besides the words that it writes, one after the other.
    """

    id: str
    name: str
    steps: tuple[CommandStep, ...]
    step_registers: tuple[str, ...] = ()
    arguments: tuple[tuple[str, Register], ...] = ()
    when: Condition = ALWAYS
    description: str = ""
    section: str = ""
    danger: str = ""
    group: str = ""
    effects: tuple[Effect, ...] = ()
    span: Span = NOWHERE

    @property
    def named_steps(self) -> tuple[tuple[CommandStep, str], ...]:
        """The steps, each with the path of the register that it names."""
        return tuple(zip(self.steps, (*self.step_registers, *[""] * len(self.steps)), strict=False))


@dataclass(frozen=True, slots=True, kw_only=True)
class ProgramNotes:
    """The manual's remarks on a program, what was concluded about it, and where it stands in the map."""

    description: str = ""
    inferred: tuple[Inferred, ...] = ()
    span: Span = NOWHERE


@dataclass(frozen=True, slots=True)
class IdentityRule:
    """What shows itself so is one of `models` (several: the answer does not tell them apart)."""

    identity: Identity
    models: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Page:
    """What selects a page: `steps` write `values` to the registers `selectors`, or another unit id (0: none) is asked.

    `at_once`: function 23 does so in the request that reads. Nothing for a page of other models.
    """

    steps: tuple[CommandStep, ...] = ()
    selectors: tuple[str, ...] = ()
    values: tuple[str, ...] = ()
    unit: int = 0
    at_once: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Model:
    """One product: only the registers it has, with its own enums, ranges and defaults.

    `members` keeps arrays folded, in the manual's order; `registers` is the same with arrays expanded.
    `program_notes` has an entry for each of `programs`.
    `pages` are those of the map, by their numbers from 1 on, which addresses have above the bits of a wire address.
    `unused` are stretches of addresses (space, first, last) that read as 0 and refuse writes.
    """

    name: str
    class_name: str
    description: str = ""
    members: tuple[Register | Array, ...] = ()
    registers: tuple[Register, ...] = ()
    groups: tuple[Group, ...] = ()
    commands: tuple[Command, ...] = ()
    computed: tuple[Computed, ...] = ()
    programs: tuple[SetpointProgram, ...] = ()
    program_notes: tuple[ProgramNotes, ...] = ()
    process: Process | None = None
    unused: tuple[tuple[Space, int, int], ...] = ()
    pages: tuple[Page, ...] = ()
    by_path: dict[str, Register] = field(default_factory=dict, compare=False, hash=False, repr=False)
    span: Span = NOWHERE

    def spelled(self, space: Space, address: int) -> str:
        """An address for people, with the page that it is on or the unit id that it is at."""
        page = space.page(address)
        unit = self.pages[page - 1].unit if page else 0
        return f"{space.inside(address)} at unit id {unit}" if unit else space.spelled(address)

    def register(self, path: str) -> Register:
        """Find a register by its path; KeyError if this model has none of that name.

        Of one in "the same element" of an array (`channels[].mode`), that of the first element.
        """
        if not self.by_path:
            named = [(way, register) for register in self.registers for way in ways_to_say(register.path)]
            self.by_path.update(reversed(named))
        return self.by_path[path]


@dataclass(frozen=True, slots=True)
class Erratum:
    """A place where the manual is wrong, contradicts itself or lost something: what it prints, what is read, why."""

    where: str
    printed: str
    read: str
    why: str


class Outcome(StrEnum):
    """What decoding the words of an example must give."""

    VALUE = "value"
    SATURATED = "saturated"
    FAULT = "fault"


@dataclass(frozen=True, slots=True, kw_only=True)
class ValueExample:
    """The manual's words and value of one register, under the values of others (`state`: path, value).

    With `stored`, the device holds that number and transmits `words`; with `value`, the words decode to it and (unless
    `lossy`) it encodes to them. `value` is a number, a text, or the sentinel's id where `outcome` is FAULT.
    """

    source: str
    model: str
    register: str
    view: str
    words: tuple[int, ...]
    state: tuple[tuple[str, Fraction], ...] = ()
    stored: Fraction | None = None
    value: Fraction | str | None = None
    flags: tuple[str, ...] | None = None
    outcome: Outcome = Outcome.VALUE
    lossy: bool = False
    span: Span = NOWHERE


@dataclass(frozen=True, slots=True, kw_only=True)
class FrameExample:
    """An RTU frame that the manual prints and what it says: `writes` are (path, value) pairs under `state`.

    `crc`: whether the frame ends in its CRC. `answer`: the frame comes from the device.
    """

    source: str
    model: str
    frame: bytes
    crc: bool
    answer: bool
    unit: int
    function: int
    address: int | None = None
    count: int | None = None
    words: tuple[int, ...] | None = None
    writes: tuple[tuple[str, Fraction], ...] = ()
    view: str = ""
    state: tuple[tuple[str, Fraction], ...] = ()
    command: str = ""
    span: Span = NOWHERE


@dataclass(frozen=True, slots=True, kw_only=True)
class TimingExample:
    """The manual's times in milliseconds, to two decimals, for one request at a line setting."""

    source: str
    baud: int
    format: str
    function: int
    words: int
    gap: Fraction
    earliest: Fraction
    latest: Fraction
    span: Span = NOWHERE


Example = ValueExample | FrameExample | TimingExample


@dataclass(frozen=True, slots=True)
class Waiver:
    """A rule that does not count for one thing in this map, and why."""

    rule: str
    at: str
    reason: str
    span: Span = NOWHERE


@dataclass(frozen=True, slots=True)
class Override:
    """What a map changes of the one that it extends, and why.

    `what` is `register`, `group`, `command`, `program`, `enum`, `errata`, `examples`, `notes` or `waivers`; `changed`
    says key by key what was and what is (`default: 77 -> 100`). Nothing in `changed`: the thing is dropped.
    """

    what: str
    id: str
    reason: str
    changed: tuple[str, ...] = ()
    span: Span = NOWHERE


@dataclass(frozen=True, slots=True, kw_only=True)
class Library:
    """What drivers import from the module of a library, without what depends on the map that uses it.

    `enums` have the members that no model alone has. `sets` are those that mean the same wherever they are used: each
    is a model of the set's id that has nothing but its registers.
    """

    id: str
    title: str
    content_hash: str
    enums: tuple[Enum, ...] = ()
    sets: tuple[Model, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class RegisterMap:
    """A device family, read from a YAML file and those that it builds on (`extends` one map, `uses` libraries).

    `spares_memory`: whether a write of what lasting memory holds already leaves the memory alone.
    `alike`: function codes that do the same (2 reads coils as 1 does); registers stand in the space of one of them.
    `accepts`: limits of the protocol that the device goes beyond, by another passage of its manual; a driver keeps to
    the limits.
    `unit_symbols` are those that the map declares, `unit_notes` what some of them stand for.
    `content_hash` is the SHA-256 in hex of the file's bytes, or of the hashes of all files where there are several.
    `libraries` are those of `uses`, `shipped` the ids of all its files that come with regscribe, as do the modules of
    such libraries. These two let drivers share enums. They are no facts about the devices, so exports leave them out.
    """

    id: str
    title: str
    maker: str
    class_prefix: str
    source: str
    content_hash: str
    manual: Manual
    models: tuple[Model, ...]
    protocol: Protocol = field(default_factory=Protocol)
    faults: Faults = field(default_factory=Faults)
    default_unit: int | None = None
    spares_memory: bool = False
    alike: tuple[tuple[int, ...], ...] = ()
    accepts: tuple[tuple[str, int], ...] = ()
    protocol_notes: ProtocolNotes = field(default_factory=ProtocolNotes)
    description: str = ""
    notations: tuple[Notation, ...] = ()
    givens: tuple[Given, ...] = ()
    blocks: tuple[RegisterBlock, ...] = ()
    reserved: tuple[tuple[Space, int, int], ...] = ()
    identity: tuple[IdentityRule, ...] = ()
    errata: tuple[Erratum, ...] = ()
    examples: tuple[Example, ...] = ()
    waivers: tuple[Waiver, ...] = ()
    notes: tuple[str, ...] = ()
    unit_symbols: tuple[str, ...] = ()
    unit_notes: tuple[tuple[str, str], ...] = ()
    extends: str = ""
    uses: tuple[str, ...] = ()
    overrides: tuple[Override, ...] = ()
    libraries: tuple[Library, ...] = field(default=(), compare=False, repr=False)
    shipped: tuple[str, ...] = field(default=(), compare=False)
    span: Span = NOWHERE

    def model(self, name: str) -> Model:
        """Find a model by its manual name; KeyError if the map has none."""
        return {model.name: model for model in self.models}[name]

    @property
    def only_model(self) -> str:
        """The name of the model of a map that has one alone; empty where it has several."""
        return self.models[0].name if len(self.models) == 1 else ""

    def has(self, name: str) -> bool:
        """Whether the map covers a model of this name."""
        return any(model.name == name for model in self.models)

    def most(self, space: Space, way: str) -> int:
        """Return the most addresses of a space that the device takes in one request; `way` is read or write."""
        own = next((one.read if way == "read" else one.write for one in self.protocol.spaces if one.space is space), 0)
        return space.each * own or self.accepted(f"{way}_bits" if space.is_bits else f"{way}_words")

    def accepted(self, limit: str) -> int:
        """Return the most that the device answers: `limit` (`read_words` and so on), or what it accepts beyond it."""
        return dict(self.accepts).get(limit, int(getattr(self.protocol, limit)))
