"""Changes between versions of maps as text for people, and as JSON for programs."""

from collections.abc import Iterator, Sequence
from functools import cache

from regscribe.breaking import report
from regscribe.breaking.change import Change, Effect, Level, verdict_of
from regscribe.breaking.compare import Comparison
from regscribe.cli.shared.diagnostic_text import MARGIN, count, placed, read_lines
from regscribe.cli.shared.output import Piece
from regscribe.visible import json_text, safe

STYLES = {
    Effect.BREAKING: "bold red",
    Effect.BEHAVIOURAL: "bold yellow",
    Effect.COMPATIBLE: "bold green",
    Effect.NONE: "bold",
}


def as_text(found: Comparison, shown: Sequence[Change], level: Level) -> Iterator[Piece]:
    """Yield each change with its place, then the verdict and what was not shown."""
    lines_of = cache(read_lines)
    for change in shown:
        effect = change.effects.at(level)
        yield f"{report.WORDS[effect]}[{change.rule.id}]", STYLES[effect]
        yield f": {safe(report.sentence(change))}\n", "bold"
        yield from placed(change.place, lines_of, STYLES[effect])
        if change.was and change.was.file and change.was.file != change.place.file:
            yield f"  before: {safe(str(change.was))}\n", MARGIN
        yield f"  {safe(report.advice(change))}\n\n", ""
    yield f"verdict {report.verdict_words(found.changes, level)}\n", STYLES[_worst(found, level)]
    hidden = len(found.changes) - len(shown)
    if hidden:
        other = " or ".join(f"--level {one}" for one in (Level.API, Level.DOCS) if one is not level)
        yield f"{count(hidden, 'change')} not shown, which {'does' if hidden == 1 else 'do'} not count at level ", ""
        yield f"{level}: see {other}\n", ""


def _worst(found: Comparison, level: Level) -> Effect:
    return max((change.effects.at(level) for change in found.changes), default=Effect.NONE)


def as_json(found: Comparison, shown: Sequence[Change], level: Level) -> str:
    """Return one JSON object with the verdict and the changes of the level."""
    whole = {
        "format": 1,
        "level": level.value,
        "verdict": verdict_of(found.changes, level).word,
        "verdict_of_all": verdict_of(found.changes).word,
        "hidden": len(found.changes) - len(shown),
        "changes": [report.plain(change) for change in shown],
        "idle_waivers": [{"rule": one.rule, "at": one.at, "place": str(one.span)} for one in found.idle],
    }
    return json_text(whole, indent=2) + "\n"
