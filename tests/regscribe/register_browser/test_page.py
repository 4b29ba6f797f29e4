"""The page is one file that asks nobody, and that texts of a map cannot change."""

import re
from dataclasses import replace
from html.parser import HTMLParser
from importlib.resources import files

import pytest

from regscribe.model import RegisterMap
from regscribe.register_browser import page
from regscribe.register_browser.page import CODEC, digest, embedded

from ...conformance.suite import diagnose, whole_map  # noqa: TID252 (test folders are no packages)

HOSTILE = "</script><script>alert(1)</script><!-- $script \u2028 \u202e javascript:alert(1) \x07"
PARTS = {"registers": [{"at": 0, "name": "Level", "description": "plain"}]}


class Elements(HTMLParser):
    """What a browser makes of a page: the texts of its elements that are no text for people, and its attributes."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.texts: dict[str, list[str]] = {"script": [], "style": [], "title": []}
        self.attributes: list[tuple[str, str | None]] = []
        self.within = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.attributes += attrs
        self.within = tag if tag in self.texts else ""
        if self.within:
            self.texts[tag].append("")

    def handle_endtag(self, tag: str) -> None:
        self.within = "" if tag == self.within else self.within

    def handle_data(self, data: str) -> None:
        if self.within:
            self.texts[self.within][-1] += data


@pytest.fixture(scope="module")
def level() -> RegisterMap:
    register_map, found = diagnose(whole_map(PARTS))
    assert register_map is not None, found
    return register_map


def test_the_policy_names_exactly_the_script_and_the_style_of_the_page(level: RegisterMap) -> None:
    found = Elements(page([level]))
    policy = next(value for name, value in found.attributes if name == "content" and value and "script-src" in value)
    assert f"script-src '{digest(found.texts['script'][1])}'" in policy
    assert f"style-src '{digest(found.texts['style'][0])}'" in policy
    assert policy.startswith("default-src 'none'")
    assert "unsafe" not in policy


def test_texts_of_a_map_are_data_and_nothing_else(level: RegisterMap) -> None:
    (model,) = level.models
    register = replace(model.registers[0], name=HOSTILE, description=HOSTILE, section=HOSTILE)
    changed = replace(model, members=(register,), registers=(register,), by_path={})
    plain, hostile = Elements(page([level])), Elements(page([replace(level, title=HOSTILE, models=(changed,))]))
    assert len(hostile.texts["script"]) == len(plain.texts["script"]) == 2
    assert hostile.texts["script"][1] == plain.texts["script"][1]
    assert "<" not in hostile.texts["script"][0]
    assert [name for name, _ in hostile.attributes] == [name for name, _ in plain.attributes]


def test_no_character_of_the_data_ends_a_line_of_a_script() -> None:
    assert embedded('["a\u2028b\u2029</script>"]') == '["a\\u2028b\\u2029\\u003c/script>"]'


def test_the_page_names_no_other_place_than_itself(level: RegisterMap) -> None:
    text = page([level])
    assert not re.search(r"(?:src|href)=[\"']?(?!#)", text.replace("data:", ""))
    assert not re.search(r"\b(?:fetch|XMLHttpRequest|WebSocket|eval|innerHTML|outerHTML|document\.write)\b", text)


def test_every_script_of_the_arithmetic_is_in_the_page() -> None:
    folder = files("regscribe.register_browser").joinpath("assets/codec")
    assert sorted(CODEC) == sorted(one.name.removesuffix(".js") for one in folder.iterdir())


def test_the_same_maps_give_the_same_page(level: RegisterMap) -> None:
    assert page([level, level]) == page([level, level])
