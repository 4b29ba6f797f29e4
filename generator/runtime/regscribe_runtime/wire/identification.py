"""Device identification: function 43, type 14 (Modbus Application Protocol V1.1b3, section 6.21).

An object is a text of bytes. Its words here have two bytes each, NUL behind the last; its number is in the high bits of
an address.
"""

from collections.abc import Mapping, Sequence

from regscribe_runtime.values.wire_types import Space
from regscribe_runtime.wire.packing import MalformedError, pack_words, unpack_words
from regscribe_runtime.wire.requests import IDENTIFY, Reply, Request

MEI_TYPE = 14
BASIC, REGULAR, EXTENDED, INDIVIDUAL = 1, 2, 3, 4
"""How much is asked for: the objects of a category, or one object."""
LAST_OBJECT = {BASIC: 2, REGULAR: 127, EXTENDED: 255}
CONFORMITY = 0x83
"""What a device answers about itself: all categories, as a stream and one by one."""
_HEAD, _LONGEST = 7, 253


def encode_request(request: Request) -> bytes:
    """The request for one object."""
    return bytes((IDENTIFY, MEI_TYPE, INDIVIDUAL, request.address >> Space.IDENTIFICATION.part_bits))


def category_of(pdu: bytes) -> tuple[int, int]:
    """The category and the first object that a request asks for; MalformedError for bytes that are none."""
    if len(pdu) != 4 or pdu[1] != MEI_TYPE or not BASIC <= pdu[2] <= INDIVIDUAL:  # noqa: PLR2004 (function to object)
        message = f"{pdu.hex(' ')} is no request for the identification of a device"
        raise MalformedError(message)
    return pdu[2], pdu[3]


def decode_request(pdu: bytes) -> Request:
    """The request for an object; of a stream, for its first one."""
    _, first = category_of(pdu)
    space = Space.IDENTIFICATION
    return Request(IDENTIFY, first << space.part_bits, space.most)


def encode_objects(category: int, first: int, objects: Mapping[int, bytes]) -> bytes:
    """The answer with as many objects as fit, from `first` on; of a stream that knows no such object, from 0 on."""
    last = first if category == INDIVIDUAL else LAST_OBJECT[category]
    begin = first if first in objects else 0
    data, count, following = b"", 0, 0
    for number in sorted(one for one in objects if begin <= one <= last):
        if _HEAD + len(data) + 2 + len(objects[number]) > _LONGEST:
            following = number
            break
        data, count = data + bytes((number, len(objects[number]))) + objects[number], count + 1
    more = 0xFF if following else 0
    return bytes((IDENTIFY, MEI_TYPE, category, CONFORMITY, more, following, count)) + data


def encode_reply(reply: Reply) -> bytes:
    """The answer with one object."""
    number = reply.address >> Space.IDENTIFICATION.part_bits
    return encode_objects(INDIVIDUAL, number, {number: text_of(reply.words)})


def text_of(words: Sequence[int]) -> bytes:
    """The bytes of an object, without what only fills it up."""
    return pack_words(words).partition(b"\0")[0].rstrip(b" ")


def decode_reply(request: Request, pdu: bytes) -> Reply:
    """The words that were asked for of the object; none where the answer is not about it."""
    space = Space.IDENTIFICATION
    number, first = request.address >> space.part_bits, request.address & (1 << space.part_bits) - 1
    head, rest = pdu[1:3], pdu[_HEAD:]
    if len(pdu) < _HEAD + 2 or head != bytes((MEI_TYPE, INDIVIDUAL)) or rest[0] != number or len(rest) < 2 + rest[1]:
        return Reply(IDENTIFY)
    text = rest[2 : 2 + rest[1]].ljust(2 * space.most, b"\0")
    return Reply(IDENTIFY, unpack_words(text[: 2 * space.most])[first : first + request.quantity])
