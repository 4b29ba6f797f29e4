"""A page that calculates wrongly is noticed: each change of the codec differs from vectors of some maps."""

import json

import pytest

from regscribe.map_files import data_folder
from regscribe.pipeline import compile_map
from regscribe.register_browser.page import codec

from .browser_codec import answers, differences, job_of
from .suite import Json

MUTANTS = {
    "a factor": ("stated(view.factor)", "plus(stated(view.factor), ONE)"),
    "an order": ('order.words === "big" ? places', 'order.words !== "big" ? places'),
    "half to even in place of up": ('if (rounding !== "half_even") return halfUp(number)', ""),
    "a fraction dropped": ("const halfUp = (one) => floor(plus(one, HALF))", "const halfUp = (one) => floor(one)"),
    "a sign": ("number <= type.maximum ? number : number - (1n << type.bits)", "number"),
    "decimals": ("return power(10n, Math.min(", "return power(10n, 1 + Math.min("),
    "saturation": ('return { meaning: "saturated" }', 'return { meaning: "value", value: number }'),
    "the first code of several": ("order(endOf(low), value) <= 0", "order(endOf(low), value) < 0"),
    "an upper limit": ("compare(value, high) <= 0)", "compare(value, high) < 0)"),
    "the offset of a scale": ("plus(times(slope, number), offset)", "times(slope, number)"),
    "a step": ("if (isWhole(steps)) return number", "return number"),
    "a fault": ("if (fault) return { meaning", "if (false) return { meaning"),
    "a member": ('isMember(register, value, known) ? "value"', 'true ? "value"'),
    "read only": ('if (register.access === "r") throw', "if (false) throw"),
}
"""What is changed in the script of the page, and into what."""
MAPS = ("athena/series-c", "fdc/series-100", "athena/platinum-m5000")


@pytest.fixture(scope="module")
def vectors() -> list[Json]:
    folder = data_folder("maps").parent / "generated" / "vectors"
    return [json.loads((folder / f"{name}.json").read_text("utf-8")) for name in MAPS]


@pytest.mark.slow
@pytest.mark.parametrize("name", MUTANTS)
def test_a_page_that_calculates_wrongly_is_noticed(name: str, vectors: list[Json]) -> None:
    before, after = MUTANTS[name]
    script = codec()
    assert script.count(before) == 1
    compiled = [compile_map(data_folder("maps") / f"{name}.yaml").map for name in MAPS]
    sets = [(one["map"], entry) for one in vectors for entry in one["sets"]]
    made = answers([one for one in compiled if one], [job_of(*each) for each in sets], script.replace(before, after))
    assert any(text for (_, entry), found in zip(sets, made, strict=True) for text in differences(entry, found))
