"""What a register sets of the line: short form or in full."""

from regscribe.lower.node import Value, items_of, text_of
from regscribe.model import Governs, Setting


def governs_of(node: Value | None) -> Governs | None:
    """The key `governs` of a register; the short form is the setting alone."""
    if node is None:
        return None
    setting = node.child("setting") if node.is_mapping else node
    codes = tuple((code.key_whole(), code.text()) for _, code in items_of(node, "codes"))
    kind = setting.choice(Setting, Setting.ADDRESS) if setting else Setting.ADDRESS
    return Governs(kind, codes, text_of(node, "from"))
