"""Changes in words: a sentence each, findings for editors and hosts, a section for a changelog, and the verdict."""

from collections import Counter
from collections.abc import Iterable, Sequence

from regscribe.breaking.change import Change, Effect, Effects, Level, Verdict, verdict_of
from regscribe.emit.markdown.escape import Md, code, md
from regscribe.emit.words import listed
from regscribe.model import Diagnostic, Related, Severity, Span

GONE = "none"
"""What the words of a change have where a version has nothing."""

MOST_NAMES = 3
"""So many subjects are named, others are counted."""

WORDS = {
    Effect.BREAKING: "breaking",
    Effect.BEHAVIOURAL: "behavioural",
    Effect.COMPATIBLE: "compatible",
    Effect.NONE: "text",
}
"""What kind of change an effect makes."""

HEADINGS = {
    Effect.BREAKING: "Breaking",
    Effect.BEHAVIOURAL: "Changed in behaviour",
    Effect.COMPATIBLE: "Compatible",
    Effect.NONE: "Texts and evidence",
}

BELOW_ONE = "below 1.0.0 the minor number plays the part of the major one"


def sentence(change: Change) -> str:
    """What changed: `offset`: address holding 13 -> holding 14."""
    return f"{subjects(change)}: {_what(change)}{_extent(change)}"


def subjects(change: Change) -> str:
    """The subjects: all of a few, the first of many and the number of the others."""
    names = [f"`{name}`" for name in change.subjects]
    few = names if len(names) <= MOST_NAMES + 1 else names[:MOST_NAMES]
    more = len(names) - len(few)
    return listed([*few, f"{more} more"] if more else few, "and")


def _what(change: Change, arrow: str = "->") -> str:
    for side, fate in ((change.after, "is new"), (change.before, "is gone")):
        if GONE in {change.before, change.after} and side != GONE:
            named = "" if side in change.subjects else f" {side}"
            return f"{change.what}{named} {fate}"
    return f"{change.what} {change.before} {arrow} {change.after}"


def _extent(change: Change) -> str:
    """How much one cause affects, where it is more than one register of one model."""
    registers, models = len(change.registers), len(change.models)
    if registers > 1:
        return f" (affects {registers} registers of {models} model{'' if models == 1 else 's'})"
    return f" (on {models} models)" if models > 1 else ""


def told(effects: Effects) -> str:
    """The effects on both sides: `breaking on the wire, behavioural for programs`."""
    if effects.wire is effects.api is not Effect.NONE:
        return f"{WORDS[effects.wire]} on the wire and for programs"
    sides = ((effects.wire, "on the wire"), (effects.api, "for programs"))
    return ", ".join(f"{WORDS[effect]} {side}" for effect, side in sides if effect) or "texts only"


def advice(change: Change) -> str:
    """The effects, and what follows from them."""
    return f"{told(change.effects)}{f'; {change.advice}' if change.advice else ''}"


def diagnostics(changes: Iterable[Change], level: Level) -> list[Diagnostic]:
    """The changes as findings: an error breaks those of the level, all others are warnings."""
    return [
        Diagnostic(
            change.rule.id,
            sentence(change),
            change.place,
            advice(change),
            Severity.ERROR if change.effects.at(level) is Effect.BREAKING else Severity.WARNING,
            _related(change),
        )
        for change in changes
    ]


def _related(change: Change) -> tuple[Related, ...]:
    was = change.was
    return (Related("it stood here", was),) if was and was.file and was != change.place else ()


def plain(change: Change) -> dict[str, object]:
    """A change as plain values for JSON."""
    return {
        "rule": change.rule.id,
        "title": change.rule.title,
        "map": change.map,
        "subjects": list(change.subjects),
        "what": change.what,
        "before": None if change.before == GONE else change.before,
        "after": None if change.after == GONE else change.after,
        "wire": change.effects.wire.name.lower(),
        "api": change.effects.api.name.lower(),
        "verdict": change.effects.verdict().word,
        "message": sentence(change),
        "advice": change.advice,
        "registers": list(change.registers),
        "models": list(change.models),
        "place": _place(change.place),
        "was": _place(change.was) if change.was else None,
    }


def _place(span: Span) -> dict[str, object]:
    return {"file": span.file, "line": span.line, "column": span.column}


def verdict_words(changes: Sequence[Change], level: Level) -> str:
    """The verdict with its reason: `major: 2 breaking changes (RS0701, RS0741)`."""
    verdict = verdict_of(changes, level)
    if verdict is Verdict.NONE:
        return "none: nothing that counts at this level differs"
    worst = [change for change in changes if change.effects.verdict(level) is verdict]
    kinds = Counter(WORDS[change.effects.at(level)] for change in worst)
    counted = listed([f"{number} {kind} change{'' if number == 1 else 's'}" for kind, number in kinds.items()], "and")
    ids = ", ".join(dict.fromkeys(change.rule.id for change in worst))
    note = f"; {BELOW_ONE}" if verdict is Verdict.MAJOR else ""
    return f"{verdict.word}: {counted} ({ids}){note}"


def markdown(changes: Sequence[Change], level: Level) -> str:
    """A section for a changelog: the changes by their effect, each with its rule."""
    verdict = verdict_of(changes, level)
    lines = [f"## {verdict.word.capitalize() if verdict else 'No'} change of the maps", ""]
    for effect, heading in HEADINGS.items():
        own = [change for change in changes if change.effects.at(level) is effect]
        if own:
            lines += [f"### {heading}", "", *map(_item, own), ""]
    return "\n".join(lines).rstrip("\n") + "\n"


def _item(change: Change) -> str:
    names = [code(name) for name in change.subjects]
    few = names if len(names) <= MOST_NAMES + 1 else [*names[:MOST_NAMES], Md(f"{len(names) - MOST_NAMES} more")]
    what = md(change.map, " ", Md(listed(few, "and")), ": ", _what(change, "\N{RIGHTWARDS ARROW}"), _extent(change))
    return f"- {what} ({change.rule.id})"
