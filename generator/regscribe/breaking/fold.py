"""One change for each cause: the same difference of many registers, models and maps is told once."""

from collections.abc import Hashable, Iterable, Sequence

from regscribe.breaking.change import Change, Difference, Found
from regscribe.breaking.renames import INDEX
from regscribe.breaking.rules import MAP_RENAMED, MODEL_RENAMED, REMOVED, RENAMED
from regscribe.emit.words import span_words
from regscribe.model import Span

FOLLOWING = "unique ids of Home Assistant, metrics and items of exports follow it, so histories end"
"""What follows from another path, wherever values are kept."""

ADVICE = {
    RENAMED: "{old} is {new} in drivers, on the command line and in backups; " + FOLLOWING,
    REMOVED: "drivers and exports lose it, and histories under its name end",
    MODEL_RENAMED: "links, configurations and backups that name {old} must name {new}",
    MAP_RENAMED: "programs import another module; unique ids of Home Assistant begin with the id, so histories end",
}


def folded(found: Iterable[Found]) -> tuple[Change, ...]:
    """The changes that all differences make, sorted by place and rule."""
    buckets: dict[Hashable, list[Found]] = {}
    for one in found:
        buckets.setdefault(_key(one), []).append(one)
    joined: dict[Hashable, list[Found]] = {}
    for bucket in buckets.values():  # what several maps take from one place of a library
        first = bucket[0]
        place = (first.difference, first.site.span) if first.moved is None else (id(bucket),)
        joined.setdefault(place, []).extend(bucket)
    return tuple(sorted(map(_change, joined.values()), key=_order))


def _order(change: Change) -> tuple[object, ...]:
    return change.place, change.rule.id, change.subjects, change.what, change.before, change.after


def _key(one: Found) -> Hashable:
    if one.moved is not None:
        return one.cause
    if one.cause is not None:
        return one.difference, one.cause
    return one.difference, one.site.map, one.site.group or one.site.subject


def _change(together: Sequence[Found]) -> Change:
    first = together[0]
    sites = [one.site for one in together]
    subjects = tuple(dict.fromkeys(INDEX.sub("[]", site.subject) if site.paths else site.subject for site in sites))
    if len(subjects) == len({one.subject for one in sites}) and len(subjects) == 1:
        subjects = (first.site.subject,)
    before, after = _stretches(together) if first.moved else (first.difference.before, first.difference.after)
    place = min((site.span for site in sites), key=_place)
    return Change(
        rule=first.difference.rule,
        place=place,
        subjects=subjects,
        what=first.difference.what,
        before=before,
        after=after,
        effects=first.difference.effects,
        map=first.site.map,
        registers=tuple(dict.fromkeys(path for site in sites for path in site.paths)),
        models=tuple(dict.fromkeys(site.model for site in sites if site.model)),
        was=next((site.was for site in sites if site.span == place and site.was), None),
        advice=_advice(first.difference),
    )


def _place(span: Span) -> tuple[bool, Span]:
    return not span.file, span


def _stretches(together: Sequence[Found]) -> tuple[str, str]:
    """The addresses before and after, of several registers from the first to the last."""
    first = together[0]
    moved = dict.fromkeys(one.moved for one in together if one.moved)
    if len(moved) == 1:
        return first.difference.before, first.difference.after
    ends = []
    for side, text in enumerate((first.difference.before, first.difference.after)):
        low = min(each[side] for each in moved)
        high = max(each[side] + each[2] - 1 for each in moved)
        space = text.partition(" ")[0]
        ends.append(f"{space} {span_words(low, high)}")
    distances = {each[1] - each[0] for each in moved}
    return ends[0], f"{ends[1]} (each {distances.pop():+d})" if len(distances) == 1 else ends[1]


def _advice(difference: Difference) -> str:
    told = ADVICE.get(difference.rule, "")
    return told.format(old=f"`{difference.before}`", new=f"`{difference.after}`")
