"""Inline Markdown becomes runs of text, with everything that a map says as plain text."""

import pytest

from regscribe.emit.markdown.escape import code, escape, link, md
from regscribe.register_browser.inline_text import runs

HOSTILE = (
    "<script>alert(1)</script>",
    "</script><img src=x onerror=alert(1)>",
    "[click](javascript:alert(1)) ![x](y)",
    "**bold** `code` \\ <br> &lt; &amp; &#60;",
    '<a id="x"></a>',
    "http://example.invalid/`x`",
)


def test_code_links_and_lines_become_runs() -> None:
    text = md(link(code("a[1]"), "register-a"), " is 1", escape(""), link("x < y", "condition-x"))
    assert runs(text) == [
        {"text": "a[1]", "code": True, "to": "register-a"},
        " is 1",
        {"text": "x < y", "to": "condition-x"},
    ]
    assert runs('**16C:** 1<br><a id="unit-t"></a>t') == [
        {"text": "16C:", "strong": True},
        " 1\n",
        {"id": "unit-t"},
        "t",
    ]


@pytest.mark.parametrize("text", HOSTILE)
def test_text_of_a_map_stays_text(text: str) -> None:
    found = runs(escape(text))
    assert "".join(run if isinstance(run, str) else run["text"] for run in found) == text
    assert not any("to" in run or "id" in run for run in found if isinstance(run, dict))
