"""Every fact of a register is known to the losses of exports, so that none is dropped without a word."""

from dataclasses import fields

from regscribe.export.device.facts import BY_ID, FACTS, KINDS, NEUTRAL
from regscribe.model import Register


def test_every_field_of_a_register_is_a_fact_or_says_why_not() -> None:
    told = {field for fact in FACTS for field in fact.fields}
    assert told | NEUTRAL == {field.name for field in fields(Register)}
    assert not told & NEUTRAL


def test_facts_that_belong_to_others_name_one_that_there_is() -> None:
    assert {fact.of for fact in FACTS} - {""} <= BY_ID.keys()
    assert set(KINDS.values()) <= BY_ID.keys()
