"""What counts for one register on one model: defaults of the group, own keys, variants, laid over each other."""

from collections.abc import Iterable

from regscribe.lower.names import unknown
from regscribe.lower.node import Path, Value, elements_of, texts_of
from regscribe.lower.presence import Models
from regscribe.lower.rules import IDLE_VARIANT, UNKNOWN_MODEL

NOT_SETTINGS = frozenset({"variants", "models", "except"})
_NUMERIC = frozenset(
    {"scale", "decimals", "multiply", "add", "range", "range_decimals", "unit", "special", "difference"}
)
_NO_NUMBERS = {
    "kind": frozenset({"enum", "flags", "fields", "string", "version", "boolean"}),
    "type": frozenset({"string", "bit"}),
}
"""Values of keys that make codes, bits or a text of the register."""
_RIVALS = (
    (frozenset({"views"}), frozenset({"type", "length", "word_order", "byte_order", "functions"})),
    (frozenset({"type"}), frozenset({"views"})),
    (frozenset({"scale"}), frozenset({"decimals", "multiply", "add"})),
    (frozenset({"decimals"}), frozenset({"scale", "multiply", "add"})),
    (frozenset({"multiply", "add"}), frozenset({"scale", "decimals"})),
)
_CODES = frozenset({"enum", "flags", "fields", "version"})


class Keys(dict[str, Value]):
    """The keys that count for one register on one model; each value knows where in the map it stands.

    `replaced` are the paths of defaults in whose place the register has something of its own.
    """

    def __init__(self) -> None:
        super().__init__()
        self.replaced: set[Path] = set()

    def lay(self, own: dict[str, Value]) -> None:
        """Lay keys over these; one given as null removes what lies below."""
        self.replace(own.keys())
        self.update({key: node for key, node in own.items() if node.value is not None})

    def replace(self, keys: Iterable[str]) -> None:
        """Remove keys for which something else stands."""
        self.replaced |= {self.pop(key).path for key in self.keys() & set(keys)}

    def lose(self, keys: Iterable[str]) -> None:
        """Remove keys that mean nothing beside what is laid over them."""
        for key in keys:
            self.pop(key, None)


def settings_of(layers: list[Value]) -> Keys:
    """Lay the layers over each other, the last on top.

    A key given as null removes what lies below; so does a key that says the same thing in another way (`decimals`
    over `scale`), and codes, bits and texts take away the number that the group's defaults would make of the word.
    """
    settings = Keys()
    for layer in layers:
        own = {key: node for key, node in layer.items() if key not in NOT_SETTINGS}
        given = {key for key, node in own.items() if node.value is not None}
        for keys, rivals in _RIVALS:
            if keys & given:
                settings.replace(rivals - own.keys())
        if given & _CODES or any(key in own and own[key].value in values for key, values in _NO_NUMBERS.items()):
            settings.lose(_NUMERIC - own.keys())
        settings.lay(own)
    return settings


def with_variants(layer: Value, model: str, has: Models, every: Models) -> list[Value]:
    """A layer and the variants of it that count on `model`; RS0314 and RS0320 for models that none can be for."""
    chosen = [layer]
    for variant in elements_of(layer, "variants"):
        for node in elements_of(variant, "models"):
            _check(node, has, every)
        if model in texts_of(variant, "models"):
            chosen.append(variant)
    return chosen


def _check(node: Value, has: Models, every: Models) -> None:
    name = node.text()
    if name not in every:
        unknown(node, UNKNOWN_MODEL, "model", name, every)
    elif name not in has:
        message = f"this variant is for {name}, but the register is not on {name}"
        node.report(IDLE_VARIANT, message, remedy=f"the register is on: {', '.join(has) or 'no model'}")
