"""The quick yes to a document: never where jsonschema says no, and nearly always where it says yes."""

import operator
from copy import deepcopy
from decimal import Decimal
from functools import reduce
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft202012Validator

from regscribe import source
from regscribe.emit.editor_schema import editor_schema
from regscribe.schema.quick_check import KEYWORDS, UnknownKeywordError, certainly_valid, compile_schema
from regscribe.schema.schemas import schema_json, validator

in_editors = compile_schema(editor_schema())
ROOT = Path(__file__).parents[3]
KEYS = st.sampled_from(["at", "name", "x-a", "0"])
PLAIN: tuple[Any, ...] = (None, True, False, -1, 0, 1, 2, 3, Decimal(1), Decimal("1.5"), "", "a", "at", "rw\n", [], {})
MAPPINGS: tuple[Any, ...] = ({"at": 1}, {"name": "", "x-a": []}, {"0": 1, "at": "a", "name": 2})
SCALARS = st.sampled_from(PLAIN[:-2])
VALUES = st.recursive(
    SCALARS, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(KEYS, inner, max_size=3), max_leaves=6
)
PATTERNS = st.sampled_from(["^x-", "^a", "a$", "^[a-z]+$", "0"])
SIZES = st.integers(0, 3)
TYPES = st.sampled_from(["object", "array", "string", "integer", "number", "boolean", "null"])


def _keywords(part: st.SearchStrategy[Any]) -> dict[str, st.SearchStrategy[Any]]:
    """What may stand under each keyword."""
    parts = st.lists(part, min_size=1, max_size=2)
    return {
        **dict.fromkeys(["minLength", "maxLength", "minItems", "maxItems", "minProperties", "maxProperties"], SIZES),
        **dict.fromkeys(["minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum"], st.integers(-1, 3)),
        **dict.fromkeys(["items", "additionalProperties", "not", "if", "then", "else"], part),
        **dict.fromkeys(["prefixItems", "allOf", "anyOf"], parts),
        "type": TYPES | st.lists(TYPES, min_size=1, max_size=2, unique=True),
        "enum": st.lists(SCALARS, min_size=1, max_size=3),
        "const": SCALARS,
        "pattern": PATTERNS,
        "uniqueItems": st.sampled_from([False]),  # true means less here than to jsonschema: see `given_twice`
        "required": st.lists(KEYS, max_size=2),
        "dependentRequired": st.dictionaries(KEYS, st.lists(KEYS, max_size=2), max_size=2),
        "properties": st.dictionaries(KEYS, part, max_size=3),
        "patternProperties": st.dictionaries(PATTERNS, part, max_size=2),
        "title": st.just("a schema"),
    }


def _few(part: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    """Schemas of one or two keywords: of many, hardly any value would keep to all."""
    words = _keywords(part)
    chosen = st.lists(st.sampled_from(sorted(words)), min_size=1, max_size=2, unique=True)
    return chosen.flatmap(lambda some: _with_if({word: words[word] for word in some}))


def _with_if(words: dict[str, st.SearchStrategy[Any]]) -> st.SearchStrategy[Any]:
    """`then` and `else` mean nothing alone."""
    lone = words.keys() & {"then", "else"} and "if" not in words
    return st.fixed_dictionaries(words | ({"if": _few(st.booleans())} if lone else {}))


SCHEMAS = st.recursive(st.booleans(), _few, max_leaves=3)


def test_every_keyword_is_tried() -> None:
    assert KEYWORDS.keys() == _keywords(st.none()).keys() - {"title"}


@pytest.mark.parametrize("word", sorted(KEYWORDS))
@given(data=st.data(), drawn=st.lists(VALUES, min_size=1, max_size=3))
@settings(max_examples=50)
def test_a_keyword_means_what_it_means_to_jsonschema(word: str, data: st.DataObject, drawn: list[Any]) -> None:
    schema = data.draw(_with_if({word: _keywords(SCHEMAS)[word]}))
    check, peer, values = compile_schema(schema), Draft202012Validator(_ended(schema)), [*PLAIN, *MAPPINGS, *drawn]
    assert [check(value) for value in values] == [peer.is_valid(value) for value in values]


def _ended(node: Any) -> Any:
    """The schema with a `$` that is the very end of a text, as JSON Schema has it and Python has not."""
    if isinstance(node, dict):
        return {_ended(key): _ended(value) for key, value in node.items()}
    if isinstance(node, list):
        return [_ended(one) for one in node]
    return f"{node[:-1]}\\Z" if node == "^[a-z]+$" else node


@pytest.mark.parametrize("path", sorted(ROOT.glob("maps/**/*.yaml")), ids=lambda path: path.stem)
def test_a_real_map_gets_its_yes_without_jsonschema(path: Path) -> None:
    document, _ = source.load(path)
    assert document is not None
    assert certainly_valid(document.data)


@pytest.mark.parametrize("language", ["map", "backup", "devices", "program", "import"])
def test_a_language_that_people_write_has_known_keywords_only(language: str) -> None:
    assert _unknown(schema_json(language)) == set()


def _unknown(schema: Any) -> set[str]:
    """Words of a schema that the compiler refuses; not the names in `properties` and the like."""
    if isinstance(schema, list):
        return reduce(operator.or_, map(_unknown, schema), set())
    if not isinstance(schema, dict):
        return set()
    named = {"properties", "patternProperties", "$defs"}
    parts = [value for word in named & schema.keys() for value in schema[word].values()]
    parts += [value for word, value in schema.items() if word in {"items", "additionalProperties", "not"}]
    parts += [value for word, value in schema.items() if word in {"allOf", "if", "then", "else"}]
    notes = {"$schema", "$id", "$defs", "$ref", "title", "description", "default"}
    own = {word for word in schema.keys() - notes - KEYWORDS.keys() if not word.startswith("x-")}
    return reduce(operator.or_, map(_unknown, parts), own)


def test_a_keyword_that_is_not_known_is_left_to_jsonschema() -> None:
    check = compile_schema({"properties": {"at": {"multipleOf": 2}, "name": {"type": "string"}}})
    assert check({"name": "a"})
    with pytest.raises(UnknownKeywordError):
        check({"at": 2})


def test_a_schema_within_itself_is_followed_as_deep_as_the_value_is() -> None:
    tree = {"type": "array", "items": {"$ref": "#/$defs/tree"}}
    check = compile_schema({"$ref": "#/$defs/tree", "$defs": {"tree": tree}})
    assert [check([[], [[]]]), check([[], [[1]]])] == [True, False]


@given(st.data())
@settings(max_examples=60)
def test_a_map_with_something_odd_in_it_is_judged_as_jsonschema_does_and_as_in_editors(
    rich_map: Any, data: st.DataObject
) -> None:
    changed = deepcopy(rich_map)
    place = data.draw(st.sampled_from(sorted(_places(changed), key=repr)))
    holder = reduce(operator.getitem, place[:-1], changed)
    holder[place[-1]] = data.draw(st.sampled_from((*PLAIN, 70000, "0..5", [[]], {"at": 1})))
    assert certainly_valid(changed) == validator().is_valid(changed) == in_editors(changed)


def _places(value: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    keys = value if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else ()
    return [place for key in keys for place in [(*path, key), *_places(value[key], (*path, key))]]


@pytest.fixture(scope="module")
def rich_map() -> Any:
    """A map that has most of the language."""
    document, _ = source.load(ROOT / "tests" / "runtime" / "driver" / "oven.yaml")
    assert document is not None
    return document.data
