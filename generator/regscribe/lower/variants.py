"""Which models have a thing, and which keys count for a register on one: those of its group, its own, its variants."""

from collections.abc import Iterable

from regscribe.lower.node import Keyed, Value
from regscribe.lower.rules import IDLE_VARIANT, UNKNOWN_MODEL
from regscribe.lower.texts import known_name

Models = tuple[str, ...]

NOT_SETTINGS = frozenset({"variants", "models", "except"})
_LINEAR = frozenset({"multiply", "divide", "exponent", "add"})
_NUMERIC = frozenset(
    {"scale", "decimals", *_LINEAR, "step", "range", "range_decimals", "unit", "special", "difference"}
)
_NO_NUMBERS = {
    "kind": frozenset({"enum", "flags", "fields", "string", "version", "boolean"}),
    "type": frozenset({"string", "bit"}),
}
"""Values of keys that make codes, bits or a text of the register."""
_RIVALS = (
    (
        frozenset({"views"}),
        frozenset({"type", "length", "word_order", "byte_order", "byte", "functions", "write_at", "write"}),
    ),
    (frozenset({"type"}), frozenset({"views"})),
    (frozenset({"scale"}), frozenset({"decimals", *_LINEAR})),
    (frozenset({"decimals"}), frozenset({"scale", *_LINEAR})),
    (_LINEAR, frozenset({"scale", "decimals"})),
)
_CODES = frozenset({"enum", "flags", "fields", "version"})


class Keys(dict[str, Value], Keyed):
    """The keys that count for one register on one model; each value knows where in the map it stands.

    `replaced` are the paths of defaults in whose place the register has something of its own.
    """

    def __init__(self) -> None:
        super().__init__()
        self.replaced: set[tuple[str | int, ...]] = set()

    def child(self, key: str) -> Value | None:
        """The value of a key; None where the key is absent."""
        return self.get(key)

    def lay(self, own: dict[str, Value]) -> None:
        """Lay keys over these.

        A key given as null removes what lies below; so does a key that says the same thing in another way (`decimals`
        over `scale`, bits with a `length` over a `type`), and codes, bits and texts take away the number that the
        group's defaults would make of the word.
        """
        given = {key: node for key, node in own.items() if node.value is not None}
        for keys, rivals in _RIVALS:
            if keys & given.keys():
                self._replace(rivals - own.keys())
        if given.keys() & _CODES or any(key in given and given[key].value in _NO_NUMBERS[key] for key in _NO_NUMBERS):
            for key in self.keys() & (_NUMERIC - own.keys()):
                del self[key]
        if "length" in given and given.keys() & {"flags", "fields"}:
            self._replace({"type"} - own.keys())
        self._replace(own.keys())
        self.update(given)

    def _replace(self, keys: Iterable[str]) -> None:
        """Remove keys for which something else stands."""
        self.replaced |= {self.pop(key).path for key in self.keys() & set(keys)}


def present(node: Value, among: Models, every: Models) -> Models:
    """The models of `among` that a register, array, command, member or field is on; RS0314 for names of no model."""
    only = node.child("models")
    left_out = named_models(node.elements_of("except"), every)
    if only is None and not left_out:
        return among
    listed = named_models(only.elements(), every) if only else among
    return tuple(model for model in among if model in listed and model not in left_out)


def named_models(nodes: list[Value], every: Models) -> Models:
    """The models that a list names; RS0314 for names of no model."""
    names = [known_name(node, UNKNOWN_MODEL, "model", every) for node in nodes]
    return tuple(name for name in names if name in every)


def settings_of(layers: list[Value]) -> Keys:
    """The keys that count where layers lie over each other, the last on top."""
    settings = Keys()
    for layer in layers:
        settings.lay({key: node for key, node in layer.items() if key not in NOT_SETTINGS})
    return settings


def with_variants(layer: Value, model: str, has: Models, every: Models) -> list[Value]:
    """A layer and the variants of it that count on `model`; RS0314 and RS0320 for models that none can be for."""
    chosen = [layer]
    for variant in layer.elements_of("variants"):
        for node in variant.elements_of("models"):
            name = known_name(node, UNKNOWN_MODEL, "model", every)
            if name in every and name not in has:
                message = f"this variant is for {name}, but the register is not on {name}"
                node.report(IDLE_VARIANT, message, remedy=f"the register is on: {', '.join(has) or 'no model'}")
        if model in variant.texts_of("models"):
            chosen.append(variant)
    return chosen
