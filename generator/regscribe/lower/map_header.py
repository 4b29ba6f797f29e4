"""What a map says about itself: the manual, notations, givens, reserved addresses, errata and waivers."""

from regscribe.lower.interval_text import whole_ends
from regscribe.lower.names import unknown
from regscribe.lower.node import Value, elements_of, items_of, text_of, whole_of
from regscribe.lower.presence import Models, present
from regscribe.lower.rules import UNKNOWN_REGISTER
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
        Notation(text_of(node, "name"), _space(node), whole_of(node, "offset"))
        for node in elements_of(root, "notations")
    )


def _space(node: Value) -> Space:
    told = node.child("space")
    return told.choice(Space, Space.HOLDING) if told else Space.HOLDING


def givens_of(root: Value, homes: dict[str, Models]) -> tuple[Given, ...]:
    """Facts from elsewhere that a program must give; RS0301 where one is about an unknown register."""
    return tuple(_given(name, node, homes) for name, node in items_of(root, "givens"))


def _given(name: str, node: Value, homes: dict[str, Models]) -> Given:
    told, register = node.child("type"), node.child("register")
    if register and register.text() not in homes:
        unknown(register, UNKNOWN_REGISTER, "register", register.text(), homes)
    return Given(
        id=name,
        kind=told.choice(GivenKind, GivenKind.CODES) if told else GivenKind.CODES,
        description=text_of(node, "description"),
        reason=text_of(node, "reason"),
        register=register.text() if register else "",
        span=node.key_span,
    )


def reserved_of(root: Value) -> tuple[tuple[Space, int, int], ...]:
    """Stretches of addresses that the manual calls reserved: space, first, last."""
    found = []
    for node in elements_of(root, "reserved"):
        at = node.child("at")
        first, last = whole_ends(at) if at else (0, 0)
        found.append((_space(node), first, last))
    return tuple(found)


def unused_of(root: Value, model: str, every: Models) -> tuple[tuple[Space, int, int], ...]:
    """Stretches of addresses that the manual calls unused on a model: space, first, last."""
    found = []
    for node in elements_of(root, "unused"):
        at = node.child("at")
        if at and model in present(node, every, every):
            found.append((_space(node), *whole_ends(at)))
    return tuple(found)


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
