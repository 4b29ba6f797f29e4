"""A register as a variable: its data type, its form (analog, codes, bits), and where and how it stands on the wire."""

from collections.abc import Sequence
from fractions import Fraction

from regscribe.dialects import LETTERS
from regscribe.emit.words import bits_words, condition_words, member_words, one_line, sentinel_words, special_words
from regscribe.export.device import Device, Point
from regscribe.export.opcua_nodeset.nodes import (
    DATA,
    MANDATORY,
    OPTIONAL,
    VARIABLES,
    Nodes,
    put_codes,
    put_range,
    put_text,
    put_texts,
    put_unit,
)
from regscribe.export.opcua_nodeset.units import NO_ID, unit_id
from regscribe.losses import Grade
from regscribe.model import BitField, Enum, Inferred, Kind, Member, WireType, show
from regscribe_runtime.values.kinds import MOMENTS

ACCESS = {"r": "1", "w": "2", "rw": "3"}
TEXTS = frozenset({Kind.STRING, Kind.VERSION, Kind.IPV4, Kind.IPV6, Kind.MAC, *MOMENTS})
DOUBLE_BITS = 53
"""Bits of a whole number that a Double tells apart."""


class Variables:
    """Adds the variables of a device, and tells what of a register they do not say."""

    def __init__(self, device: Device, nodes: Nodes) -> None:
        """What is added goes to `nodes`."""
        self._device, self._nodes = device, nodes

    def add(self, point: Point, parent: str) -> None:
        """Add the variable of a register below the node of this path."""
        one, path = point.register, f"{parent}.{point.path}"
        data, form = _data(point), _form(point)
        self._variable(point, path, f"1:{point.path}", one.name, one.description, parent, data, form)
        self._meaning(point, path, form)
        self._place(point, path)
        for part in point.fields:
            if form != "OptionSetType":
                self._part(point, part, path)

    def _variable(
        self, point: Point, path: str, name: str, title: str, said: str, parent: str, data: str, form: str
    ) -> None:
        always = point.register.when.always
        self._nodes.child(
            "UAVariable",
            path,
            name,
            one_line(title),
            one_line(said),
            parent=parent,
            type=VARIABLES[form],
            rule=MANDATORY if always else OPTIONAL,
            DataType=DATA[data],
            AccessLevel=ACCESS[point.register.access.value],
        )

    def _meaning(self, point: Point, path: str, form: str) -> None:
        """The properties that the form of the variable asks for."""
        one, nodes = point.register, self._nodes
        if form == "MultiStateValueDiscreteType":
            self._codes(path, point.members, one.enum)
        elif form == "TwoStateDiscreteType":
            self._states(point, path)
        elif form == "OptionSetType":
            labels = {part.low: one_line(part.label) for part in point.fields}
            texts = [labels.get(bit, "") for bit in range(max(labels) + 1)]
            put_texts(nodes.property(path, "OptionSetValues", "LocalizedText", several=True), texts)
        elif form == "BaseAnalogType":
            self._analog(point, path)
        if one.none:
            nodes.own(path, "ModbusNoBit", "String", one_line(one.none))

    def _codes(self, path: str, members: Sequence[Member], enum: Enum | None) -> None:
        codes = [(each.code, one_line(each.label), member_words(each, enum) if enum else "") for each in members]
        put_codes(self._nodes.property(path, "EnumValues", "EnumValueType", several=True), codes)
        self._nodes.property(path, "ValueAsText", "LocalizedText")

    def _states(self, point: Point, path: str) -> None:
        labels = {each.code: one_line(each.label) for each in point.members}
        for code, name in enumerate(("FalseState", "TrueState")):
            put_text(self._nodes.property(path, name, "LocalizedText"), labels.get(code, ""))

    def _analog(self, point: Point, path: str) -> None:
        if point.unit:
            put_unit(self._nodes.property(path, "EngineeringUnits", "EUInformation"), point.unit)
            if unit_id(point.unit) == NO_ID:
                self._lose(point, "unit", Grade.COSMETIC, f"by its symbol alone, without a code: {point.unit}")
        ends = _ends(point, self._device)
        if ends:
            put_range(self._nodes.property(path, "EURange", "Range"), *ends)

    def _place(self, point: Point, path: str) -> None:
        """Where it stands and how, as properties of the set's own namespace."""
        own, one, wire = self._nodes.own, point.register, point.wire
        facts = wire.space.facts(point.address)
        own(path, "ModbusSpace", "String", wire.space.value)
        own(path, "ModbusAddress", "UInt32", str(facts["address"]))
        for key in ("file", "queue"):
            if key in facts:
                own(path, f"Modbus{key.title()}", "UInt32", str(facts[key]))
        own(path, "ModbusWords", "UInt32", str(point.words))
        own(path, "ModbusType", "String", wire.type.value)
        if not wire.space.is_bits:
            own(path, "ModbusOrder", "String", LETTERS[wire.words, wire.bytes])  # type: ignore[index]  # what fits
        if point.write not in {None, point.address}:
            own(path, "ModbusWriteAddress", "UInt32", str(point.write))
        if one.kind in {Kind.NUMBER, Kind.INTEGER}:
            own(path, "ModbusScale", "String", show(point.slope))
            own(path, "ModbusOffset", "String", show(point.offset))
        elif one.kind is Kind.RAW:
            own(path, "ModbusScale", "String", "not stated")
        for key, texts in self._lists(point).items():
            own(path, key, "String", *texts, several=True)

    def _lists(self, point: Point) -> dict[str, list[str]]:
        one = point.register
        if not one.when.always:
            done = f"an optional node, the condition as a text: {condition_words(one.when)}"
            self._lose(point, "condition", Grade.LOST, done)
        found = {
            "ModbusFaults": [one_line(sentinel_words(each)) for each in point.sentinels],
            "ModbusSpecialValues": [one_line(special_words(each)) for each in point.specials],
            "ModbusExists": [] if one.when.always else [one_line(condition_words(one.when))],
            "ModbusLayout": [one.layout] if one.layout else [],
            "ModbusSymbol": [one_line(one.symbol)] if one.symbol else [],
            "ModbusDanger": [one_line(one.danger)] if one.danger else [],
            "ManualSource": [*([one_line(one.section)] if one.section else []), *map(_inferred, one.inferred)],
        }
        return {key: texts for key, texts in found.items() if texts}

    def _part(self, point: Point, part: BitField, parent: str) -> None:
        """A part of a word, as a variable below that of the word."""
        path = f"{parent}.{part.id}"
        form = "MultiStateValueDiscreteType" if part.enum else "BaseAnalogType" if _is_analog(part) else ""
        data = "Boolean" if part.is_flag else "Double" if part.is_scaled else _whole(part.width, signed=part.signed)
        name, said = f"1:{part.id}", part.description
        self._variable(point, path, name, part.label, said, parent, data, form or "BaseDataVariableType")
        if part.enum:
            self._codes(path, part.enum.members, part.enum)
        if part.unit:
            put_unit(self._nodes.property(path, "EngineeringUnits", "EUInformation"), part.unit)
        if part.range:
            put_range(self._nodes.property(path, "EURange", "Range"), *map(Fraction, part.range))
        self._nodes.own(path, "ModbusBits", "String", bits_words(part))
        if part.is_scaled:
            self._nodes.own(path, "ModbusScale", "String", show(part.multiply))
            self._nodes.own(path, "ModbusOffset", "String", show(part.add))
        if part.sentinels:
            texts = [one_line(sentinel_words(each)) for each in part.sentinels]
            self._nodes.own(path, "ModbusFaults", "String", *texts, several=True)
        if part.valid:
            self._lose(point, "fields", Grade.LOST, f"left out: limits of a valid reading of the part {part.id}")

    def _lose(self, point: Point, fact: str, grade: Grade, done: str) -> None:
        self._device.lose(point.register, fact, grade, done)


def _inferred(one: Inferred) -> str:
    return f"inferred: {one_line(one.what)} ({one_line(one.why)})"


def _is_analog(part: BitField) -> bool:
    return bool(part.unit or part.range)


def _ends(point: Point, device: Device) -> tuple[Fraction, Fraction] | None:
    """The ends of the values: of what may be written, else of what is a valid reading."""
    one = point.register
    if one.range and one.valid and point.limits:
        device.lose(one, "valid", Grade.LOST, "left out: the range is that of writes")
    if one.range and one.access.writable and not point.limits:
        device.lose(one, "range", Grade.LOST, "left out: its ends are no numbers in the stated state")
    if point.limits:
        return point.limits
    ends = [(low, high) for low, high in point.valid or () if low is not None and high is not None]
    if one.valid and (not ends or len(ends) < len(point.valid or ())):
        device.lose(one, "valid", Grade.LOST, "left out: its limits are no two numbers in the stated state")
        return None
    return (min(low for low, _ in ends), max(high for _, high in ends)) if ends else None


def _form(point: Point) -> str:
    """The type of the variable."""
    one = point.register
    if point.members:
        bits = point.wire.space.is_bits or one.kind is Kind.BOOLEAN
        return "TwoStateDiscreteType" if bits else "MultiStateValueDiscreteType"
    if one.kind is Kind.FLAGS and point.fields:
        return "OptionSetType"
    numeric = one.kind in {Kind.NUMBER, Kind.INTEGER, Kind.RAW}
    return "BaseAnalogType" if numeric and (point.unit or one.range or one.valid) else "BaseDataVariableType"


def _data(point: Point) -> str:
    """The data type of the value of use."""
    one, kind = point.register, point.wire.type
    if one.kind in TEXTS:
        return "String"
    if one.kind is Kind.BYTES:
        return "ByteString"
    if one.kind is Kind.BOOLEAN or point.wire.space.is_bits:
        return "Boolean"
    if kind.is_float:
        return "Double" if kind is WireType.FLOAT64 or point.is_scaled else "Float"
    whole = kind.is_integer and not kind.fraction and point.slope.denominator == point.offset.denominator == 1
    if point.is_scaled or not whole:
        return "Double"
    return _whole(kind.bits or 16 * kind.words, signed=kind.minimum < 0)


def _whole(bits: int, *, signed: bool) -> str:
    """The smallest type of whole numbers of so many bits."""
    size = next(size for size in (16, 32, 64) if bits <= size)
    return f"{'' if signed else 'U'}Int{size}"
