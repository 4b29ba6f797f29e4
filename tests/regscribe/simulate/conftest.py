"""Small models by hand: a three-view controller (as Athena), an affine one (as FDC), a bit device."""

from collections.abc import Iterable
from fractions import Fraction
from pathlib import Path

import pytest

from regscribe.model import (
    ALWAYS,
    Access,
    BitField,
    Case,
    Cases,
    Command,
    CommandStep,
    Condition,
    Conversion,
    Decimals,
    Enum,
    Faults,
    Given,
    GivenKind,
    Identity,
    IdentityRule,
    Interval,
    Is,
    Kind,
    Later,
    Limit,
    Manual,
    Member,
    Model,
    Open,
    Order,
    Protocol,
    Range,
    Ref,
    Register,
    RegisterMap,
    Rounding,
    Sentinel,
    Space,
    Special,
    View,
    WireType,
    WriteCondition,
    always,
    order_from,
)
from regscribe.pipeline import compile_map

R, RW, W = Access.READ, Access.READ_WRITE, Access.WRITE
SILENT = 0


def when(register: str, *codes: int, field: str = "", given: str = "", negated: bool = False) -> Condition:
    ranges = tuple((Fraction(code), Fraction(code)) for code in codes)
    return Condition((Is(register, field=field, codes=ranges, given=given, negated=negated),))


def limit(value: float | str) -> Limit:
    if isinstance(value, str):
        return Open(value[1:]) if value.startswith("?") else Ref(value)
    return Fraction(str(value))


def between(low: float | str, high: float | str) -> Cases[Range]:
    return always(Range((Interval(limit(low), limit(high)),)))


def reduced(low: float, high: float) -> Cases[Range]:
    return always(Range((Interval(limit(low), limit(high)),), Decimals("decimal_position")))


def word(path: str, address: int, kind: Kind = Kind.INTEGER, access: Access = RW, **more: object) -> Register:
    wire = more.pop("type", WireType.UINT16)
    space = more.pop("space", Space.HOLDING)
    view = View("base", wire, offset=address, space=space)  # type: ignore[arg-type]  # popped from keywords
    return Register(at=0, id=path, path=path, name=path, kind=kind, access=access, views=(view,), **more)  # type: ignore[arg-type]  # as above


ORDERING = order_from("ieee_ordering", ((0, Order.BIG), (1, Order.LITTLE)))


def fraction(path: str, at: int, access: Access = RW, **more: object) -> Register:
    views = (
        View("base", WireType.INT16, rounding=Rounding.HALF_UP, region=(0, 999)),
        View(
            "x10",
            WireType.INT16,
            offset=1000,
            factor=Fraction(10),
            rounding=Rounding.HALF_UP,
            saturates=True,
            region=(1000, 1999),
        ),
        View(
            "ieee",
            WireType.FLOAT32,
            offset=8000,
            words=2,
            functions=(3, 16),
            align=2,
            region=(8000, 9999),
            preferred=True,
            stride=2,
            order=ORDERING,
        ),
    )
    return Register(at=at, id=path, path=path, name=path, kind=Kind.NUMBER, access=access, views=views, **more)  # type: ignore[arg-type]  # keywords of Register


def family(models: Iterable[Model], protocol: Protocol, **more: object) -> RegisterMap:
    return RegisterMap(
        id="maker/family",
        title="Family",
        maker="Maker",
        class_prefix="Maker",
        source="family.yaml",
        content_hash="",
        manual=Manual("Manual"),
        models=tuple(models),
        protocol=protocol,
        **more,  # type: ignore[arg-type]  # keywords of RegisterMap
    )


LINEAR = when("input_type", 14)
LINEAR_DIGITS: Cases[Conversion] = (
    Case(LINEAR, Conversion(decimals=Decimals("decimal_position", at_most=3), step=Fraction(1))),
    Case(ALWAYS, Conversion()),
)
ALARM_ACTION = Enum("alarm_action", tuple(Member(c, n, n.upper()) for c, n in ((1, "off"), (2, "normal"))), ((3, ""),))
PROCESS_FAULTS = (Sentinel(Fraction(-32768), "sensor_low", "low"), Sentinel(Fraction(32767), "sensor_high", "high"))


RATES = (Special(Fraction(9999), "never", "never"), Special(Fraction(9998), "0.2 s", "fast", Fraction(1, 5)))


@pytest.fixture(scope="session")
def controller() -> RegisterMap:
    """Three views, word order from a register, decimals under a condition, garbage, partial writes, silences."""
    registers = (
        fraction("process_value", 0, R, scale=LINEAR_DIGITS, sentinels=PROCESS_FAULTS),
        fraction("setpoint", 2, scale=LINEAR_DIGITS, default=Fraction(77), range=between("low_limit", "high_limit")),
        fraction("low_limit", 3, scale=LINEAR_DIGITS, default=Fraction(-50)),
        fraction("high_limit", 4, scale=LINEAR_DIGITS, default=Fraction(9000), range=between(-999, "?sensor high")),
        fraction("rate", 11, range=between(0, 2400), specials=RATES),
        word("manual_output", 4009, type=WireType.INT16, range=between(-100, 100), writable=_manual_only()),
        word("controller_mode", 4010, range=between(1, 3), default=Fraction(3)),
        word("controller_type", 4011, access=R),
        word("input_type", 4049, range=between(0, 22), default=Fraction(3)),
        word("decimal_position", 4069, range=between(0, 3), default=Fraction(0)),
        word("alarm_1_action", 4072, Kind.ENUM, enum=ALARM_ACTION, default=Fraction(1)),
        word("alarm_2_action", 4073, Kind.ENUM, enum=ALARM_ACTION),
        word("ieee_ordering", 4084, range=between(0, 1), default=Fraction(1)),
        word("calibration", 4090, unlock="unlock", default=Fraction(5)),
        word("key", 4091, access=W),
        word("highest", 4092, type=WireType.INT16, range=between(0, 9999)),
        fraction("span", 12, scale=LINEAR_DIGITS, range=reduced(0, 9000)),
    )
    commands = (
        Command(id="load_defaults", name="", steps=(CommandStep(16, 7000, (85, 92)),)),
        Command(
            id="restart",
            name="",
            steps=(CommandStep(6, 7100, (1,)), CommandStep(0, 0, (), 10), CommandStep(6, 7101, (2,))),
        ),
        Command(id="reset_highest", name="", steps=(CommandStep(6, 4092, (-1999,)),), step_registers=("highest",)),
        Command(id="unlock", name="", steps=(CommandStep(6, 4091, (26669,)),), step_registers=("key",)),
    )
    faults = Faults(
        function=SILENT,
        read_only=3,
        quantity=SILENT,
        misaligned_count=SILENT,
        later_read=Later.GARBAGE,
        later_write=Later.STOP,
    )
    protocol = Protocol(
        functions=(3, 6, 8, 16),
        broadcast=(6, 16),
        read_words=24,
        write_words=24,
        read_holes=True,
    )
    models = (
        Model(name="16C", class_name="A16C", registers=registers, commands=commands),
        Model(name="25C", class_name="A25C", registers=registers, commands=commands),
    )
    identity = tuple(
        IdentityRule(Identity(when("controller_type", code)), (name,)) for code, name in ((2, "16C"), (3, "25C"))
    )
    return family(models, protocol, identity=identity, default_unit=1, faults=faults)


def _manual_only() -> WriteCondition:
    return WriteCondition(when("controller_mode", 1), "only in manual mode")


def affine(low: str, high: str) -> Conversion:
    span = Fraction(high) - Fraction(low)
    return Conversion(multiply=span / 65535, add=Fraction(low))


@pytest.fixture(scope="session")
def affine_controller() -> RegisterMap:
    """Affine scales by a given and a register, an alias, bit fields, a version, reserved addresses, a whole refusal."""
    linear = when("inpt", given="linear_inputs")
    process: Cases[Conversion] = (
        Case(when("inpt", given="linear_inputs", negated=True), affine("-1999.9", "4553.6")),
        Case(Condition((*linear.tests, *when("dp", 2).tests)), affine("-199.99", "455.36")),
    )
    mode = (
        BitField("alarm", "alarm", 0, 0),
        BitField(
            "operation", "operation", 8, 11, Enum("operation", (Member(0, "", "NORMAL"), Member(3, "", "MANUAL")))
        ),
    )
    registers = (
        word("sp1", 0, Kind.NUMBER, scale=process, default=Fraction(25)),
        word("inpt", 4, default=Fraction(1)),
        word("dp", 6, default=Fraction(1)),
        word("pv", 64, Kind.NUMBER, R, scale=process, aliases=(128,)),
        word("mode", 70, Kind.FIELDS, R, fields=mode),
        word("mv1", 66, writable=WriteCondition(when("mode", 3, field="operation"), "only in manual control")),
        word("version", 71, Kind.VERSION, R, version_digits=4, version_group=2, default="06.18"),
    )
    return family(
        (Model(name="C21", class_name="C21", registers=registers),),
        Protocol(functions=(3, 6, 16), read_words=79, write_words=79),
        faults=Faults(read_only=3),
        givens=(Given("linear_inputs", GivenKind.CODES, "codes of linear inputs", "in the other manual", "inpt"),),
        reserved=((Space.HOLDING, 77, 79),),
    )


@pytest.fixture(scope="session")
def bit_device() -> RegisterMap:
    """Coils, discrete inputs, input registers, a status byte, strings and wide integers in both orders."""

    def bit(path: str, space: Space, address: int, access: Access) -> Register:
        return word(path, address, Kind.BOOLEAN, access, space=space, type=WireType.BIT)

    def wide(path: str, address: int, kind: Kind = Kind.INTEGER, access: Access = RW, **view: object) -> Register:
        shown = View("base", offset=address, **view)  # type: ignore[arg-type]  # keywords of View
        return Register(at=0, id=path, path=path, name=path, kind=kind, access=access, views=(shown,))

    registers = (
        *(bit(f"relay_{n}", Space.COIL, n, RW) for n in range(10)),
        bit("interlock", Space.COIL, 10, R),
        *(bit(f"contact_{n}", Space.DISCRETE, n, R) for n in range(3)),
        word("measured", 0, access=R, space=Space.INPUT),
        word("status", 0, Kind.FLAGS, R, space=Space.STATUS, type=WireType.UINT8),
        wide("name", 20, Kind.STRING, type=WireType.STRING, words=3, byte_order=Order.LITTLE),
        wide("counter", 30, type=WireType.UINT32, words=2, order=Order.LITTLE),
        wide("energy", 32, type=WireType.INT64, words=4),
        word("plain", 40),
    )
    protocol = Protocol(functions=(1, 2, 3, 4, 5, 6, 7, 8, 15, 16, 22, 23), broadcast=(5,))
    return family((Model(name="IO", class_name="IO", registers=registers),), protocol)


@pytest.fixture(scope="session")
def furnace() -> RegisterMap:
    """A controller by a map in YAML: memories, commands with effects, followers, an alarm and a process."""
    compiled = compile_map(Path(__file__).with_name("furnace.yaml"))
    assert compiled.map is not None, compiled.diagnostics
    return compiled.map
