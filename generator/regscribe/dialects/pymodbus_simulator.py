"""Words of the JSON that the simulator of pymodbus reads."""

from collections.abc import Mapping

from regscribe.model import WireType

SECTIONS: Mapping[WireType, str] = {
    WireType.BIT: "bits",
    WireType.UINT16: "uint16",
    WireType.INT16: "int16",
    WireType.UINT32: "uint32",
    WireType.FLOAT32: "float32",
    WireType.FLOAT64: "float64",
    WireType.STRING: "string",
}
"""The lists of registers by type; 32 and 64 bits have the most significant word first. `bits` are words of 16 bits."""

SIZES = ("co size", "di size", "ir size", "hr size")
"""How many addresses coils, discrete inputs, input and holding registers have, in the order in which they follow."""
