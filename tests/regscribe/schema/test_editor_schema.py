"""The schema of maps for editors: that of the language as it stands, and of the same judgement."""

import json
from pathlib import Path

import pytest

from regscribe import source
from regscribe.checks.catalogue import all_rules, examples
from regscribe.emit.editor_schema import editor_schema
from regscribe.schema.quick_check import certainly_valid, compile_schema

COMMITTED = Path(__file__).parents[3] / "schema" / "map.schema.json"
in_editors = compile_schema(editor_schema())


def test_the_committed_file_is_what_the_language_says() -> None:
    assert json.loads(COMMITTED.read_text(encoding="utf-8")) == editor_schema()


@pytest.mark.parametrize("rule", [rule.id for rule in all_rules()])
def test_the_examples_of_a_rule_are_judged_as_the_language_does(rule: str) -> None:
    for example in filter(None, examples(rule)):
        for name, text in example:
            document, _ = source.parse(text, name=name)
            if document is not None:
                assert in_editors(document.data) == certainly_valid(document.data), name
