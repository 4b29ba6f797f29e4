"""A register has the errata that are about it; those of its section are told apart, others stay with the map."""

from collections.abc import Callable

import pytest

from regscribe.model import Erratum, Register, RegisterMap
from regscribe.register_browser.errata import concerning


@pytest.fixture
def soak_time(model_of: Callable[[str], RegisterMap], small: Callable[..., str]) -> Register:
    time = "at: 12, id: soak_time, name: Soak Time, source: 3.1, type: uint16, flags: {0: Heat Off}"
    rows = ("at: 7, id: level, name: Level, source: 3.2", time)
    return model_of(small(*rows)).models[0].register("soak_time")


@pytest.mark.parametrize(
    ("where", "read", "own", "of_section"),
    [
        ("3.1", "", [], [1]),
        ("3.1.2", "", [], []),  # a section inside that of the register
        ("13.1", "", [], []),
        ("9.9 against 3.1", "", [], [1]),
        ("3.1 (register 7)", "", [], []),  # another register of the section
        ("3.1 (registers 7 and 12)", "", [1], []),
        ("9.9 (registers 7, 9 to 14)", "", [1], []),
        ("3.1", "the Soak Time counts minutes", [1], []),
        ("9.9", "`soak_time` counts minutes", [1], []),
        ("9.9", "bit 0 is Heat Off", [1], []),  # a bit of the register
        ("9.9", "soak_times count minutes", [], []),
        ("9.9", "soaking", [], []),
    ],
)
def test_an_erratum_is_about_a_register_that_it_names_and_else_of_its_section(
    soak_time: Register, where: str, read: str, own: list[int], of_section: list[int]
) -> None:
    errata = (Erratum("0.0", "", "", ""), Erratum(where, "", read, ""))
    assert concerning(errata, [soak_time]) == (own, of_section)
