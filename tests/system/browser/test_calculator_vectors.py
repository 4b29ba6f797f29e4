"""The finished page in Chromium answers every vector of the shipped maps by its own functions."""

import json
from pathlib import Path
from typing import Any

import pytest

from regscribe.map_files import data_folder
from regscribe.pipeline import compile_map
from regscribe.register_browser import page

from ...conformance.browser_codec import ASK, differences, job_of  # noqa: TID252 (test folders are no packages)
from .pages import Opener

VECTORS = data_folder("maps").parent / "generated" / "vectors"
ANSWER = f"""(jobs) => {{
  const data = JSON.parse(document.getElementById("data").textContent)
  return ({ASK})(regscribe, regscribe.open(data), jobs)
}}"""
AT_ONCE = 20
"""Sets of vectors that are handed to the page at once."""


@pytest.mark.browser
@pytest.mark.parametrize("path", sorted(VECTORS.rglob("*.json")), ids=lambda path: path.stem)
def test_the_page_answers_every_vector(path: Path, open_page: Opener, tmp_path: Path) -> None:
    vectors: Any = json.loads(path.read_text("utf-8"))
    register_map = compile_map(data_folder("maps") / f"{vectors['map']}.yaml").map
    assert register_map is not None
    file = tmp_path / "registers.html"
    file.write_text(page([register_map]), encoding="utf-8")
    opened = open_page(file.as_uri())
    wrong: list[str] = []
    for start in range(0, len(vectors["sets"]), AT_ONCE):
        sets = vectors["sets"][start : start + AT_ONCE]
        made = opened.evaluate(ANSWER, [job_of(vectors["map"], each) for each in sets])
        wrong += [text for entry, found in zip(sets, made, strict=True) for text in differences(entry, found)]
    assert wrong == []
