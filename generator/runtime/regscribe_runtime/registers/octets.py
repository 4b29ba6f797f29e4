"""Values that are bytes and no numbers: texts, raw bytes, addresses of networks."""

from collections.abc import Callable
from ipaddress import IPv4Address, IPv6Address
from typing import Any, NoReturn, TypeVar

from regscribe_runtime.registers.value_types import ValueType
from regscribe_runtime.values.kinds import Kind
from regscribe_runtime.values.numbers import brief
from regscribe_runtime.values.octets import BLANK, PLAIN_TEXT, TextForm

T = TypeVar("T")


class OctetType(ValueType[T]):
    """The Python type of values that bytes spell.

    `read` makes a value of bytes, and `write` so many bytes of a value; ValueError says why they cannot. `parse` is
    the value of a text, as maps, backups and the command line have it, and `spell` the text of a value.
    """

    __slots__ = ("parse", "read", "spell", "write")

    def __init__(
        self,
        kind: Kind,
        read: Callable[[bytes], T],
        write: Callable[[Any, int], bytes],
        parse: Callable[[str], T],
        spell: Callable[[T], str] = str,
    ) -> None:
        super().__init__(kind, parse, _refuse_number, coded=True)
        self.read, self.write, self.parse, self.spell = read, write, parse, spell


def _refuse_number(_: str, value: object) -> NoReturn:
    message = f"{value!r} is of the wrong type"  # bytes are never made of a number
    raise TypeError(message)


def text_as(form: TextForm) -> OctetType[str]:
    """A text of a form."""

    def read(raw: bytes) -> str:
        cells = _cells(form, raw)
        sizes = range(0, len(cells), form.size)
        end = next((at for at in sizes if cells[at] in form.ends and len({*cells[at : at + form.size]}) == 1), None)
        cells = cells[:end]
        padding = bytes([form.padding]) * form.size
        while form.padding != BLANK and cells.endswith(padding):
            cells = cells[: -form.size]
        try:
            return cells.decode(form.codec).rstrip(" ")
        except UnicodeDecodeError:
            message = f"{cells.hex(' ')} is no {form.encoding.upper()} text"
            raise ValueError(message) from None

    def write(value: object, size: int) -> bytes:
        room = size // 2 if form.per_register else size
        cells = _encoded(form, value)
        if len(cells) > room:
            message = f"{brief(value)} has {len(cells) // form.size} characters; {room // form.size} fit"
            raise ValueError(message)
        padding = " ".encode(form.codec) if form.padding == BLANK else bytes([form.padding]) * form.size
        cells += padding * ((room - len(cells)) // form.size)
        raw = _spread(cells, form.per_register)
        if read(raw) != str(value).rstrip(" "):
            message = f"{brief(value)} would not be read back: it has what ends or fills a text"
            raise ValueError(message)
        return raw

    return OctetType(Kind.STRING, read, write, str)


def _cells(form: TextForm, raw: bytes) -> bytes:
    return raw[form.per_register == "low" :: 2] if form.per_register else raw


def _spread(cells: bytes, per_register: str) -> bytes:
    if not per_register:
        return cells
    return b"".join(bytes((0, cell) if per_register == "low" else (cell, 0)) for cell in cells)


def _encoded(form: TextForm, value: object) -> bytes:
    try:
        if isinstance(value, str) and "\0" not in value:
            return value.encode(form.codec)
    except UnicodeEncodeError:
        pass
    message = f"{brief(value)} is no {form.encoding.upper()} text without NUL"
    raise ValueError(message)


text: OctetType[str] = text_as(PLAIN_TEXT)


def _same_length(value: object, size: int) -> bytes:
    if not isinstance(value, bytes) or len(value) != size:
        message = f"{brief(value)} is no bytes of length {size}"
        raise ValueError(message)
    return value


octets: OctetType[bytes] = OctetType(Kind.BYTES, bytes, _same_length, bytes.fromhex, bytes.hex)


def _packed(raw: bytes, size: int) -> bytes:
    """The last `size` bytes, or of twice as many the low ones: one a register."""
    return raw[1::2] if len(raw) == 2 * size else raw[-size:]


def _unpacked(packed: bytes, size: int) -> bytes:
    return _spread(packed, "low") if size == 2 * len(packed) else packed.rjust(size, b"\0")


def _network(kind: Kind, address: type[IPv4Address | IPv6Address], size: int) -> OctetType[Any]:
    def write(value: object, room: int) -> bytes:
        if not isinstance(value, address):
            message = f"{brief(value)} is no {address.__name__}"
            raise ValueError(message)  # noqa: TRY004 (all refusals are alike)
        packed: bytes = value.packed
        return _unpacked(packed, room)

    return OctetType(kind, lambda raw: address(_packed(raw, size)), write, address)


ipv4: OctetType[IPv4Address] = _network(Kind.IPV4, IPv4Address, 4)
ipv6: OctetType[IPv6Address] = _network(Kind.IPV6, IPv6Address, 16)


def _hardware(size: int) -> OctetType[str]:
    def write(value: object, room: int) -> bytes:
        parts = value.split(":") if isinstance(value, str) else []
        try:
            packed = bytes.fromhex("".join(parts)) if all(len(part) == 2 for part in parts) else b""  # noqa: PLR2004
        except ValueError:
            packed = b""
        if len(packed) != size or len(parts) != size:
            message = f"{brief(value)} is no address of {size} bytes, as {':'.join(['0a'] * size)}"
            raise ValueError(message)
        return _unpacked(packed, room)

    return OctetType(Kind.MAC, lambda raw: _packed(raw, size).hex(":"), write, str.lower)


eui48: OctetType[str] = _hardware(6)
eui64: OctetType[str] = _hardware(8)
