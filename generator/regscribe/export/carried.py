"""The table of docs/export.md that says which fact each format carries: `python -m regscribe.export.carried` writes it.

It is made of what the exporters declare; a test holds the exporters to that, and the docs to the table.
"""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from regscribe import plugins
from regscribe.export.device.facts import DEVICE_FACTS, FACTS, Carries, Carry

PAGE = Path("docs/export.md")
BEGIN = "<!-- Generated from what the exporters declare by `python -m regscribe.export.carried`. -->"
END = "<!-- End of what is generated. -->"

OURS = "regscribe.export."
"""Where the formats of regscribe itself are; the plug-ins of others have pages of their own."""

SIGNS = {Carry.WHOLE: "yes", Carry.FIXED: "fixed", Carry.PARTLY: "partly", Carry.NO: "no"}


class Declared(NamedTuple):
    """What a format declares: what it carries, and which real program read such an export (empty: none)."""

    carries: Carries
    verified: str


def declared() -> Mapping[str, Declared]:
    """What the formats of regscribe itself declare, by name; those of whole maps first."""
    found = {}
    for name in plugins.names(plugins.EXPORTERS):
        exporter = plugins.exporter(name)
        carries: Carries | None = getattr(exporter, "carries", None)
        if carries is not None and getattr(exporter, "__name__", "").startswith(OURS):
            target = getattr(exporter, "TARGET", None)
            found[name] = Declared(carries, getattr(target or exporter, "verified", ""))
    return dict(sorted(found.items(), key=lambda one: Carry.FIXED in one[1].carries.values()))


def table() -> str:
    """Return the table in Markdown: a row for each fact, a column for each format, below it who read such exports."""
    formats = declared()
    lines = [f"| Fact | {' | '.join(formats)} |", f"|---|{'---|' * len(formats)}"]
    lines += _rows(formats)
    lines += ["", "Which program read such exports in the tests of this project:", ""]
    lines += [f"- `{name}`: {one.verified or 'not verified with the real program'}" for name, one in formats.items()]
    return "\n".join(lines) + "\n"


def _rows(formats: Mapping[str, Declared]) -> Iterator[str]:
    for fact in (*FACTS, *DEVICE_FACTS):
        signs = (SIGNS[one.carries.get(fact.id, Carry.NO)] for one in formats.values())
        yield f"| `{fact.id}`: {fact.title} | {' | '.join(signs)} |"


def with_table(page: str) -> str:
    """Return the page with the table between its marks."""
    before, _, rest = page.partition(BEGIN)
    return f"{before}{BEGIN}\n\n{table()}\n{END}{rest.partition(END)[2]}"


if __name__ == "__main__":
    PAGE.write_text(with_table(PAGE.read_text(encoding="utf-8")), encoding="utf-8", newline="\n")
