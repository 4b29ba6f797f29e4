"""Computed values: what they are called, and how they follow from registers."""

from regscribe.emit.common_values import merge
from regscribe.emit.markdown.context import PageContext, by_model
from regscribe.emit.markdown.escape import Md, code, escape, lines, prose
from regscribe.emit.markdown.page_values import PageTable, table
from regscribe.emit.words import Wording, cases_words, map_cases, one_line, range_words, term_words
from regscribe.model import Computed


def computed(context: PageContext) -> PageTable:
    """Return a row for each computed value of the models."""
    found = merge(context.map.models, lambda model: model.computed, lambda one: one.id)
    rows = (
        (
            lines(*map(prose, filter(None, (shared.first.name, shared.first.description)))),
            code(shared.first.id),
            by_model(shared, lambda model, one: Md(term_words(one.term, context.wording(model)))),
            escape(one_line(shared.first.unit)),
            by_model(shared, lambda model, one: _valid(one, context.wording(model))),
            by_model(shared, lambda model, one: _existence(one, context.wording(model))),
            escape(one_line(shared.first.section)),
            context.covers(shared.models),
        )
        for shared in found
    )
    headers = ("Value", "Name in Python", "Follows from", "Unit", "Valid", "Exists while", "Source", "Models")
    return table(headers, rows)


def _valid(one: Computed, wording: Wording) -> Md:
    return Md(cases_words(map_cases(one.valid, lambda limits: range_words(limits, wording)), wording))


def _existence(one: Computed, wording: Wording) -> Md:
    return Md() if one.when.always else Md(wording.condition(one.when))
