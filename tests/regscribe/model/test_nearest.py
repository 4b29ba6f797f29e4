"""Which known names a misspelt one may mean."""

from regscribe.model.nearest import near, nearest


def test_exchanged_letters_of_a_short_word_are_seen() -> None:
    assert nearest("emun", ["name", "type", "enum"]) == "enum"
    assert nearest("emum", ["name", "enum"]) == "enum"
    assert nearest("xyz", ["name", "enum"]) == ""


def test_names_that_are_nearly_as_like_are_meant_as_well() -> None:
    known = ["setpoint_ram", "alarm", "setpoints", "span"]
    assert near("setpont", known, most=5) == ["setpoints", "setpoint_ram"]
    assert near("setpont", known, most=1) == ["setpoints"]
    assert near("setpiont_ram", known, most=5) == ["setpoint_ram"]
