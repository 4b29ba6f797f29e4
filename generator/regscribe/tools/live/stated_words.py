"""Words that somebody has read elsewhere, as frames: `4095=0x24` is an answer with that word from holding 4095."""

from regscribe.model.address_text import MODICON
from regscribe.tools.live.addresses import found_at, is_address
from regscribe.tools.live.errors import TargetError
from regscribe.tools.live.names import Driver, register_named
from regscribe.tools.live.value_text import whole_of
from regscribe_runtime.planning.address_ranges import places
from regscribe_runtime.values.views import View, read_view
from regscribe_runtime.values.wire_types import Space
from regscribe_runtime.wire.capture import CapturedFrame
from regscribe_runtime.wire.pdu import encode_reply, encode_request
from regscribe_runtime.wire.requests import Reply, Request

STATED = "stated"
"""The framing of such a frame."""

_WORDS = range(-0x8000, 0x10000)
"""A word as a number, with a sign or without."""


def exchange(driver: Driver, text: str, first: int = 0) -> tuple[CapturedFrame, CapturedFrame]:
    """Return request and answer for `ADDRESS=WORD,..` or `NAME=WORD,..`; `first` is 1 for JBUS. Raises TargetError."""
    where, _, digits = text.partition("=")
    words = tuple(map(_word, digits.split(",")))
    space, address, size = _place(driver, where.strip())
    if len(words) < size:
        message = f"{where} has {size} words: write {where}={','.join(['0x0'] * size)}, the first one first"
        raise TargetError(message)
    request = Request(space.read_function, address + first, len(words))
    if space.is_bits and not set(words) <= {0, 1}:
        message = f"{text}: a bit is 0 or 1"
        raise TargetError(message)
    reply = Reply(request.function, words)
    return _frame(encode_request(request)), _frame(encode_reply(reply))


def _frame(pdu: bytes) -> CapturedFrame:
    return CapturedFrame(STATED, 1, pdu, pdu)


def _word(text: str) -> int:
    word = whole_of(text.strip())
    if word is None or word not in _WORDS:
        message = f"`{text.strip()[:40]}` is no word: write 36, -5 or 0x24; several with commas"
        raise TargetError(message)
    return word & 0xFFFF


def _place(driver: Driver, where: str) -> tuple[Space, int, int]:
    """The space, the first address, and how many words have to be there."""
    if where in driver.registers or not is_address(where):
        register = register_named(driver, where)
        view = read_view(register)
        _check_plain(view, where)
        return view.space, next(address for one, address in places(register) if one == view), view.words
    meaning, hits = found_at(where, driver.registers, driver.model)
    begun = [hit for hit in hits if hit.word == 0]
    if not begun:
        hit = hits[0]
        message = f"{where} of {driver.model} is {hit.spelled}: write {hit.first}={','.join(['0x0'] * hit.view.words)}"
        raise TargetError(message)
    for hit in begun:
        _check_plain(hit.view, where)
    return meaning.space or Space.HOLDING, meaning.address, min(hit.view.words for hit in begun)


def _check_plain(view: View, where: str) -> None:
    if view.is_apart or view.space not in MODICON:
        message = f"the words of {where} do not stand side by side in a space that all devices have: give a frame"
        raise TargetError(message)
