"""A small device built by hand: an array, a scale by condition, open limits, an enum, bits, sentinels, two models."""

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

import pytest

from regscribe import plugins
from regscribe.losses import Exported
from regscribe.model import (
    Access,
    Array,
    BitField,
    Case,
    Command,
    CommandStep,
    Condition,
    Conversion,
    Enum,
    Erratum,
    FrameExample,
    Group,
    Interval,
    Is,
    Kind,
    Manual,
    Member,
    Model,
    Open,
    Order,
    Range,
    Ref,
    Register,
    RegisterMap,
    Sentinel,
    Space,
    Special,
    TimingExample,
    ValueExample,
    View,
    WireType,
    always,
    order_from,
)

TEMPERATURE = Condition((Is("input_type", codes=((Fraction(0), Fraction(12)),)),), "temperature_input")
LINEAR = Condition((Is("input_type", given="linear_inputs"),))


def _view(address: int, kind: WireType = WireType.INT16) -> View:
    return View("base", kind, offset=address, words=kind.words)


def _limits(low: int, high: int) -> Range:
    return Range((Interval(Fraction(low), Fraction(high)),))


def _ramp(index: int) -> Register:
    return Register(
        at=0,
        id="ramp_time",
        path=f"segments[{index}].ramp_time",
        name="Ramp Time",
        kind=Kind.INTEGER,
        access=Access.READ_WRITE,
        views=(_view(30 + 2 * index),),
        range=always(_limits(0, 9600)),
        specials=(Special(Fraction(0), "off", "OFF"),),
        default=Fraction(5),
        array="segments",
        index=(index,),
        group="profile",
        section="4.9",
    )


def _input_type() -> Register:
    members = (Member(0, "J thermocouple", "J_THERMOCOUPLE"), Member(13, "linear", "LINEAR"))
    return Register(
        at=0,
        id="input_type",
        path="input_type",
        name="Input Type",
        symbol="INPT",
        kind=Kind.ENUM,
        access=Access.READ_WRITE,
        views=(_view(3, WireType.UINT16),),
        enum=Enum("input_type", members, invalid=((4, "not fitted"),)),
        default=Fraction(13),
        group="input",
        section="4.1",
        persistence="eeprom",
    )


def _setpoint() -> Register:
    order = order_from("input_type", ((0, Order.BIG), (13, Order.LITTLE)))
    ieee = View("ieee", WireType.FLOAT32, offset=8002, words=2, functions=(3, 16), align=2, order=order)
    open_end = Range((Interval(Open("sensor low limit"), Open("sensor high limit")),))
    registers = Range((Interval(Ref("low_limit"), Ref("high_limit")),))
    return Register(
        at=0,
        id="setpoint",
        path="setpoint",
        name="Setpoint",
        kind=Kind.NUMBER,
        access=Access.READ_WRITE,
        views=(_view(1), ieee),
        aliases=(101, 201),
        scale=(
            Case(TEMPERATURE, Conversion(Fraction(1, 10))),
            Case(LINEAR, Conversion(Fraction(1, 10), Fraction("-1999.9"))),
            Case(Condition(), Conversion()),
        ),
        unit=always("°C"),
        range=(Case(TEMPERATURE, open_end), Case(LINEAR, registers)),
        sentinels=(Sentinel(Fraction(-32768), "LOW", "sensor low"),),
        default=Fraction("25.1"),
        group="input",
        section="4.2",
    )


def _status() -> Register:
    mode = Enum("mode", (Member(0, "normal", "NORMAL"), Member(3, "manual", "MANUAL")))
    return Register(
        at=0,
        id="status",
        path="status",
        name="Status",
        kind=Kind.FIELDS,
        access=Access.READ,
        views=(_view(70, WireType.UINT16),),
        fields=(BitField("alarm", "alarm on", 0, 0), BitField("mode", "operation", 8, 11, enum=mode)),
        group="input",
        section="4.3",
    )


def _model(name: str, *registers: Register) -> Model:
    ramps = tuple(_ramp(index) for index in (1, 2))
    array = Array(id="segments", name="Segment", first=1, count=2, stride=2, members=ramps[:1])
    command = Command(
        id="load_defaults",
        name="Load Defaults",
        steps=(CommandStep(16, 7000, (85, 92)), CommandStep(0, 0, (), 2000), CommandStep(6, 7005, (1,))),
        danger="all settings are lost",
        section="7.2",
    )
    return Model(
        name=name,
        class_name=f"Acme{name}",
        members=(*registers, array),
        registers=(*registers, *ramps),
        groups=(
            Group(id="input", name="Input", members=tuple(register.path for register in registers)),
            Group(id="profile", name="Profile", members=tuple(ramp.path for ramp in ramps)),
        ),
        commands=(command,),
    )


@pytest.fixture
def setpoint() -> Register:
    return _setpoint()


@pytest.fixture
def device() -> RegisterMap:
    """Two models; `status` exists on the second only."""
    return RegisterMap(
        id="acme/oven",
        title="Acme Oven",
        maker="Acme",
        class_prefix="Acme",
        source="elsewhere/oven.yaml",
        content_hash="0123456789abcdef" * 4,
        manual=Manual("Oven, Modbus"),
        models=(_model("A1", _input_type(), _setpoint()), _model("A2", _input_type(), _setpoint(), _status())),
        errata=(Erratum("1.2", "4083", "4082", "the table on page 3 agrees"),),
        reserved=((Space.HOLDING, 77, 79),),
        examples=(
            ValueExample(
                source="3.7", model="A1", register="setpoint", view="base", words=(121,), stored=Fraction("120.5")
            ),
            FrameExample(
                source="2.3", model="A1", frame=b"\x9c\x06", crc=False, answer=False, unit=156, function=6, address=1
            ),
            TimingExample(
                source="1.2",
                baud=9600,
                format="8N1",
                function=3,
                words=2,
                gap=Fraction("4.17"),
                earliest=Fraction("14.17"),
                latest=Fraction("204.17"),
            ),
        ),
    )


@pytest.fixture
def only(device: RegisterMap) -> Callable[[Register], RegisterMap]:
    """Return a function that makes a map of one model with one register."""

    def build(register: Register) -> RegisterMap:
        model = replace(device.models[0], members=(register,), registers=(register,), commands=(), by_path={})
        return replace(device, models=(model,))

    return build


Export = Callable[..., Exported]


@pytest.fixture
def export(model_of: Callable[[str], RegisterMap]) -> Export:
    """What an exporter makes of the text of a map: `export("telegraf", text, at="h:502", unit="7")`."""

    def made(name: str, text: str, /, **options: str) -> Exported:
        known = {option.name: option.default for option in plugins.exporter(name).options}
        given = {key.rstrip("_"): value for key, value in options.items()}
        assert not given.keys() - known.keys(), f"{name} has the options {', '.join(known)}"
        return plugins.export(name, [model_of(text)], known | given)

    return made


@pytest.fixture
def exported_text(export: Export) -> Callable[..., str]:
    """The one text of an export, arguments as of `export`."""

    def text(name: str, text: str, /, **options: str) -> str:
        (one,) = export(name, text, **options).texts.values()
        assert isinstance(one, str)
        return one

    return text


@pytest.fixture
def lost() -> Callable[[Exported], set[tuple[str, str, str]]]:
    """Losses as register, fact and grade, for sets: but for those that every register has (its name, its source)."""
    usual = {"name", "symbol", "source", "group", "description"}

    def losses(made: Exported) -> set[tuple[str, str, str]]:
        return {(one.register, one.fact, one.grade.name) for one in made.losses if one.fact not in usual}

    return losses
