"""One block decodes all of its registers, whatever words they share."""

from regscribe_runtime import Order, ReadOnly, View, WireType, integer, number, word
from regscribe_runtime.operations.decode_block import PreparedBlock
from regscribe_runtime.operations.session import Session
from regscribe_runtime.planning.address_ranges import RegisterSpan
from regscribe_runtime.planning.plan import Block
from regscribe_runtime.values.protocol import Protocol
from regscribe_runtime.values.wire_types import Space


def test_a_register_that_shares_words_with_one_of_little_order_is_decoded_from_its_own() -> None:
    wide = ReadOnly(0, (View("base", WireType.FLOAT32, words=2, order=Order.LITTLE),), number)
    low = ReadOnly(0, word(WireType.UINT16), integer)
    wide.path, low.path = "wide", "low"
    block = Block(3, 0, 2, (RegisterSpan(Space.HOLDING, 0, 1), RegisterSpan(Space.HOLDING, 0, 2)))
    session = Session(unit=1, protocol=Protocol(), registers={"wide": wide, "low": low}, commands={}, givens={})

    prepared = PreparedBlock(block, [(wide, wide.views[0], 0), (low, low.views[0], 0)], session)

    assert prepared.decode((0x1234, 0x4148)) == {"wide": 12.504444, "low": 0x1234}
