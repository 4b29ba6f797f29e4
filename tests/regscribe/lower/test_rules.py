"""Each rule of meaning finds its bad map, at the very place, and lets its good one pass."""

from pathlib import Path

import pytest

import regscribe.lower
from regscribe.lower import RULES, lower
from regscribe.schema import validate
from regscribe.source import Document, load

EXAMPLES = Path(regscribe.lower.__file__).parent / "examples"
IDS = [rule.id for rule in RULES]


def read(name: str) -> Document:
    document, mistakes = load(EXAMPLES / name)
    assert document is not None, mistakes
    assert validate(document) == []
    return document


@pytest.mark.parametrize("rule", IDS)
def test_the_bad_map_breaks_the_rule_at_the_place_that_it_names(rule: str) -> None:
    document = read(f"{rule}.bad.yaml")
    found, mistakes = lower(document)
    first_line = document.text.partition("\n")[0]
    shown = [f"# expect: {each.rule} {each.span.line}:{each.span.column}" for each in mistakes]
    assert shown == [first_line]
    assert found is None
    assert all(each.help for each in mistakes)


@pytest.mark.parametrize("rule", IDS)
def test_the_good_map_passes(rule: str) -> None:
    found, mistakes = lower(read(f"{rule}.good.yaml"))
    assert mistakes == []
    assert found is not None


def test_there_are_no_examples_without_a_rule() -> None:
    expected = {f"{rule}.{kind}.yaml" for rule in IDS for kind in ("bad", "good")}
    assert {path.name for path in EXAMPLES.iterdir()} == expected
