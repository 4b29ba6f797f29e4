"""Registers that are read by function 23: the request that reads them writes what selects their page."""

from collections.abc import Iterator
from itertools import pairwise

from regscribe.checks.rule import Problem, RuleScope, register_rule
from regscribe.model import Page, Register, Related, Space

MOST_WRITTEN = 121
"""Words that one request of function 23 writes at most (Modbus Application Protocol V1.1b3, section 6.17)."""


@register_rule("RS0680", "Function 23 that writes nothing before it reads")
def by_function_23(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """Function 23 reads behind a write in one request: here that of the registers that select the page."""
    page = scope.model.pages[register.page - 1] if register.page else Page()
    views = [view for view in register.views if view.is_read_behind_write]
    if views and any(view.space is not Space.HOLDING for view in views):
        yield "is read by function 23, which reads holding registers", "correct `functions` or `space`"
    elif views and not page.steps:
        what = "is read by function 23 and not by 3, and no `page` says what is written before"
        yield what, "give its group a `page`: the registers and values to write; or add 3 to `functions`"
    elif views:
        yield from _unwritable(page, scope)
    elif page.at_once and register.access.readable and register.read_view.space is Space.HOLDING:
        other = next(one for one in scope.model.registers if _is_so_read(one, register.page))
        related = Related(f"`{other.path}` is read by function 23", other.span)
        what = f"is read by function 03 on a page on which `{other.path}` is read by 23"
        yield what, "give both the same `functions`", related


def _is_so_read(register: Register, page: int) -> bool:
    return register.page == page and any(view.is_read_behind_write for view in register.views)


def _unwritable(page: Page, scope: RuleScope) -> Iterator[Problem]:
    """Why one function 23 cannot write all that selects a page."""
    names = " and ".join(f"`{path}`" for path in page.selectors)
    strange = next((step for step in page.steps if step.space is not Space.HOLDING), None)
    gap = next((each for each in pairwise(page.steps) if each[0].address + len(each[0].words) != each[1].address), None)
    count, most = (
        sum(len(step.words) for step in page.steps),
        min(MOST_WRITTEN, scope.register_map.protocol.write_words),
    )
    if strange:
        yield f"is read by function 23, which cannot write {names}: space {strange.space}", "select it by other ones"
    elif gap:
        where = f"at {gap[0].address} and {gap[1].address}"
        what = f"is read by function 23, and {names} stand {where}: one request writes what follows on each other"
        yield what, "list what selects the page in the order of its addresses, or read by function 03"
    elif count > most:
        what = f"is read by function 23, and {names} are {count} words, of {most} that it writes at most"
        yield what, "correct `page` or `limits.write_words`"
