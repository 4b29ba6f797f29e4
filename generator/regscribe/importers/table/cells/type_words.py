"""The words for types, folded: in small letters, without blanks, points and underscores."""

import re

from regscribe.importers.table.cells.dialects import Dialect
from regscribe.model import WireType


def fold(text: str) -> str:
    """The words of a type without blanks, points, underscores and hyphens."""
    return re.sub(r"[\s_.\-]+", "", text)


_SYNONYMS = {
    WireType.BIT: "bit bool boolean coil contact discrete flagbit 1bit digital boolesch binary",
    WireType.UINT8: "usint uchar unsignedchar uint8t u8bit ubyte",
    WireType.INT8: "sint schar signedchar int8t signedbyte",
    WireType.UINT16: "ushort unsignedshort uword count pad raw16 acc16 uint16t unsignedword u16bit",
    WireType.INT16: "short sword signedshort sunssf int16t signedword shortint",
    WireType.UINT32: "udint dword udword unsigneddword uint32t acc32 unsigneddoubleword doubleword",
    WireType.INT32: "dint sdword signeddword int32t signeddoubleword doubleint doubleinteger",
    WireType.UINT64: "ulint qword lword uqword acc64 uint64t ulonglong unsignedlonglong",
    WireType.INT64: "lint sqword longlong signedlonglong int64t",
    WireType.FLOAT32: "real single fp32 ieee754 ieee floatieee floatieee754 ieee754float real32 floatingpoint fp"
    " single32 ieeefloat f32bit singleprecision float4 shortfloat",
    WireType.FLOAT64: "double lreal fp64 real64 doubleprecision longreal longfloat float8",
    WireType.FLOAT16: "half halfprecision fp16",
    WireType.IPV4: "ipaddr ip ipaddress ipv4 ipv4address",
    WireType.IPV6: "ipv6addr ipv6 ipv6address",
    WireType.EUI48: "eui48 mac macaddress",
}
FIXED = {
    **{re.sub(r"[._]", "", wire): wire for wire in WireType if not wire.is_octets},
    **{word: wire for wire, words in _SYNONYMS.items() for word in words.split()},
}
"""Words that mean one type."""

_WIDE = {
    **dict.fromkeys(("uint", "unsignedint", "unsignedinteger"), ("uint", "uint_bits")),
    **dict.fromkeys(("int", "integer", "signedint", "signedinteger"), ("int", "int_bits")),
    **dict.fromkeys(("ulong", "unsignedlong", "ulongint"), ("uint", "long_bits")),
    **dict.fromkeys(("long", "longint", "signedlong", "slong"), ("int", "long_bits")),
    "byte": ("uint", "byte_bits"),
    "word": ("uint", "word_bits"),
    "float": ("float", "float_bits"),
}
"""Words of a dialect: the stem of the type, and the field with its bits."""


def dialect_type(folded: str, dialect: Dialect, sized: int) -> str:
    """The type of a word whose width the size beside it says, or else the dialect; empty for other words."""
    if folded not in _WIDE:
        return ""
    stem, field = _WIDE[folded]
    name = f"{stem}{sized}"
    return name if name in list(WireType) else f"{stem}{getattr(dialect, field)}"


BITS_WORDS = {
    "signed": "int",
    "unsigned": "uint",
    "s": "int",
    "u": "uint",
    "f": "float",
    "real": "float",
    "fp": "float",
}
"""Words that say a sign and leave the width to another column."""

_SIGNS = (
    r"unsignedinteger|unsignedint|unsigned|uint|u|signedinteger|signedint|signed|sint|int|i|s"
    r"|floatingpoint|float|fp|f|real"
)
NUMBERED = re.compile(
    rf"(?P<word>{_SIGNS})(?P<n>[0-9]{{1,3}})(?:bits?)?t?|(?P<m>[0-9]{{1,3}})(?:bits?)?(?P<last>{_SIGNS})"
    r"|int(?P<o>16|32|64)(?P<both>u|s)"
)
"""A sign and a number of bits, in either order."""

KINDS = {
    **dict.fromkeys(("bitmap", "bitfield", "bitfeld", "bitmask", "bits", "flags", "bitstring", "bitarray"), "flags"),
    **dict.fromkeys(("enum", "enumeration", "enumerated", "list", "selection", "choice"), "enum"),
    **dict.fromkeys(("bcd", "packedbcd", "bcddigits"), "bcd"),
}
"""Words for kinds, with or without a number of bits behind them."""

_UNITS = r"(?:char\w*|bytes?|reg\w*|words?|zeichen)"
_TEXT_WORDS = r"string|str|ascii|text|utf-?8|char|characters|visible\s?string|alphanumeric|zeichenkette"
TEXTS = re.compile(
    rf"(?P<word>{_TEXT_WORDS})\s*(?:[\[( .:_*x-]\s*)?(?:(?P<n>[0-9]{{1,4}})\s*(?P<unit>{_UNITS})?)?\s*[\])]?"
    rf"|(?P<m>[0-9]{{1,4}})\s*(?P<unit2>{_UNITS})?\s*(?P<word2>{_TEXT_WORDS})"
)
"""Texts with their length."""

UNIX = frozenset({"unixtime", "unixtimestamp", "epoch", "unix", "timet", "epochtime", "posixtime"})
_NO_LAYOUT = "`datetime` with the `layout` of its words"
PROPOSED = {
    **dict.fromkeys(("datetime", "timestamp", "date", "time", "dateandtime", "dt", "utc", "clock"), _NO_LAYOUT),
    **dict.fromkeys(UNIX, "`datetime` with `layout: unix`"),
    **dict.fromkeys(("hex", "raw", "number", "numeric", "analog", "value", "register", "integer16"), "`uint16`"),
    "version": "`version` with its pattern",
    **dict.fromkeys(("char", "tinyint"), "`int8` or `uint8`"),
}
"""Words that name a type without saying all of it, with what is perhaps meant."""
