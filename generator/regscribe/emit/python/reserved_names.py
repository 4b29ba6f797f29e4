"""What a generated module imports, and what the classes and registers of a map may therefore not be called in it."""

import keyword
from collections.abc import Iterable

from regscribe.model import Array, Model, Register, RegisterMap

RUNTIME = sorted(
    """
    AnyOf Array AsyncBareDevice AsyncClient AsyncDevice AsyncLink AsyncPart BOTTOM BareDevice Bit ByCase Case Chain
    Choice ClientSettings Command CommandStep CommandWith Computed Condition Conversion Decimals Device
    ExceptionCode Fact Field Flags GivenRef Governs Group Identity Interval Is Largest Latency Link NotANumber
    NumberField Open Order OrderCases Page Part Power Product ProgramAction ProgramCounts ProgramFinal ProgramPart
    ProgramSegments ProgramStates ProgramTimeUnit Protocol Range ReadFacts ReadOnly ReadWrite Ref RegisterBlock
    Rounding Sentinel SerialDefaults SerialSettings SetpointProgram Setting Smallest Space SpaceLimits SpecialNumber
    SubPart Sum SyncClient TOP TcpSettings TextForm View WhileRunning WireType Word WriteCondition WriteOnly always
    async_client_link async_serial_link async_tcp boolean choice client_link date_as datetime_as eui48 eui64 flags
    integer integer_or integer_with ipv4 ipv6 number number_or number_with octets order_from raw raw_float
    serial_link tcp text text_as time_as version within word word_of
    """.split(),  # noqa: SIM905 (a column of quoted words is harder to keep in order)
    key=lambda name: (not name.isupper(), name.islower(), name),
)
"""What a generated module may import from `regscribe_runtime`, in import order."""

HELPERS = frozenset(name for name in RUNTIME if name.islower())
"""Functions that declarations call: in a class body a register of such a name would stand in their place."""

OTHERS = frozenset({"Any", "Collection", "Fraction", "Literal", "Self", "Unpack"})


def taken(register_map: RegisterMap) -> frozenset[str]:
    """Return the class names that are not free: those of imports and of models."""
    models = {model.class_name for model in register_map.models}
    return reserved() | models | {f"Async{name}" for name in models}


def reserved() -> frozenset[str]:
    """Return the class names that no generated module may use."""
    return frozenset({*RUNTIME, *OTHERS})


def free(name: str, used: Iterable[str], ending: str) -> str:
    """Return a class name, with `ending` added while it is a keyword or used already."""
    while keyword.iskeyword(name) or name in used:
        name += ending
    return name


def hidden(register_map: RegisterMap) -> frozenset[str]:
    """Return the helpers that a register or an array has the name of: the module calls them `_number` and so on."""

    def ids(members: tuple[Register | Array, ...]) -> Iterable[str]:
        for member in members:
            yield member.id
            if isinstance(member, Array):
                yield from ids(member.members)

    return HELPERS & {name for model in register_map.models for name in (*ids(model.members), *_computed(model))}


def _computed(model: Model) -> Iterable[str]:
    return (one.id for one in model.computed)
