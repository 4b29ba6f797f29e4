"""Models of SunSpec in JSON; addresses, sentinels and counts follow from SunSpec's specification, by hand."""

import json
from collections.abc import Callable
from typing import Any

import pytest

from regscribe import plugins
from regscribe.importers.sunspec import likeness
from regscribe.plugins import Likeness, OptionError

from .conftest import Import


def point(name: str, told: str, size: int = 1, **more: Any) -> dict[str, Any]:
    return {"name": name, "type": told, "size": size, **more}


HEADER = [point("ID", "uint16", value=900), point("L", "uint16")]
PLAIN = {
    "id": 900,
    "group": {
        "name": "meter",
        "label": "Meter",
        "type": "group",
        "points": [
            *HEADER,
            point("W", "int16", sf="W_SF", units="W", label="Power", mandatory="M"),
            point("W_SF", "sunssf", static="S"),
            point("WH", "acc32", 2, sf=-2, units="Wh", access="RW"),
            point(
                "St", "enum16", symbols=[{"name": "OFF", "value": 1}, {"name": "ON", "value": 4, "label": "Running"}]
            ),
            point(
                "Evt",
                "bitfield32",
                2,
                symbols=[{"name": "TEMP", "value": 0, "desc": "too hot"}, {"name": "X", "value": 31}],
            ),
            point("Pad", "pad"),
            point("Mn", "string", 2, standards=["a"]),
            point("IP", "ipaddr", 2),
            point("F", "float32", 2, units="Secs"),
            point("Lost", "int16", sf="Nowhere_SF"),
            point("Odd", "uint7"),
            point("Short", "uint32", 1),
            point("Twice", "enum16", symbols=[{"name": "A", "value": 1}, {"name": "B", "value": 1}]),
        ],
    },
}
CURVES = {
    "id": 901,
    "group": {
        "name": "curves",
        "points": [*HEADER, point("NCrv", "uint16"), point("NPt", "count"), point("V_SF", "sunssf")],
        "groups": [
            {
                "name": "Crv",
                "count": "NCrv",
                "points": [point("ActPt", "uint16")],
                "groups": [
                    {
                        "name": "Must",
                        "points": [point("Ena", "uint16")],
                        "groups": [
                            {
                                "name": "Pt",
                                "count": "NPt",
                                "points": [point("V", "uint16", sf="V_SF"), point("T", "uint32", 2)],
                            }
                        ],
                    }
                ],
            }
        ],
    },
}
MODULES = {
    "id": 902,
    "group": {
        "name": "mppt",
        "points": [*HEADER, point("A_SF", "sunssf")],
        "groups": [
            {"name": "fixed", "count": 2, "points": [point("X", "uint16")]},
            {"name": "module", "count": 0, "points": [point("A", "uint16", sf="A_SF")]},
        ],
    },
}


def test_points_stand_one_behind_the_other_in_a_block_of_the_chain(imported: Import) -> None:
    found = imported("sunspec", json.dumps(PLAIN))
    ats = {one.id: one.at for one in found.map.models[0].registers}
    assert ats == {
        "id": 0,
        "l": 1,
        "w": 2,
        "w_sf": 3,
        "wh": 4,
        "st": 6,
        "evt": 7,
        "mn": 10,
        "ip": 12,
        "f": 14,
        "twice": 19,
    }  # a pad at 9; what is left out at 16, 17 and 18 has its room
    assert "chain: sunspec" in found.text
    assert "id: 900" in found.text
    assert found.register("w").block == "m900"


def test_a_scale_is_a_register_or_a_constant(imported: Import) -> None:
    found = imported("sunspec", json.dumps(PLAIN))
    assert "exponent: w_sf" in found.text
    assert "decimals: 2" in found.text
    assert "Nowhere_SF" in found.left_out["Lost"]


@pytest.mark.parametrize(
    ("path", "words", "meant"),
    [
        ("w_sf", (0x8000,), "fault"),
        ("wh", (0, 0), "fault"),
        ("wh", (0, 5), "1/20"),
        ("st", (0xFFFF,), "fault"),
        ("st", (4,), "4"),
        ("evt", (0xFFFF, 0xFFFF), "fault"),
        ("evt", (0x8000, 0x0001), "2147483649"),
        ("ip", (0, 0), "fault"),
        ("ip", (0xC0A8, 0x0001), "192.168.0.1"),
        ("f", (0x7FC0, 0), "fault"),
        ("f", (0x4148, 0), "25/2"),
        ("mn", (0x4142, 0), "AB"),
        ("l", (0xFFFF,), "65535"),
    ],
)
def test_what_is_not_implemented_is_no_value(imported: Import, path: str, words: tuple[int, ...], meant: str) -> None:
    assert str(imported("sunspec", json.dumps(PLAIN)).value(path, *words)) == meant


def test_symbols_are_codes_or_numbers_of_bits(imported: Import) -> None:
    found = imported("sunspec", json.dumps(PLAIN))
    assert found.members("st") == {1: "OFF", 4: "Running"}
    assert found.bits("evt") == {"TEMP": (0, 0), "X": (31, 31)}
    assert found.codes("Twice") == ["symbols-dropped"]


def test_further_facts(imported: Import) -> None:
    found = imported("sunspec", json.dumps(PLAIN))
    power = found.register("w")
    assert (power.name, power.symbol, power.mandatory, power.access) == ("Power", "W", True, "r")
    assert (found.register("wh").mandatory, found.register("wh").access) == (False, "rw")
    assert found.register("w_sf").static
    assert found.register("f").unit[0].then == "s"
    assert {*found.left_out} == {"Lost", "Odd", "Short"}
    assert any("standards (1)" in one for one in found.draft.stated)


def test_groups_are_repeated_as_points_say_and_move_what_is_behind(imported: Import) -> None:
    found = imported("sunspec", json.dumps(CURVES), most="3")
    assert found.left_out == {}
    # an element of Crv: ActPt, Ena, and three points of three words
    assert found.register("crv[1].must_pt[1].v").at == 7
    assert found.register("crv[1].must_pt[3].t").at == 14
    assert found.register("crv[2].actpt").at == 16
    assert found.register("crv[3].must_ena").at == 28
    assert "packed: true" in found.text
    assert "exponent: v_sf" in found.text


def test_a_count_of_zero_is_the_rest_of_the_block(imported: Import) -> None:
    found = imported("sunspec", json.dumps(MODULES), most="4")
    assert [found.register(f"fixed[{i}].x").at for i in (1, 2)] == [3, 4]
    assert [found.register(f"module[{i}].a").at for i in (1, 4)] == [5, 8]
    assert "block: end" in found.text


@pytest.mark.parametrize("most", ["0", "x", "10000"])
def test_a_number_of_elements_must_be_one(most: str) -> None:
    with pytest.raises(OptionError, match="--most"):
        plugins.read("sunspec", json.dumps(PLAIN).encode(), "x", {"most": most})


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{}", "there is no `group`"),
        ('{"id": 70000, "group": {}}', "there is no `group`"),
        ('{"id": 1, "group": ' + "[" * 60 + "]" * 60 + "}", "nested more than 40 deep"),
        ('{"id": 1,', "no JSON"),
    ],
)
def test_what_is_no_model_is_one_message(refusal: Callable[..., str], text: str, said: str) -> None:
    assert said in refusal("sunspec", text)


def test_it_is_recognised() -> None:
    assert likeness(json.dumps(PLAIN).encode(), "model_900.json") is Likeness.SURE
    assert likeness(b'{"group": 1}', "x.json") is Likeness.NO
