"""A register shows the errata of its section, and those that name it; others stay with the map."""

from collections.abc import Callable

import pytest

from regscribe.model import Erratum, Register, RegisterMap
from regscribe.register_browser.errata import concerning


@pytest.fixture
def soak_time(model_of: Callable[[str], RegisterMap], small: Callable[..., str]) -> Register:
    rows = ("at: 7, id: level, name: Level, source: 3.2", "at: 12, id: soak_time, name: Soak Time, source: 3.1")
    return model_of(small(*rows)).models[0].register("soak_time")


@pytest.mark.parametrize(
    ("where", "read", "found"),
    [
        ("3.1", "", [1]),
        ("3.1.2", "", []),  # a section inside that of the register
        ("13.1", "", []),
        ("9.9 against 3.1", "", [1]),
        ("3.1 (register 7)", "", []),  # another register of the section
        ("3.1 (registers 7 and 12)", "", [1]),
        ("9.9 (registers 7, 9 to 14)", "", [1]),
        ("9.9", "the Soak Time counts minutes", [1]),
        ("9.9", "`soak_time` counts minutes", [1]),
        ("9.9", "soak_times count minutes", []),
        ("9.9", "soaking", []),
    ],
)
def test_an_erratum_concerns_a_register_by_section_address_or_name(
    soak_time: Register, where: str, read: str, found: list[int]
) -> None:
    errata = (Erratum("0.0", "", "", ""), Erratum(where, "", read, ""))
    assert concerning(errata, [soak_time]) == found
