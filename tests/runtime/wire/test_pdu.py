"""Requests and answers as bytes: what one side encodes the other one decodes, and what is none is refused."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe_runtime.wire.packing import MalformedError
from regscribe_runtime.wire.pdu import (
    CoilStateError,
    decode_reply,
    decode_request,
    encode_reply,
    encode_request,
)
from regscribe_runtime.wire.requests import READ_SPACES, WRITES, Reply, Request, fits

numbers = st.integers(0, 0xFFFF)
words = st.lists(numbers, min_size=1, max_size=127).map(tuple)
bits = st.lists(st.integers(0, 1), min_size=1, max_size=2040).map(tuple)


@st.composite
def exchanges(draw: st.DrawFn) -> tuple[Request, Reply]:
    """A request with the answer of a device that does as it is told."""
    function, address = draw(st.sampled_from([1, 2, 3, 4, 5, 6, 7, 8, 15, 16, 22])), draw(numbers)
    match function:
        case 1 | 2 | 3 | 4:
            held = draw(bits if function in (1, 2) else words)
            return Request(function, address, len(held)), Reply(function, held)
        case 15 | 16:
            held = draw((bits if function == 15 else words).filter(lambda each: len(each) <= 1968))
            return Request(function, address, len(held), held), Reply(function, (), address, len(held))
        case 7:
            return Request(function, 0), Reply(function, (draw(st.integers(0, 255)),))
        case _:
            sent = {5: (draw(st.integers(0, 1)),), 22: (draw(numbers), draw(numbers))}.get(function, (draw(numbers),))
            return Request(function, address, 1, sent), Reply(function, sent, address)


@given(exchange=exchanges())
def test_what_one_side_says_the_other_one_understands(exchange: tuple[Request, Reply]) -> None:
    request, reply = exchange
    assert decode_request(encode_request(request)) == request
    assert decode_reply(request, encode_reply(reply)) == reply
    assert fits(request, reply)


@given(exchange=exchanges(), code=st.integers(0, 255))
def test_a_refusal_names_its_function_and_a_code(exchange: tuple[Request, Reply], code: int) -> None:
    request, _ = exchange
    refusal = Reply(request.function, exception=code)
    assert decode_reply(request, encode_reply(refusal)) == refusal


def test_the_bytes_are_those_of_the_specification() -> None:
    # Modbus Application Protocol V1.1b3, 6.1, 6.3, 6.11 and 6.16
    assert encode_request(Request(1, 19, 19)) == bytes.fromhex("01 00 13 00 13")
    assert encode_reply(Reply(1, (1, 0, 1, 1, 0, 0, 1, 1, 1, 1, 0, 1, 0, 1, 1, 0, 1, 0, 1))) == bytes.fromhex(
        "01 03 CD 6B 05"
    )
    assert encode_reply(Reply(3, (555, 0, 100))) == bytes.fromhex("03 06 02 2B 00 00 00 64")
    assert encode_request(Request(15, 19, 10, (1, 0, 1, 1, 0, 0, 1, 1, 1, 0))) == bytes.fromhex(
        "0F 00 13 00 0A 02 CD 01"
    )
    assert encode_reply(Reply(15, (), 19, 10)) == bytes.fromhex("0F 00 13 00 0A")
    assert encode_request(Request(22, 4, 1, (0xF2, 0x25))) == bytes.fromhex("16 00 04 00 F2 00 25")


@pytest.mark.parametrize(
    ("pdu", "said"),
    [
        ("03 00 40 00", "3 bytes after the function code, 4 expected"),
        ("03 00 40 00 04 00", "5 bytes after the function code, 4 expected"),
        ("10", "0 bytes after the function code, 5 expected"),
        ("10 00 00 00 02 04 00 55", "7 bytes after the function code, 9 expected"),
        ("10 00 00 00 02 02 00 55", "2 words are announced, but 2 bytes"),
        ("0F 00 14 00 0A 01 CD", "10 bits are announced, but 1 bytes"),
        ("07 00", "1 bytes after the function code, 0 expected"),
        ("83 02", "function 131 is not known"),
    ],
)
def test_a_request_that_no_device_takes_is_refused(pdu: str, said: str) -> None:
    with pytest.raises(MalformedError, match=said):
        decode_request(bytes.fromhex(pdu))


@pytest.mark.parametrize("state", ["00 01", "FF FF", "01 00"])
def test_a_coil_is_either_on_or_off(state: str) -> None:
    with pytest.raises(CoilStateError, match="is no state of a coil: FF00 is on, 0000 is off"):
        decode_request(bytes.fromhex(f"05 00 14 {state}"))


@given(pdu=st.binary(min_size=1, max_size=260))
def test_any_bytes_are_a_request_or_malformed(pdu: bytes) -> None:
    try:
        request = decode_request(pdu)
    except MalformedError:
        return
    assert encode_request(request)[:5] == pdu[:5]


def test_addresses_are_shifted_where_a_function_has_one() -> None:
    assert Request(3, 7).shifted(1) == Request(3, 8)
    assert Request(16, 7, 1, (5,)).shifted(-1) == Request(16, 6, 1, (5,))
    assert Request(8, 0, 1, (5,)).shifted(1) == Request(8, 0, 1, (5,))
    assert set(READ_SPACES) | WRITES == {1, 2, 3, 4, 5, 6, 7, 15, 16, 20, 21, 24, 43}
