"""Pages: what a device shows at the same addresses must never be there together."""

from collections.abc import Iterator
from itertools import combinations
from typing import NamedTuple

from regscribe.checks.addresses import stretches
from regscribe.checks.rule import Finding, RuleScope, model_rule
from regscribe.model import Page, Register, Related, Space


class Place(NamedTuple):
    """An address as it stands in a request, and what it counts in."""

    block: str
    space: Space
    address: int


@model_rule("RS0689", "Pages that do not exclude each other")
def shown_together(scope: RuleScope) -> Iterator[Finding]:
    """Only a register that both select, with a value of its own for each, tells which of two pages the device shows."""
    pages = (Page(), *scope.model.pages)
    numbers = {register.page for register in scope.model.registers}
    for one, other in combinations(sorted(numbers), 2):
        if _shown_together(pages[one], pages[other]):
            yield from _met(scope, pages, one, other)


def _shown_together(one: Page, other: Page) -> bool:
    """Whether two pages of one unit id may be selected at once."""
    words = {path: step.words for path, step in zip(one.selectors, one.steps, strict=True)}
    theirs = {path: step.words for path, step in zip(other.selectors, other.steps, strict=True)}
    return one.unit == other.unit and all(words[path] == theirs[path] for path in words.keys() & theirs.keys())


def _met(scope: RuleScope, pages: tuple[Page, ...], one: int, other: int) -> Iterator[Finding]:
    """The first registers of two pages at one address, to read or to write."""
    for reading in (True, False):
        taken = {place: register for register, place in _places(scope, one, reading=reading)}
        second = next(((each, place) for each, place in _places(scope, other, reading=reading) if place in taken), None)
        if second:
            earlier, later = sorted((taken[second[1]], second[0]), key=lambda each: each.span)
            mine, theirs = (_selected(pages[register.page]) for register in (later, earlier))
            where = f"{second[1].space} {second[1].address}"
            message = f"takes {where} {mine}, and `{earlier.path}` {theirs}: a device may show both at once"
            remedy = "let `page` of both groups name one register, with a value of its own for each, or correct `at`"
            yield Finding.at(later, message, remedy, Related(f"`{earlier.path}` stands there too", earlier.span))
            return


def _places(scope: RuleScope, page: int, *, reading: bool) -> Iterator[tuple[Register, Place]]:
    """Each address that a register of a page takes, as it stands in a request."""
    for register in scope.model.registers:
        for stretch in stretches(register) if register.page == page else ():
            inside = map(stretch.space.inside, range(stretch.first, stretch.last + 1))
            if stretch.serves(reading=reading):
                yield from ((register, Place(register.block, stretch.space, address)) for address in inside)


def _selected(page: Page) -> str:
    values = " and ".join(f"`{path}`" for path in page.selectors)
    return f"on a page of {values}" if values else "on no page"
