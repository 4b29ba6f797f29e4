"""What a map says about itself: the manual, notations, givens, reserved addresses, errata and waivers."""

from regscribe.lower.interval_text import whole_ends
from regscribe.lower.names import unknown
from regscribe.lower.node import Value, choice_of, elements_of, items_of, text_of, whole_of
from regscribe.lower.rules import UNKNOWN_REGISTER
from regscribe.lower.scope import Scope
from regscribe.lower.variants import Models
from regscribe.model import Erratum, Given, GivenKind, Manual, Notation, Space, Waiver


def manual_of(node: Value | None) -> Manual:
    """The document that was transcribed."""
    if node is None:
        return Manual("")
    number, date, publisher = (text_of(node, key) for key in ("number", "date", "publisher"))
    return Manual(text_of(node, "title"), number, date, publisher)


def notations_of(root: Value) -> tuple[Notation, ...]:
    """Other ways to write addresses."""
    return tuple(
        Notation(text_of(node, "name"), choice_of(node, "space", Space.HOLDING), whole_of(node, "offset"))
        for node in elements_of(root, "notations")
    )


def givens_of(root: Value, homes: dict[str, Models]) -> tuple[Given, ...]:
    """Facts from elsewhere that a program must give; RS0301 where one is about an unknown register."""
    return tuple(_given(name, node, homes) for name, node in items_of(root, "givens"))


def _given(name: str, node: Value, homes: dict[str, Models]) -> Given:
    register = node.child("register")
    if register and register.text() not in homes:
        unknown(register, UNKNOWN_REGISTER, "register", register.text(), homes)
    return Given(
        id=name,
        kind=choice_of(node, "type", GivenKind.CODES),
        description=text_of(node, "description"),
        reason=text_of(node, "reason"),
        register=register.text() if register else "",
        span=node.key_span,
    )


def reserved_of(root: Value) -> tuple[tuple[Space, int, int], ...]:
    """Stretches of addresses that the manual calls reserved: space, first, last."""
    return tuple(_stretch(node) for node in elements_of(root, "reserved"))


def unused_of(root: Value, scope: Scope) -> tuple[tuple[Space, int, int], ...]:
    """Stretches of addresses that the manual calls unused on the model of the scope: space, first, last."""
    return tuple(_stretch(node) for node in elements_of(root, "unused") if scope.has(node))


def _stretch(node: Value) -> tuple[Space, int, int]:
    at = node.child("at")
    first, last = whole_ends(at) if at else (0, 0)
    return choice_of(node, "space", Space.HOLDING), first, last


def errata_of(root: Value) -> tuple[Erratum, ...]:
    """Places where the manual is wrong."""
    keys = ("where", "printed", "read", "why")
    return tuple(Erratum(*(text_of(node, key) for key in keys)) for node in elements_of(root, "errata"))


def waivers_of(root: Value) -> tuple[Waiver, ...]:
    """Rules that do not count for one thing, with the reason."""
    return tuple(_waiver(node) for node in elements_of(root, "waivers"))


def _waiver(node: Value) -> Waiver:
    rule, at, reason = (text_of(node, key) for key in ("rule", "at", "reason"))
    return Waiver(rule, at, reason, (node.child("rule") or node).span)
