"""What the reference says goes with each register: its group, the arrays that it is in, its errata and examples."""

from collections.abc import Callable
from typing import Any

from regscribe.emit.markdown.context import context
from regscribe.model import RegisterMap
from regscribe.register_browser.said import about, said

TAIL = """
  - id: recipe
    name: Recipe
    source: "4"
    description: Written as a whole.
    each: {access: rw, type: int16}
    registers:
      - id: segments
        name: Segment
        repeat: 1..2
        stride: 2
        description: Ramps, then soaks.
        registers:
          - {at: 20, id: ramp, name: Ramp Time}
          - {at: 21, id: soak, name: Soak Time}
      - {at: 30, id: cycles, name: Cycles}
errata:
  - {where: "3.1", printed: one, read: two, why: three}
examples:
  - {source: "3.1", register: level, words: [7], value: 7}
"""


def text_of(value: Any) -> str:
    if isinstance(value, str):
        return value
    if isinstance(value, list):
        return " ".join(map(text_of, value))
    return value.get("text", "") if "text" in value else text_of([*value.get("headers", ()), *value.get("rows", ())])


def test_every_register_of_an_array_says_what_the_array_and_the_group_say(
    model_of: Callable[[str], RegisterMap], small: Callable[..., str]
) -> None:
    found = said(context(model_of(small("at: 1, id: level, name: Level", tail=TAIL))))
    for anchor in ("register-segments-ramp", "register-segments-soak"):
        assert "Ramps, then soaks." in text_of(found[anchor]["array"])
        assert "Written as a whole." in text_of(found[anchor]["group"])
    assert "array" not in found["register-cycles"]
    assert text_of(found["register-level"]["group"]).startswith("Control")


def test_examples_and_errata_go_with_their_registers_and_with_the_map(
    model_of: Callable[[str], RegisterMap], small: Callable[..., str]
) -> None:
    found = context(model_of(small("at: 1, id: level, name: Level", tail=TAIL)))
    level = said(found)["register-level"]
    assert level["section_errata"] == [0]  # the level stands in this section; of the level it says nothing
    assert "errata" not in level
    assert "0007" in text_of(level["examples"])
    assert {"examples", "errata", "section_errata"}.isdisjoint(said(found)["register-cycles"])
    assert "one two three" in text_of(about(found)["errata"])
