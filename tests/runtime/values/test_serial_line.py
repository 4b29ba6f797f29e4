"""What a character and the silence between frames take, and which settings there are."""

import pytest

from regscribe_runtime.values.serial_line import SerialLine, first_address


@pytest.mark.parametrize(("form", "bits"), [("8N1", 10), ("8E1", 11), ("7O2", 11), ("8N2", 11), ("7n1", 9)])
def test_a_character_has_a_start_bit_data_parity_and_stop_bits(form: str, bits: int) -> None:
    line = SerialLine.of("", 1200, form)
    assert (line.bits, line.character) == (bits, bits / 1200)  # Series C, 1.2.8.3: CharBits is 11 with parity
    assert line.format == form.upper()


def test_above_19200_baud_the_silence_is_a_fixed_time() -> None:
    assert SerialLine(baud=115200).silence(3.5) == 0.00175
    assert SerialLine(baud=115200).silence(0) == 0
    assert SerialLine(baud=19200).silence(3.5) == pytest.approx(3.5 * 10 / 19200)
    assert SerialLine(baud=9600).silence(4) == pytest.approx(0.00417, abs=5e-6)  # Series C, 1.2.8.4


@pytest.mark.parametrize("form", ["", "8N", "9N1", "8X1", "8N3", "8N1 ", "5N1", "8M1"])
def test_an_impossible_character_format_is_one_clear_message(form: str) -> None:
    with pytest.raises(ValueError, match=f"character format '{form}' is none: write .* such as 8N1"):
        SerialLine.of("", 9600, form)


@pytest.mark.parametrize("wrong", [{"baud": 0}, {"parity": "X"}, {"data_bits": 9}, {"stop_bits": 3}])
def test_a_line_that_no_port_can_be_set_to_is_refused(wrong: dict[str, object]) -> None:
    with pytest.raises(ValueError, match=r"baud|character format"):
        SerialLine(**wrong).checked()  # type: ignore[arg-type] # wrong on purpose


def test_jbus_counts_from_one_and_nobody_counts_otherwise() -> None:
    assert (first_address("modbus"), first_address("jbus")) == (0, 1)
    with pytest.raises(ValueError, match="addressing 'profibus' is none of modbus, jbus"):
        first_address("profibus")
