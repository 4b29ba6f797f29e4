"""Python-Markdown shows what GitHub shows, and no text of a map sets a tag, an attribute or a link."""

from collections.abc import Callable
from html.parser import HTMLParser
from pathlib import Path

import pytest
from markdown import markdown

from regscribe.emit.markdown import render
from regscribe.pipeline import compile_map
from regscribe.site.config import EXTENSIONS
from regscribe.site.dialect import convert, github_slug


def same(target: str) -> str:
    return target


def html(text: str, link: Callable[[str], str] = same) -> str:
    options = {name: dict(one) for name, one in EXTENSIONS.items() if isinstance(one, dict)} | {"toc": {}}
    return markdown(convert(text, link), extensions=list(options), extension_configs=options)


def test_a_heading_keeps_the_anchor_that_stood_in_it() -> None:
    assert html('#### <a id="register-x"></a>Input Type') == '<h4 id="register-x">Input Type</h4>'


@pytest.mark.parametrize(
    ("heading", "anchor"),
    [
        ("Read on", "read-on"),
        ("`regscribe import` -- in 10 minutes!", "regscribe-import----in-10-minutes"),
        ("A [link](x.md) & more", "a-link--more"),
        ("Übersicht", "übersicht"),
        ("!", "section"),
    ],
)
def test_other_headings_get_the_anchor_that_github_gives_them(heading: str, anchor: str) -> None:
    assert github_slug(heading) == anchor


def test_no_id_is_given_twice_and_none_that_stands_in_the_page() -> None:
    found = html('# Notes\n\n## Notes\n\n## <a id="notes"></a>Notes')
    assert [part.partition('"')[0] for part in found.split('id="')[1:]] == ["notes-1", "notes-2", "notes"]


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("said:\n- one\n- two", "<li>one</li>"),
        ("said:\n| A | B |\n| --- | --- |\n| 1 | 2 |", "<td>1</td>"),
        ("said:\n```yaml\na: {b: 1}\n```\nafter", "<pre>"),
        ("- one\n  - inner\n- two", "<li>one<ul>\n<li>inner</li>"),
        ("<details>\n<summary>more</summary>\n\n| A |\n| --- |\n| 1 |\n\n</details>", "<td>1</td>"),
    ],
)
def test_blocks_begin_where_they_begin_on_github(text: str, part: str) -> None:
    assert part in html(text).replace("\n<ul>", "<ul>")


def test_escapes_that_only_github_knows_show_the_character() -> None:
    assert html(r"\$1E2 \~ \| \= 5") == "<p>&#36;1E2 &#126; &#124; &#61; 5</p>"


def test_code_is_left_alone() -> None:
    assert html("`{a: \\$}` and `[x](y)`", lambda _: "") == "<p><code>{a: \\$}</code> and <code>[x](y)</code></p>"
    assert "{b: 1}" in html("```\n{b: 1} [x](y)\n```", lambda _: "")


def test_a_link_goes_where_it_is_told_or_becomes_its_text() -> None:
    text = "See [`x` and y](a.md#b), ![picture](c.svg)."
    assert html(text, lambda target: f"../{target}") == (
        '<p>See <a href="../a.md#b"><code>x</code> and y</a>, <img alt="picture" src="../c.svg" />.</p>'
    )
    assert html(text, lambda _: "") == "<p>See <code>x</code> and y, picture.</p>"


@pytest.mark.parametrize(
    "line", ["::: os.system", "   ::: os.system", "#### ::: os.system", "- ::: os.system", "> ::: os"]
)
def test_no_text_asks_for_the_reference_of_a_python_object(line: str) -> None:
    assert ":::" not in convert(line, same)
    assert "::: os" in Page(html(line)).text


def test_a_silent_section_is_kept_out_of_the_search() -> None:
    assert convert('## <a id="overview"></a>Overview', same, frozenset({"overview"})) == (
        "## Overview { #overview data-search-exclude }"
    )


HOSTILE = (
    "x { onclick=alert(1) .y #z }",
    "x {: onclick=alert(1) }",
    "::: os.system",
    "<script>alert(1)</script> </details>",
    "[a](javascript:alert(1)) ![b](http://foreign.invalid/x.png)",
    "`code`{ onclick=alert(1) }",
    "$x$ ==m== ^^i^^ ++ctrl++ :smile: (c) --8<-- 'a' {{ 7*7 }} {% raw %}",
    "a|b\\|c | d",
    "[TOC]",
    "*[HTML]: abbr",
)


class Page(HTMLParser):
    """The tags, attributes and targets of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: set[str] = set()
        self.attributes: set[str] = set()
        self.targets: set[str] = set()
        self.text = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        self.attributes |= {name for name, _ in attrs}
        self.targets |= {value or "" for name, value in attrs if name in {"href", "src"}}

    def handle_data(self, data: str) -> None:
        self.text += data


@pytest.mark.parametrize("text", HOSTILE)
def test_a_hostile_map_stays_text_on_the_site(tmp_path: Path, text: str) -> None:
    quoted = "'" + text.replace("'", "''") + "'"
    path = tmp_path / "oven.yaml"
    path.write_text(
        f"""
format: 1
map: {{id: acme/oven, title: {quoted}, maker: {quoted}, class_prefix: Acme}}
manual: {{title: {quoted}}}
description: {quoted}
models: {{A: {{description: {quoted}}}}}
protocol: {{source: {quoted}, functions: [3, 6]}}
groups:
  - id: g
    name: {quoted}
    description: {quoted}
    source: {quoted}
    registers:
      - {{at: 1, id: one, name: {quoted}, access: rw, symbol: {quoted}, enum: {{0: {quoted}, 1: b}}}}
      - {{at: 2, id: two, name: {quoted}, description: {quoted}, danger: {quoted}, access: rw}}
""",
        encoding="utf-8",
    )
    compiled = compile_map(path)
    assert compiled.map is not None, compiled.diagnostics
    (page,) = render(compiled.map).values()
    shown = Page(html(page))

    assert shown.tags <= {
        "h1", "h2", "h3", "h4", "p", "a", "table", "thead", "tbody", "tr", "th", "td", "ul", "li", "code", "pre", "em",
        "strong", "br", "div", "span", "img", "blockquote",
    }  # fmt: skip
    assert shown.attributes <= {"id", "href", "class", "src", "alt"}
    assert {target for target in shown.targets if not target.startswith(("#", "oven/"))} == set()
    assert text.replace("`", "") in shown.text.replace("`", "")
