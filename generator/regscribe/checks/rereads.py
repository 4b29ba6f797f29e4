"""Second readings: registers that read the words of another register again."""

from collections.abc import Iterator

from regscribe.checks.references import depending
from regscribe.checks.rule import Finding, Problem, RuleScope, model_rule, register_rule
from regscribe.model import Access, Register, Related, Span, View

HELD = ("default", "delivered", "default_cases", "delivered_cases", "shadows", "follows", "persistence", "aliases")
"""What only a register with words of its own can have."""


@register_rule("RS0613", "Second reading that cannot be")
def second_reading(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """The words are those of the other register: only that one holds them, takes them and decides by them."""
    other = scope.registers.get(register.rereads)
    if other is None:
        return
    related = Related(f"`{other.path}` stands here", other.span)
    if register.access is not Access.READ:
        yield f"reads `{other.path}` again, but has access {register.access}", "give it `access: r`", related
    for key in HELD:
        if getattr(register, key):
            name = key.removesuffix("_cases")
            yield f"reads `{other.path}` again, and has `{name}`", f"give `{name}` to `{other.path}`", related
    if any(field.follows is not None for field in register.fields):
        yield f"reads `{other.path}` again, and has bits that follow a condition", "remove `follows`", related
    if (why := _elsewhere(register, other)) is not None:
        yield (
            f"reads `{other.path}` again, which {why}",
            "correct `at` or `rereads`; the longer of two holds the words",
            related,
        )
    if register.reading.clears != other.reading.clears:
        yield f"reads `{other.path}` again, and only one of them has `reading: clears`", "give it to both", related
    if register.when != other.when:
        yield f"reads `{other.path}` again, but exists under another condition", "give both the same `when`", related


def _elsewhere(register: Register, other: Register) -> str | None:
    """Why the words are not those of the other."""
    if other.rereads or not other.access.readable:
        return f"reads `{other.rereads}` again itself" if other.rereads else "can only be written"
    if len(register.views) > 1 or len(other.views) > 1:
        return "is transmitted in several views" if len(other.views) > 1 else "has one view, where this has several"
    here, there = (one.base for one in (register, other))
    mine, theirs = (
        {one.address + offset for offset in view.offsets} for one, view in ((register, here), (other, there))
    )
    same = (register.block, here.space, register.page) == (other.block, there.space, other.page)
    if same and mine <= theirs and not (here.is_apart or there.is_apart):
        return None
    return f"has its words at {_spelled(there, theirs)}, where those of this one are at {_spelled(here, mine)}"


def _spelled(view: View, addresses: set[int]) -> str:
    ends = sorted({min(addresses), max(addresses)})
    return f"{view.space} {'..'.join(map(view.space.spelled, ends))}"


@model_rule("RS0614", "Second reading that decides")
def decides(scope: RuleScope) -> Iterator[Finding]:
    """A driver remembers what decides, and forgets it when that register is written, not when its second reading is."""
    for other, who, thing, span in (*depending(scope), *_following(scope)):
        if other.rereads:
            related = Related(f"`{other.path}` reads `{other.rereads}` again", other.span)
            remedy = f"name `{other.rereads}`, or let that one read `{other.path}` again"
            yield Finding(thing, span, f"{who}, a second reading of `{other.rereads}`", remedy, related)


def _following(scope: RuleScope) -> Iterator[tuple[Register, str, str, Span]]:
    """As `depending`, for the registers whose value another one takes."""
    for register in scope.model.registers:
        ways = {case.then: "its value is that of" for case in register.follows}
        ways |= {register.shadows: "its value begins as that of"} if register.shadows else {}
        for other in scope.named(ways):
            why = f"({ways[other.path]} it)"
            yield other, f"`{register.path}` needs `{other.path}` {why}", register.path, register.span
