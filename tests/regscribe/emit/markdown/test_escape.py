"""Text of a map is text in the rendered page, wherever it stands."""

import re
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from markdown_it import MarkdownIt

from regscribe.emit.markdown.escape import CONTROL, code, escape, md, prose

HOSTILE = [
    "a|b",
    "<script>alert(1)</script>",
    "two\nlines\r\n\r\nand a paragraph",
    "`code` ``more``",
    "[x](javascript:y)",
    "![x](http://a.example/p.png)",
    "*emphasis* **strong** _under_ __score__ snake_case_name",
    "~~gone~~ $x$ $1E2",
    "# heading #",
    "1. list",
    "12) list",
    "- list",
    "+ list",
    "> quote",
    "---",
    "===",
    "- - -",
    "```python",
    "~~~",
    "    indented",
    "&amp; &lt; &#35; & co",
    "back\\slash \\| \\n",
    "😀 👩\u200d🔧 °C é",
    "<!-- comment -->",
    "[ref]: http://x.example",
    "| --- | --- |",
    "see www.example.com or mail a.b@example.com",
    "trailing\\",
    "{{ 7*7 }} {% raw %}",
]

PLACES = {
    "paragraph": "{}\n",
    "heading": "## {}\n",
    "item": "- {}\n",
    "cell": "| head |\n| --- |\n| {} |\n",
    "second cell": "| a | b |\n| --- | --- |\n| x | {} |\n",
    "after a paragraph": "paragraph\n\n{}\n",
}
ALLOWED = {"p", "h2", "ul", "li", "table", "thead", "tbody", "tr", "th", "td", "code"}


MARKDOWN = MarkdownIt("commonmark").enable(["table", "strikethrough"])


def shown(text: str) -> str:
    return CONTROL.sub(lambda found: f"U+{ord(found[0]):04X}", re.sub(r"\s+", " ", text)).strip()


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_text_renders_as_itself(
    text: str, place: str, markdown: MarkdownIt, parse: Callable[[str], Any]
) -> None:
    page = parse(markdown.render(PLACES[place].format(escape(text))))
    assert page.tags <= ALLOWED
    assert not page.links
    assert shown(text) in " ".join(page.text.split())
    assert all(len(set(table)) == 1 for table in page.tables)


@settings(max_examples=300, deadline=None)
@given(text=st.text(min_size=1, max_size=40) | st.text(alphabet="ab1 .)-+=*_`[]()!#~|<>&\\$:/@w\n", max_size=30))
def test_any_text_renders_as_itself_in_a_cell_and_a_paragraph(text: str) -> None:
    tokens = MARKDOWN.parse(f"| x | {escape(text)} | y |\n| --- | --- | --- |\n\nstart{escape(text)}\n")
    inline = [token for token in tokens if token.type == "inline"]
    assert tokens[0].type == "table_open"
    assert len(inline) == 4
    assert {child.type for token in inline for child in token.children or ()} <= {"text", "code_inline"}
    joined = "".join(child.content for child in inline[3].children or ())
    assert " ".join(joined.split()) == shown(f"start{text}")


def test_characters_that_turn_the_writing_direction_are_shown_by_number() -> None:
    assert escape("safe\u202eelbisivni") == "safeU+202Eelbisivni"
    assert escape("\u2066x\u2069") == "U+2066xU+2069"


def test_addresses_of_the_net_stand_in_code_so_that_no_renderer_links_them() -> None:
    assert (
        escape("see https://example.com/a_b, mail x@y.example") == "see `https://example.com/a_b,` mail `x@y.example`"
    )


def test_names_with_underscores_and_negative_numbers_stay_readable() -> None:
    assert escape("set_point_1 is -1999.9 to +5 (3.5 %)") == "set_point_1 is -1999.9 to +5 (3.5 %)"


def test_ready_markdown_is_not_escaped_again() -> None:
    assert md("a|b ", code("x_y"), " <") == "a\\|b `x_y` &lt;"


def test_a_code_span_that_would_break_is_escaped_text() -> None:
    assert code("a`b") == "a\\`b"
    assert code("a|b") == "a\\|b"


def test_prose_may_quote_a_name_and_nothing_else() -> None:
    assert prose("`dp` and `<b>` *x*") == "`dp` and \\`&lt;b&gt;\\` \\*x\\*"
