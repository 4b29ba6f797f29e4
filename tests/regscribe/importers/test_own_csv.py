"""A table in the columns of the export: what it says outright is taken, what it says in words is told."""

from decimal import Decimal
from typing import Any

import pytest

from regscribe.draft import Draft, Outcome
from regscribe.importers.own_csv import likeness, read
from regscribe.plugins import Likeness

FLAGS = b'address,name,access,kind,type,bits\n1,Alarms,r,%s,%s,"{""0"": ""first""}"\n'


def keys_of(draft: Draft) -> list[Any]:
    return [entry.keys and dict(entry.keys) for entry in draft.entries]


def one(column: str, cell: str, **more: str) -> Draft:
    columns = {"address": "1", "name": "Level", "access": "r", column: cell, **more}
    cells = ['"' + text.replace('"', '""') + '"' for text in columns.values()]
    return read(f"{','.join(columns)}\n{','.join(cells)}\n".encode(), "table.csv", {})


def test_rows_that_differ_in_their_model_alone_are_one_register_of_these_models() -> None:
    draft = read(b"address,name,access,model\n1,Gain,rw,A\n1,Gain,rw,B\n2,Bias,rw,B\n", "table.csv", {})
    assert draft.findings == ()
    assert keys_of(draft) == [
        {"at": 1, "name": "Gain", "access": "rw"},
        {"at": 2, "name": "Bias", "access": "rw", "models": ["B"]},
    ]


def test_a_register_without_a_group_is_one_of_the_group_that_is_named_for_it() -> None:
    draft = read(b"address,name,access,model,group\n1,Gain,rw,A,\n1,Gain,rw,B,Registers\n", "table.csv", {})
    assert keys_of(draft) == [{"at": 1, "name": "Gain", "access": "rw"}]


def test_flags_of_many_words_have_a_length() -> None:
    draft = read(FLAGS % (b"flags", b"uint80"), "table.csv", {})
    assert keys_of(draft) == [{"at": 1, "name": "Alarms", "access": "r", "length": 5, "flags": {0: "first"}}]


@pytest.mark.parametrize(("kind", "wire"), [(b"flags", b"uint81"), (b"integer", b"uint80")])
def test_a_number_of_a_type_that_is_none_is_left_out(kind: bytes, wire: bytes) -> None:
    (entry,) = read(FLAGS % (kind, wire), "table.csv", {}).entries
    assert entry.outcome is Outcome.LEFT_OUT
    assert wire.decode() in entry.remarks[0].message


@pytest.mark.parametrize(
    ("scale", "keys"),
    [
        ("x/10", {"decimals": 1}),
        ("0.1*x - 40", {"multiply": Decimal("0.1"), "add": -40}),
        ("x/1000 + 0.05", {"multiply": Decimal("0.001"), "add": Decimal("0.05")}),
        ("1/3*x", {"multiply": "1/3"}),
        ("-2*x", {"multiply": -2}),
        ("x + 7", {"add": 7}),
        ("not stated", {"decimals": "not_stated"}),
    ],
)
def test_a_scale_of_numbers_alone_is_taken_exactly(scale: str, keys: dict[str, Any]) -> None:
    assert keys_of(one("scale", scale)) == [{"at": 1, "name": "Level", "access": "r", **keys}]


@pytest.mark.parametrize("scale", ["x/10^dp", "x*10^sf", "x/0", "linear: x/10; otherwise: x", "x/10, x in steps of 5"])
def test_a_scale_in_words_leaves_a_raw_number_without_limits_in_its_unit(scale: str) -> None:
    (entry,) = one("scale", scale, minimum="-5", maximum="40.5", default="20.5", unit="°C").entries
    assert entry.keys == {"at": 1, "name": "Level", "access": "r", "unit": "°C", "decimals": "not_stated"}
    (remark,) = entry.remarks
    assert (remark.code, remark.todo) == ("scale-in-words", True)
    assert f"`{scale}`; the number is raw" in remark.message


@pytest.mark.parametrize(
    ("column", "cell"),
    [
        ("type", "bcd"),
        ("space", "memory"),
        ("access", "sometimes"),
        ("block", "common"),
        ("page", "bank=5"),
        ("exists", "mode is auto"),
        ("kind", "fields"),
        ("more", '{"word_order": "big while swap is 0, otherwise little"}'),
        ("more", '{"byte_order": "little while swap is 0"}'),
    ],
)
def test_a_number_that_hangs_on_what_is_in_words_is_left_out(column: str, cell: str) -> None:
    (entry,) = one(column, cell).entries
    assert entry.outcome is Outcome.LEFT_OUT
    assert entry.remarks[0].code == "place-unclear"


def test_a_factor_that_only_views_say_leaves_a_raw_number() -> None:
    (entry,) = one("more", '{"transmitted": "stored value times 10, rounded half up"}').entries
    assert entry.keys == {"at": 1, "name": "Level", "access": "r", "decimals": "not_stated"}


def test_a_register_that_is_written_elsewhere_is_read_only() -> None:
    (entry,) = one("more", '{"write": "at holding 7 as int16"}', access="rw").entries
    assert entry.keys == {"at": 1, "name": "Level", "access": "r"}
    assert entry.outcome is Outcome.WITH_LOSS


@pytest.mark.parametrize("kind", ["command", "computed"])
def test_commands_and_computed_values_are_left_out_by_name(kind: str) -> None:
    (entry,) = one("kind", kind).entries
    assert (entry.outcome, entry.remarks[0].code) == (Outcome.LEFT_OUT, kind)


def test_numbers_stay_exact() -> None:
    (entry,) = one(
        "default", "0.1", more='{"delivered": "0.30000000000000004", "sentinels": {"-9999.9": "broken"}}'
    ).entries
    assert entry.keys is not None
    assert entry.keys["default"] == Decimal("0.1")
    assert entry.keys["delivered"] == Decimal("0.30000000000000004")
    assert entry.keys["sentinels"] == {Decimal("-9999.9"): "broken"}


def test_an_address_that_is_none_leaves_its_row_out_and_no_other() -> None:
    draft = read(b"address,name,access\nx,Level,r\n2,Gain,r\n", "table.csv", {})
    assert [entry.outcome for entry in draft.entries] == [Outcome.LEFT_OUT, Outcome.WHOLE]


def test_the_export_is_recognised_and_another_table_is_not() -> None:
    assert likeness(b"map,model,id,name,address,access,kind,views\n", "x.csv") is Likeness.SURE
    assert likeness(b"address,name,access\n", "x.csv") is Likeness.NO
