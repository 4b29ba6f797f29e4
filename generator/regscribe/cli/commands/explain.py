"""`regscribe explain`: a rule with a bad and a good example, or the list of all rules."""

from collections.abc import Iterator
from difflib import SequenceMatcher

import click

from regscribe import breaking
from regscribe.breaking.examples import EDITS, shown
from regscribe.breaking.report import told
from regscribe.checks import catalogue
from regscribe.checks.catalogue import Example
from regscribe.cli.shared.completion_values import complete_rule
from regscribe.cli.shared.diagnostic_text import STYLES
from regscribe.cli.shared.output import Piece, print_json, refuse, show, show_table
from regscribe.model import Rule
from regscribe.model.nearest import nearest

TITLES = {
    "source": "the text of a map",
    "schema": "keys and the shapes of values",
    "lower": "names and what they refer to",
    "checks": "what registers say of the device",
    "compose": "maps of several files",
    "breaking": "changes between two versions",
}
"""What the rules of each room are about."""


@click.command(epilog="Example: regscribe explain RS0109\n\nExit code 0: done, 2: wrong usage.")
@click.argument("rule_id", metavar="[RULE]", required=False, shell_complete=complete_rule)
@click.option("--format", "form", type=click.Choice(["text", "json"]), default="text", show_default=True)
def command(*, rule_id: str | None, form: str) -> None:
    """Explain a rule: what it asks, why, and a bad and a good example; of a kind of change, an edit that makes it.

    RULE is the id that a finding shows. Lines in which the examples differ are marked with - and +. Without RULE all
    rules are listed by what they are about; --format json leaves examples out.
    """
    rules = {rule.id: rule for rule in catalogue.all_rules()}
    chosen = list(rules.values()) if rule_id is None else [_named(rule_id, rules)]
    if form == "json":
        print_json(rules=[_plain(rule) for rule in chosen])
    elif rule_id is None:
        _show_all()
    else:
        show(_explanation(*chosen))


def _named(rule_id: str, rules: dict[str, Rule]) -> Rule:
    """The rule of this id. Raises click.UsageError."""
    if rule_id.upper() not in rules:
        refuse(f"there is no rule `{rule_id}`{_meant(rule_id, rules)}")
    return rules[rule_id.upper()]


def _plain(rule: Rule) -> dict[str, str]:
    return {
        "rule": rule.id,
        "severity": rule.severity.value,
        "about": TITLES[catalogue.room_of(rule.id)],
        "title": rule.title,
        "why": rule.why,
    }


def _show_all() -> None:
    for name, room in catalogue.ROOMS.items():
        rows = [(rule.id, rule.severity.value, rule.title) for rule in sorted(room.RULES, key=lambda rule: rule.id)]
        show_table(("RULE", "SEVERITY", "TITLE"), rows, title=TITLES[name])


def _meant(rule_id: str, rules: dict[str, Rule]) -> str:
    near = nearest(rule_id.upper(), rules)
    if near:
        return f"; did you mean `{near}` ({rules[near].title})?"
    return f": rules have ids from {min(rules)} to {max(rules)}, and `regscribe explain` lists them"


def _explanation(rule: Rule) -> Iterator[Piece]:
    if rule in breaking.RULES:
        yield from _change(rule)
        return
    bad, good = catalogue.examples(rule.id)
    yield f"{rule.severity.value}[{rule.id}]", STYLES[rule.severity]
    yield f": {rule.title}\n", "bold"
    yield f"\n{rule.why}\n" if rule.why else "", ""  # -OO drops the docstrings that hold the reasons
    yield from _example("Bad", bad, other=good, mark="-", style="red")
    yield from _example("Good", good, other=bad, mark="+", style="green")
    if bad is None and good is None:
        yield "\nNo example: the rule is about the file, not about what stands in it.\n", ""


def _change(rule: Rule) -> Iterator[Piece]:
    """A kind of change: its reason, and an edit of a map that makes it."""
    yield f"change[{rule.id}]", STYLES[rule.severity]
    yield f": {rule.title}\n", "bold"
    yield f"\n{rule.why}\n", ""
    if rule not in EDITS:
        yield "\nNo example: a whole map came or went.\n", ""
        return
    yield "\nExample, in a map:\n", "bold"
    colours = {"-": "red", "+": "green", "@": "cyan"}
    yield from ((f"{line}\n", colours.get(line[:1], "")) for line in shown(rule).splitlines())
    yield f"\n{told(EDITS[rule].effects)}\n", ""


def _example(title: str, files: Example | None, *, other: Example | None, mark: str, style: str) -> Iterator[Piece]:
    """Show the files of one example; lines that the other one has, too, are plain."""
    files, others = files or (), dict(other or ())
    for name, text in files:
        yield f"\n{title}{f', maps/{name}' if len(files) > 1 else ''}:\n", "bold"
        lines = text.splitlines()
        matcher = SequenceMatcher(None, lines, others.get(name, "").splitlines(), autojunk=False)
        same = {block.a + offset for block in matcher.get_matching_blocks() for offset in range(block.size)}
        for number, line in enumerate(lines):
            head, colour = (" ", "") if other is None or number in same else (mark, style)
            yield f"{head} {line}\n", colour
