"""The canonical form, rule by rule."""

from textwrap import dedent

import pytest

from regscribe import map_format, source
from regscribe.map_format import FormatError, formatted

NARROW = "x" * 70


def form(text: str) -> str:
    document, diagnostics = source.parse(dedent(text), name="map.yaml")
    assert document is not None, diagnostics
    return formatted(document)


def test_levels_are_two_columns_deep_and_a_list_stands_below_its_key() -> None:
    assert form("groups:\n- id: a\n  registers:\n      -   at: 1\n          name: A\n") == (
        "groups:\n  - id: a\n    registers:\n      - at: 1\n        name: A\n"
    )


def test_blanks_in_brackets_are_those_of_prose() -> None:
    assert form("a: { at :1,name:  A ,list: [ 1,2 , ] }\nb:   {  }\n".replace(":1", ": 1")) == (
        "a: {at: 1, name: A, list: [1, 2]}\nb: {}\n"
    )


def test_the_authors_line_ends_stay_and_rows_stand_behind_the_outer_bracket() -> None:
    assert form(
        """\
        - {at: 1, name: A,
               unit: s, enum: {0: a,
               1: b}}
        """
    ) == (
        "- {at: 1, name: A,\n"
        "   unit: s, enum: {0: a,\n"
        "     1: b}}\n"
    )  # fmt: skip


def test_a_mapping_in_brackets_may_stand_below_its_key() -> None:
    assert form("enum:\n        {0: a,\n  1: b}\n") == "enum:\n  {0: a,\n   1: b}\n"


def test_a_bracket_that_closes_on_a_line_of_its_own_goes_up() -> None:
    assert form("a: {\n  b: 1,\n  c: 2\n}\n") == "a: {b: 1,\n    c: 2}\n"


def test_a_row_that_is_too_wide_ends_at_the_last_comma_of_the_fewest_brackets() -> None:
    text = NARROW[:60]
    assert form(f"- {{a: {text}, b: {{c: {text}, d: e}}, f: {text}}}\n") == (
        f"- {{a: {text}, b: {{c: {text}, d: e}},\n   f: {text}}}\n"
    )


def test_a_row_of_exactly_160_characters_is_not_too_wide() -> None:
    fits = f"- {{a: {'x' * 100}, b: {'y' * 48}}}\n"
    assert len(fits) == 161  # with the line feed
    assert form(fits) == fits
    assert form(fits.replace("y}", "yy}")) == f"- {{a: {'x' * 100},\n   b: {'y' * 49}}}\n"


def test_a_comment_behind_a_line_begins_in_column_56() -> None:
    assert form("a: 1 # x\nb: 2      # y\n") == f"a: 1{' ' * 51}# x\nb: 2{' ' * 51}# y\n"


def test_a_comment_behind_a_long_line_follows_two_blanks() -> None:
    assert form(f"a: {NARROW} # x\n") == f"a: {NARROW}  # x\n"


def test_a_comment_in_brackets_ends_its_line() -> None:
    assert form("a: [1, # one\n 2 # two\n , 3]\n") == (
        f"a: [1,{' ' * 49}# one\n    2,{' ' * 49}# two\n    3]\n"
    )  # fmt: skip


def test_a_comment_of_its_own_stands_above_what_follows() -> None:
    assert form("a:\n# below\n    b: 1\n# end\n") == "a:\n  # below\n  b: 1\n# end\n"


def test_a_comment_at_the_end_of_a_list_stays_in_it() -> None:
    assert form("a:\n    - 1\n    # - 2\nb: 3\n") == "a:\n  - 1\n  # - 2\nb: 3\n"


def test_a_comment_before_a_key_is_not_drawn_into_the_list_above() -> None:
    assert form("a:\n- 1\n# of b\nb: 3\n") == "a:\n  - 1\n# of b\nb: 3\n"


def test_comments_keep_their_words_and_tabs() -> None:
    assert form("#no blank\n#\ttab  \na: 1\n") == "#no blank\n#\ttab\na: 1\n"


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("'abc'", "abc"),
        ('"a, b"', "a, b"),
        ("'2000'", '"2000"'),
        ("'2.4.1'", '"2.4.1"'),
        ("'8E1'", '"8E1"'),
        ("'off'", '"off"'),
        ("'No'", '"No"'),
        ("'a: b'", '"a: b"'),
        ("'a #b'", '"a #b"'),
        ("'%'", '"%"'),
        ("' a'", '" a"'),
        ('"say \\"x\\""', 'say "x"'),
        ('"\\"x\\" he said"', "'\"x\" he said'"),
        ('"a\\tb"', '"a\\tb"'),
        ("''", "''"),
        ("off", "off"),
    ],
)
def test_quotes_stand_where_they_are_needed(before: str, after: str) -> None:
    assert form(f"a: {before}\n") == f"a: {after}\n"


def test_in_brackets_a_comma_needs_quotes() -> None:
    assert form("[{a: 'b, c'}, 'd: e', 'f']\n") == '[{a: "b, c"}, "d: e", f]\n'


def test_folded_text_keeps_its_lines() -> None:
    assert form("a:\n    b: >-\n          one\n          two\n            three\n") == (
        "a:\n  b: >-\n    one\n    two\n      three\n"
    )


def test_a_stated_indentation_is_that_of_the_new_text() -> None:
    assert form("a:\n    b: |4\n          one\n        two\n") == "a:\n  b: |2\n      one\n    two\n"


def test_a_text_of_several_lines_is_indented_behind_its_key() -> None:
    assert form('- {a: 1, b: "one\n two", c: three\n four}\n') == '- {a: 1, b: "one\n     two", c: three\n     four}\n'


def test_one_empty_line_stays_of_several() -> None:
    assert form("\n\na: 1\n\n\n\nb: 2\n\n") == "a: 1\n\nb: 2\n"


def test_lines_end_with_a_line_feed_and_without_blanks() -> None:
    assert form("\ufeffa: 1  \r\nb:  \r\n  - 2") == "a: 1\nb:\n  - 2\n"


def test_the_order_of_keys_and_the_kind_of_collections_stay() -> None:
    text = "b: 1\na:\n  - {y: 1, x: 2}\n  - y: 1\n    x: 2\n"
    assert form(text) == text


def test_what_would_say_something_else_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    class Wrong:
        def __init__(self, _: object) -> None: ...
        def text(self) -> str:
            return "a: 2\n"

    monkeypatch.setattr(map_format, "Printer", Wrong)
    with pytest.raises(FormatError, match="would not hold the same values"):
        form("a: 1\n")


def test_a_lost_comment_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    class Forgetful:
        def __init__(self, _: object) -> None: ...
        def text(self) -> str:
            return "a: 1\n"

    monkeypatch.setattr(map_format, "Printer", Forgetful)
    with pytest.raises(FormatError, match="comments"):
        form("a: 1 # x\n")
