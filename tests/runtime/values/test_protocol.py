"""What a device says of itself is found by code and by function."""

from fractions import Fraction

from regscribe_runtime.values.protocol import ExceptionCode, Latency, Protocol, SerialDefaults
from regscribe_runtime.values.serial_line import SerialLine

OWN = Protocol(
    exceptions=(ExceptionCode(2, "nowhere", "no such address"),),
    latencies=(Latency(3, 1, 2, Fraction("0.5"), 4), Latency(16)),
)


def test_an_exception_without_an_entry_has_no_name_and_no_meaning() -> None:
    assert OWN.exception(2) == ExceptionCode(2, "nowhere", "no such address")
    assert OWN.exception(3) == ExceptionCode(3, "", "")


def test_a_latency_is_found_by_its_function_and_grows_by_words() -> None:
    assert (OWN.latency(3), OWN.latency(4)) == (OWN.latencies[0], None)
    assert OWN.latencies[0].longest(10) == 42


def test_the_line_of_a_device_is_9600_8n1_unless_its_manual_says_otherwise() -> None:
    assert SerialDefaults().line == SerialLine("", 9600, 8, "N", 1)
    assert SerialDefaults(baud=300, format="7E2").line == SerialLine("", 300, 7, "E", 2)
