"""What an export lost: as lines for people, as JSON, and as SARIF for hosts that show such results."""

from collections import Counter
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict
from typing import TypeVar

from regscribe.cli.shared.diagnostic_text import count
from regscribe.cli.shared.report_formats import as_sarif
from regscribe.losses import Exported, Grade, Loss, worst_first
from regscribe.model import Diagnostic, RegisterMap, Severity, Span
from regscribe.model.diagnostic import NOWHERE
from regscribe.visible import json_text, safe

K = TypeVar("K", bound=Hashable)

FORMS = ("text", "json", "sarif")

MOST_NAMED = 6
"""Registers of one loss that are named in a text; JSON has them all."""


def report_of(made: Exported, maps: Sequence[RegisterMap], *, form: str, report: str, refused: bool) -> str:
    """Return the report on an export of maps to `form`; empty where a text would say nothing."""
    losses = worst_first(made.losses)
    if report == "sarif":
        places = _places(maps)
        return as_sarif([_diagnostic(loss, form, places) for loss in losses], {})
    if report == "json":
        plain = [{**asdict(loss), "grade": loss.grade.name.lower()} for loss in losses]
        return json_text({"format": 1, "export": form, "remarks": made.remarks, "losses": plain}, indent=2) + "\n"
    return "".join(f"{safe(line)}\n" for line in _lines(made, losses, form, refused=refused))


def _lines(made: Exported, losses: tuple[Loss, ...], form: str, *, refused: bool) -> Iterator[str]:
    yield from made.remarks
    if losses:
        tally = Counter(loss.grade for loss in losses)
        many = ", ".join(f"{tally[grade]} {grade.words}" for grade in Grade if tally[grade])
        yield f"{'nothing was exported: ' * refused}{form} cannot say everything: {many}"
    for grade, some in _by(losses, lambda loss: loss.grade):
        if grade is Grade.COSMETIC:
            yield f"  {grade.words}: {', '.join(fact for fact, _ in _by(some, lambda loss: loss.fact))}"
            continue
        for fact, alike in _by(some, lambda loss: loss.fact):
            yield f"  {grade.words}: {fact}: {_done(alike)}{_registers(alike)}"
    if losses:
        yield "each register and each loss: --report json"


def _done(losses: Sequence[Loss]) -> str:
    """What was done; of several things the first, as an example."""
    every = list(dict.fromkeys(loss.done for loss in losses))
    return every[0] if len(every) == 1 else f"for example {every[0]}"


def _registers(losses: Sequence[Loss]) -> str:
    paths = list(dict.fromkeys(loss.register for loss in losses if loss.register))
    if not paths:
        return ""
    more = f" and {len(paths) - MOST_NAMED} more" if len(paths) > MOST_NAMED else ""
    return f" ({count(len(paths), 'register')}: {', '.join(paths[:MOST_NAMED])}{more})"


def _by(losses: Iterable[Loss], key: Callable[[Loss], K]) -> Iterator[tuple[K, list[Loss]]]:
    """Losses by what the key says, in the order in which that first comes."""
    found: dict[K, list[Loss]] = {}
    for loss in losses:
        found.setdefault(key(loss), []).append(loss)
    yield from found.items()


def _places(maps: Iterable[RegisterMap]) -> dict[tuple[str, str], Span]:
    """Where the registers of each model stand, and the model itself (with an empty path)."""
    models = [(one, model) for one in maps for model in one.models]
    known = {(model.name, ""): one.span for one, model in models}
    return known | {(model.name, register.path): register.span for _, model in models for register in model.registers}


def _diagnostic(loss: Loss, form: str, places: Mapping[tuple[str, str], Span]) -> Diagnostic:
    severity = Severity.ERROR if loss.grade is Grade.WRONG else Severity.WARNING
    place = places.get((loss.model, loss.register)) or places.get((loss.model, ""), NOWHERE)
    what = f"{loss.register}: {loss.done}" if loss.register else loss.done
    return Diagnostic(f"{form}/{loss.fact}", what, place, severity=severity)
