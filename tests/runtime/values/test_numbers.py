import pytest

from regscribe_runtime.values.numbers import parse


@pytest.mark.parametrize("text", ["1e999999999", "-1e-999999999", "1e401"])
def test_a_short_text_of_a_monstrous_number_is_refused_at_once(text: str) -> None:
    with pytest.raises(ValueError, match="more than 400 digits"):
        parse(text)


def test_every_number_of_64_bits_and_zero_in_any_spelling_are_taken() -> None:
    assert float(parse("1.7976931348623157e308")) == 1.7976931348623157e308
    assert float(parse("5e-324")) == 5e-324
    assert parse("0e999999999") == 0
