"""A reading outside what is valid is an error of a class of its own, which says the limits."""

import pytest

from regscribe_runtime import OutOfRange, SensorFault, ValueNotDecodable, ValueRefused
from regscribe_runtime.driver.declarations import ReadWrite
from regscribe_runtime.registers.value_types import number
from regscribe_runtime.values.conditions import always
from regscribe_runtime.values.scales import Conversion, Sentinel, within
from regscribe_runtime.values.views import word
from regscribe_runtime.values.wire_types import WireType

LEVEL = ReadWrite(
    0,
    word(WireType.UINT16),
    number,
    scale=always(Conversion(multiply=2)),
    valid=within(0, 600),
    sentinels=(Sentinel(65000, "NONE", "none", high=65535),),
)


def test_a_reading_outside_is_no_number() -> None:
    assert LEVEL.decode((300,)) == 600
    with pytest.raises(OutOfRange, match="602 lies outside 0 to 600") as caught:
        LEVEL.decode((301,))
    assert isinstance(caught.value, ValueNotDecodable)
    assert caught.value.words == (301,)


def test_a_write_outside_is_refused() -> None:
    with pytest.raises(ValueRefused, match="602 lies outside 0 to 600"):
        LEVEL.encode(602)


@pytest.mark.parametrize("word_read", [65000, 65123, 65535])
def test_every_number_of_an_interval_is_the_fault(word_read: int) -> None:
    with pytest.raises(SensorFault) as caught:
        LEVEL.decode((word_read,))
    assert caught.value.fault == "NONE"
