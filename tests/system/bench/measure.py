"""Measuring side by side: the best of several runs, both sides in turn, so that a noisy machine is fair to both."""

import subprocess
import sys
import time
from collections.abc import Callable
from typing import NamedTuple


class Row(NamedTuple):
    """A line of the table: what was measured, ours and theirs, the ratio and the budget."""

    what: str
    ours: str
    theirs: str
    ratio: float
    budget: str
    kept: bool


def best(work: Callable[[], object], runs: int = 5) -> float:
    """Seconds of the fastest run."""
    fastest = float("inf")
    for _ in range(runs):
        start = time.perf_counter()
        work()
        fastest = min(fastest, time.perf_counter() - start)
    return fastest


def paired(ours: Callable[[], object], theirs: Callable[[], object], runs: int = 7) -> tuple[float, float]:
    """The fastest of each, run in turn."""
    pairs = [(best(ours, 1), best(theirs, 1)) for _ in range(runs)]
    return min(one for one, _ in pairs), min(other for _, other in pairs)


def process(code: str, runs: int = 5) -> float:
    """Seconds of a whole Python process that runs `code`."""
    command = [sys.executable, "-c", code]
    return best(lambda: subprocess.run(command, check=True, capture_output=True), runs)  # noqa: S603 (own code)


def milliseconds(seconds: float) -> str:
    """Seconds for the table."""
    return f"{seconds * 1000:.1f} ms" if seconds >= 0.001 else f"{seconds * 1e6:.0f} us"


def at_least(what: str, ours: str, theirs: str, ratio: float, budget: float) -> Row:
    """A row whose ratio must reach the budget."""
    return Row(what, ours, theirs, ratio, f">= {budget:g}", ratio >= budget)


def at_most(what: str, ours: str, theirs: str, ratio: float, budget: float) -> Row:
    """A row whose ratio must stay within the budget."""
    return Row(what, ours, theirs, ratio, f"<= {budget:g}", ratio <= budget)
