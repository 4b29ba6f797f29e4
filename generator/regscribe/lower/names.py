"""Identifiers from the manual's names, and help with names that nothing has."""

import keyword
import re
from collections.abc import Iterable
from difflib import get_close_matches

from regscribe.lower.node import Value, brief, text_of
from regscribe.lower.rules import NO_IDENTIFIER, NO_MODULE
from regscribe.model.identifiers import snake, unindexed

_RUN = re.compile(r"[A-Za-z0-9]+")
_LISTED = 12


def letters_and_digits(text: str) -> str:
    """The name without anything but letters and digits, for class names."""
    return "".join(_RUN.findall(text))


def module_id(about: Value) -> str:
    """The id of a map or library, each part of which becomes a part of a module's name; RS0335 where none can."""
    map_id = text_of(about, "id")
    for part in map_id.split("/"):
        if keyword.iskeyword(part):
            message = f"`{part}` is a Python keyword: `import regscribe_devices.{map_id.replace('/', '.')}` cannot be"
            (about.child("id") or about).report(NO_MODULE, message, remedy=f"give another id, for example `{part}-1`")
    return map_id


def identifier(node: Value, *, label: str, given: Value | None, capitals: bool = False) -> str:
    """The identifier `given` in the map, or else the one derived from `label`; RS0317 where that is none."""
    name = given.text() if given else snake(unindexed(label))
    if not name.isidentifier():
        where = given or node
        what = f"`{name}` is no identifier" if given else f"no identifier can be derived from `{brief(label)}`"
        where.report(NO_IDENTIFIER, what, remedy="give an `id` of letters, digits and _ that starts with a letter")
        return "unnamed"
    return name.upper() if capitals else name


def unknown(
    node: Value, rule: str, what: str, name: str, known: Iterable[str], *, of: str = "", at_key: bool = False
) -> None:
    """Report that there is no `what` of this name (in the thing `of`), with the nearest one and those that exist."""
    if node.context.spoke(rule, node.key_span if at_key else node.span):
        return
    names = list(dict.fromkeys(known))
    near = get_close_matches(brief(name), names, n=1, cutoff=0.6)
    place = f" in `{of}`" if of else ""
    guess = f"did you mean `{near[0]}`? " if near else ""
    node.report(rule, f"there is no {what} `{brief(name)}`{place}", remedy=f"{guess}{_listed(names)}", at_key=at_key)


def _listed(names: list[str]) -> str:
    if not names:
        return "there are none"
    more = f" and {len(names) - _LISTED} more" if len(names) > _LISTED else ""
    return f"there are: {', '.join(brief(name) for name in names[:_LISTED])}{more}"
