"""The calculator of the register browser says what all vectors of the shipped maps say, for every model."""

import json

from regscribe.map_files import data_folder
from regscribe.pipeline import compile_map

from .browser_codec import answers, differences, job_of

VECTORS = data_folder("maps").parent / "generated" / "vectors"


def test_the_page_answers_every_vector_of_every_model() -> None:
    files = [json.loads(path.read_text("utf-8")) for path in sorted(VECTORS.rglob("*.json"))]
    maps = [compile_map(data_folder("maps") / f"{one['map']}.yaml").map for one in files]
    sets = [(one["map"], entry) for one in files for entry in one["sets"]]
    made = answers([one for one in maps if one], [job_of(*each) for each in sets])
    wrong = [text for (_, entry), found in zip(sets, made, strict=True) for text in differences(entry, found)]
    assert wrong == []
    assert sum(len(found) for found in made) > 500
    assert sum(len(one[key]) for found in made for each in found for one in each["cases"] for key in KEYS) > 50_000


KEYS = ("decode", "encode")
