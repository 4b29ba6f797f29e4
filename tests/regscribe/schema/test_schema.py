"""Plain values to shape errors: each at its place, once, with what to do."""

import json
from collections.abc import Iterator, Mapping
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft202012Validator

from regscribe.model import Diagnostic
from regscribe.schema import schema_json, validate
from regscribe.schema.validate import MAX_ERRORS
from regscribe.source import parse

HEAD = "format: 1\nmap: {id: acme/one, title: One, maker: Acme, class_prefix: Acme}\nmodels: {A: {}, B: {}}\n"
BASICS = "groups: [{id: g, name: G, registers: []}]\n"


def found_in(text: str) -> list[Diagnostic]:
    document, found = parse(text, name="m.yaml")
    assert document is not None, found
    return validate(document)


def in_register(keys: str) -> list[Diagnostic]:
    """What is wrong with a register that has `keys` before `at` and `name`; they start at 6:2."""
    return found_in(f"{HEAD}groups:\n- {{id: g, name: G, registers: [\n{{{keys}, at: 1, name: N}}]}}\n")


def at_top(text: str) -> list[Diagnostic]:
    """What is wrong with a further top-level key; it stands on line 5."""
    return found_in(f"{HEAD}{BASICS}{text}\n")


def places(found: list[Diagnostic]) -> list[str]:
    return [f"{each.rule} {each.span.line}:{each.span.column}" for each in found]


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        ("nmae: x", "RS0201 6:2"),
        ("unit: 5", "RS0203 6:8"),
        ("unit: ~", "RS0203 6:8"),
        ("default: true", "RS0203 6:11"),
        ("range: 5", "RS0203 6:9"),
        ("range: 1-5", "RS0205 6:9"),
        ('range: "0..5\\n"', "RS0205 6:9"),
        ("range: {from: 1}", "RS0202 6:2"),
        ("range: [0..5, 7]", "RS0203 6:16"),
        ("range: [{when: a}]", "RS0202 6:10"),
        ("range: {from: 1, to: -other}", "RS0205 6:23"),
        ("access: ro", "RS0204 6:10"),
        ("enum: Foo", "RS0205 6:8"),
        ("enum: {off: 0}", "RS0205 6:9"),
        ("enum: {0: {id: X}}", "RS0202 6:9"),
        ("models: []", "RS0206 6:10"),
        ("models: [A, A]", "RS0206 6:10"),
        ("models: A", "RS0203 6:10"),
        ("models: [A], except: [B]", "RS0207 6:15"),
        ("fields: {f: {label: x}}", "RS0202 6:11"),
        ("fields: {f: {bit: 1, bits: 0..3}}", "RS0207 6:23"),
        ("flags: {2000: x}", "RS0205 6:10"),
        ("decimals: 19", "RS0204 6:12"),
        ("decimals: 1.5", "RS0203 6:12"),
        ("aliases: [465537]", "RS0204 6:12"),
        ("variants: [{default: 1}]", "RS0202 6:13"),
        ("variants: [{models: [A], id: x}]", "RS0201 6:27"),
        ("word_order: {register: r}", "RS0202 6:2"),
        ("writable: {when: {}, reason: x}", "RS0206 6:19"),
    ],
)
def test_a_mistake_in_a_register_is_found_once_at_its_place(keys: str, expected: str) -> None:
    assert places(in_register(keys)) == [expected]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("modles: {}", "RS0201 5:1"),
        ("protocol: {read_holes: yes}", "RS0203 5:24"),
        ("protocol: {faults: {value: quiet}}", "RS0204 5:28"),
        ("protocol: {faults: {value: 0}}", "RS0204 5:28"),
        ("protocol: {exceptions: {256: {name: a, meaning: b}}}", "RS0205 5:25"),
        ("protocol: {latency: {3: {}}}", "RS0206 5:25"),
        ("protocol: {serial: {formats: [8E1]}}", "RS0203 5:31"),
        ("scales: {s: [{when: a}]}", "RS0202 5:14"),
        ("scales: {s: [{from: 1}]}", "RS0202 5:14"),
        ("scales: {s: [{decimals: 1, add: 2}]}", "RS0207 5:28"),
        ("conditions: {C: {a: 1}}", "RS0205 5:14"),
        ("conditions: {c: {a: 1..b}}", "RS0205 5:21"),
        ("conditions: {c: {a: {in: g, not: 1}}}", "RS0206 5:21"),
        ("givens: {g: {type: codes, description: a, reason: b}}", "RS0202 5:10"),
        ("commands: {c: {name: C, steps: [{}]}}", "RS0202 5:33"),
        ("commands: {c: {name: C, steps: [{wait: 1, at: 2}]}}", "RS0202 5:33"),
        ("units: {u: [{when: a}]}", "RS0202 5:13"),
        ("views: {v: {b: {type: int}}}", "RS0204 5:23"),
        ("views: {v: {b: {type: int16, factor: 0}}}", "RS0204 5:38"),
        ("examples: [{frame: xyz}]", "RS0205 5:20"),
        ("examples: [{register: a}]", "RS0202 5:12"),
        ("errata: [{where: 1.2, printed: a, read: b}]", "RS0202 5:10"),
        ("waivers: [{rule: R1, at: map, reason: a}]", "RS0205 5:18"),
        ("notes: [1]", "RS0203 5:9"),
    ],
)
def test_a_mistake_elsewhere_is_found_at_its_place(text: str, expected: str) -> None:
    assert expected in places(at_top(text))


@pytest.mark.parametrize(
    ("keys", "advice"),
    [
        ("nmae: x", "`name`"),
        ("address: 4", "`at`"),
        ("values: {0: a}", "`enum`"),
        ("acces: r", "`access`"),
        ("emun: {0: a}", "`enum`"),
        ("fc: 4", "`space`"),
    ],
)
def test_an_unknown_key_asks_whether_another_was_meant(keys: str, advice: str) -> None:
    assert f"did you mean {advice}?" in in_register(keys)[0].help


def test_a_key_of_another_place_is_told_where_it_stands() -> None:
    help_text = in_register("gap_characters: 3")[0].help
    assert help_text.startswith("`gap_characters` is a key of: serial line; the keys here are: at, name, ")
    assert in_register("qqq: 3")[0].help.startswith("the keys here are: ")


@pytest.mark.parametrize(
    ("keys", "place", "help_text"),
    [
        ("type: float", "RS0204 6:8", "write `float32`"),
        ("type: FLOAT", "RS0204 6:8", "write `float32`"),
        ("type: double", "RS0204 6:8", "write `float64`"),
        ("type: u16", "RS0204 6:8", "write `uint16`"),
        ("type: uint", "RS0204 6:8", "write `uint16`"),
        ("type: word", "RS0204 6:8", "write `uint16`"),
        ("type: Unsigned 16-bit", "RS0204 6:8", "write `uint16`"),
        ("type: int", "RS0204 6:8", "write `int16`"),
        ("type: S32", "RS0204 6:8", "write `int32`"),
        ("type: dword", "RS0204 6:8", "write `uint32`"),
        ("type: enum16", "RS0204 6:8", "write `enum: {0: ..., 1: ...}`, and as `type` that of the number"),
        ("type: bool", "RS0204 6:8", "write `bit` in coils and discrete inputs"),
        ("type: mac", "RS0204 6:8", "write `eui48`"),
        ("type: timestamp", "RS0204 6:8", "write `datetime` with a `layout`"),
        ("type: uint31", "RS0204 6:8", "did you mean `uint32`?"),
        ("word_order: CDAB", "RS0204 6:14", "write `word_order: little`, and no `byte_order`"),
        ("word_order: swapped", "RS0204 6:14", "write `little`"),
        ("word_order: DCBA", "RS0204 6:14", "write `word_order: little` and `byte_order: little`"),
        ("byte_order: BADC", "RS0204 6:14", "write `byte_order: little`, and no `word_order`"),
        ("scale: 0.1", "RS0203 6:9", "write `multiply: 0.1`"),
        ("scale: 10", "RS0203 6:9", "write `multiply: 10`"),
        (
            "fields: {a: {bits: 0..3, enum: [{when: a, is: b}]}}",
            "RS0203 6:33",
            "write a register for each case, with its own `fields` and",
        ),
        ("access: read-only", "RS0204 6:10", "write `r`"),
        ("range: 5", "RS0203 6:9", "write `0..5`, or `5..5` for one value"),
        ("range: [0, 2..5]", "RS0203 6:10", "write `0..0` for one value"),
        ("space: holding registers", "RS0204 6:9", "write `holding`"),
        ("space: coils", "RS0204 6:9", "write `coil`"),
    ],
)
def test_a_spelling_of_others_is_answered_with_the_word_of_the_language(keys: str, place: str, help_text: str) -> None:
    (found,) = in_register(keys)

    assert places([found]) == [place]
    assert found.help.startswith(help_text)


def _with_spellings(schema: Any) -> Iterator[Mapping[str, Any]]:
    """Every part of a schema that lists spellings of others."""
    for part in schema if isinstance(schema, list) else schema.values() if isinstance(schema, dict) else ():
        if isinstance(part, dict) and "x-instead" in part:
            yield part
        yield from _with_spellings(part)


def test_what_stands_for_a_spelling_of_others_is_a_word_of_the_language() -> None:
    lists = [part for part in _with_spellings(schema_json()) if "enum" in part]

    assert len(lists) >= 4
    for part in lists:
        said = {word for word in part["x-instead"].values() if "`" not in word}
        assert said <= set(part["enum"])
        assert not set(part["x-instead"]) & set(part["enum"])


def test_a_key_that_is_given_already_is_not_the_one_that_was_meant() -> None:
    assert in_register("offset: -40")[0].help == "did you mean `add`?"


def test_an_unknown_word_asks_whether_another_was_meant() -> None:
    assert "`rw`" in in_register("access: RW")[0].help


def test_a_missing_key_is_reported_at_the_key_of_its_mapping() -> None:
    found = found_in(f"format: 1\nmap: {{id: a/b, title: T, maker: M}}\nmodels: {{A: {{}}}}\n{BASICS}")
    assert places(found) == ["RS0202 2:1"]
    assert "`class_prefix`" in found[0].message


def test_all_errors_come_in_one_run_in_the_order_of_the_file() -> None:
    found = in_register("nmae: x, unit: 5, access: ro")
    assert places(found) == ["RS0201 6:2", "RS0203 6:17", "RS0204 6:28"]


def test_the_deepest_nesting_that_is_read_is_also_checked() -> None:
    text = f"{HEAD}{BASICS}conditions: {{a: {{b: {'{not: ' * 60}1{'}' * 60}}}}}\n"
    assert found_in(text) == []


def test_extension_keys_are_allowed_everywhere() -> None:
    text = (
        f"{HEAD}x-a: 1\nprotocol: {{x-b: [1], faults: {{x-c: }}}}\nunits: {{x-d: 1}}\nconditions: {{x-e: 1}}\n{BASICS}"
    )
    assert found_in(text) == []


def test_a_variant_may_remove_a_key_with_null() -> None:
    assert in_register("variants: [{models: [A], unit: null}]") == []


def test_no_message_shows_the_value_as_a_whole() -> None:
    found = in_register(f"unit: [{'abcdefgh, ' * 200}]") + in_register(f"range: {'9' * 90}-1")
    assert all(len(each.message) < 300 for each in found)


def test_errors_without_end_stop_with_a_word_about_it() -> None:
    found = found_in(f"{HEAD}{BASICS}notes: [{'1, ' * 5000}]\n")
    assert len(found) <= MAX_ERRORS + 1
    assert found[-1].rule == "RS0208"


def test_the_schema_is_valid_and_has_no_branches_with_unreadable_errors() -> None:
    Draft202012Validator.check_schema(schema_json())
    assert not {"oneOf", "anyOf"} & set(_keywords(schema_json()))


def test_every_key_has_title_description_and_example() -> None:
    bare = [
        f"{name}.{key}"
        for name, schema in _objects()
        for key, details in schema.get("properties", {}).items()
        if not {"title", "description", "x-examples"} <= set(_effective(details))
    ]
    assert bare == []


def test_every_mapping_is_closed_and_allows_extensions() -> None:
    loose = [
        name
        for name, schema in _objects()
        if schema.get("additionalProperties") is not False or "^x-" not in schema.get("patternProperties", {})
    ]
    assert loose == []


def test_every_example_in_the_schema_satisfies_the_schema() -> None:
    whole = schema_json()
    for name, schema in whole["$defs"].items():
        checker = Draft202012Validator({"$ref": f"#/$defs/{name}", "$defs": whole["$defs"]})
        for example in schema["x-examples"]:
            assert checker.is_valid(example), (name, example)
        for key, details in schema.get("properties", {}).items():
            one = Draft202012Validator({**details, "$defs": whole["$defs"]})
            for example in details.get("x-examples", []):
                assert one.is_valid(example), (name, key, example)


TREES = st.recursive(
    st.none() | st.booleans() | st.integers(-2, 70000) | st.sampled_from(["a", "0..5", "A B", "", "rw", "\n"]),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(
            st.sampled_from(["at", "name", "from", "to", "is", "when", "not", "in", "label", "0", "x-a", "zz"]),
            inner,
            max_size=3,
        )
    ),
    max_leaves=8,
)


@given(
    st.sampled_from(
        [
            "map",
            "manual",
            "models",
            "protocol",
            "conditions",
            "units",
            "enums",
            "views",
            "scales",
            "groups",
            "commands",
            "examples",
        ]
    ),
    TREES,
)
@settings(max_examples=150, deadline=None)
def test_any_value_under_any_key_gives_findings_at_most(key: str, tree: object) -> None:
    document, found = parse(json.dumps({key: tree}), name="m.yaml")
    for each in found if document is None else validate(document):
        assert each.message
        assert each.span.line == 1


def _objects() -> Iterator[tuple[str, Mapping[str, Any]]]:
    """The mappings of the language: the map itself and each definition that has keys."""
    whole = schema_json()
    yield "map file", whole
    yield from (
        (name, schema)
        for name, schema in whole["$defs"].items()
        if "properties" in schema or "patternProperties" in schema
    )


def _effective(details: Mapping[str, Any]) -> Mapping[str, Any]:
    """A key's schema with what its definition adds (a variant's key may be null: then it is the other branch)."""
    details = details["else"] if details.get("if") == {"type": "null"} else details
    if "$ref" not in details:
        return details
    node: Any = schema_json()
    for step in details["$ref"].removeprefix("#/").split("/"):
        node = node[step]
    return {**_effective(node), **details}


def _keywords(node: object) -> Iterator[str]:
    if isinstance(node, dict):
        yield from node
        for value in node.values():
            yield from _keywords(value)
    elif isinstance(node, list):
        for value in node:
            yield from _keywords(value)
