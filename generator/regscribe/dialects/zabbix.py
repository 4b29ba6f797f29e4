"""Words of the item `modbus.get` of Zabbix agent 2."""

from collections.abc import Mapping

from regscribe.dialects import ABCD, BADC, CDAB, DCBA, Orders
from regscribe.model import WireType

ENDIANNESS: Mapping[int, Mapping[Orders, str]] = {
    1: {ABCD: "be", BADC: "le"},
    2: {ABCD: "be", CDAB: "mbe", BADC: "mle", DCBA: "le"},
    4: {ABCD: "be", CDAB: "mle", BADC: "mbe", DCBA: "le"},
}
"""Values of `endianness` by words: mbe and mle change places between 32 and 64 bits (6.0.14, by trial)."""

WORD = "uint16"
"""The type of a word by itself."""

TYPES: Mapping[WireType, str] = {
    WireType.BIT: "bit",
    WireType.INT16: "int16",
    WireType.UINT16: WORD,
    WireType.INT32: "int32",
    WireType.UINT32: "uint32",
    WireType.UINT64: "uint64",
}
"""Values of `type` for what the agent reads as it is; its floats have six decimals, and it has no int64."""

BITS: Mapping[WireType, str] = {WireType.FLOAT16: WORD, WireType.FLOAT32: "uint32"}
"""Types whose bits are read as a number, and decoded by a script."""

IN_WORDS = frozenset({WireType.INT64, WireType.FLOAT64, WireType.STRING})
"""Types whose words are read one by one."""
