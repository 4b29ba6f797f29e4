"""Labels of codes, bits and special values, and the identifiers that are made of them."""

from regscribe.lower.node import Value
from regscribe.lower.texts import identifier
from regscribe.model.identifiers import label_id


def label_of(node: Value) -> str:
    """Label of a code, a bit or a special value; of a code without a label its cells."""
    return (node.text_of("label") or ", ".join(node.texts_of("cells"))) if node.is_mapping else node.text()


def id_of(node: Value) -> str:
    """Id of a code or a special value: given, or made of its label."""
    return node.text_of("id") or label_id(label_of(node))


def identifier_of(node: Value, label: str) -> str:
    """Python name of a code, a bit or a special value with that label; RS0317 where there is none."""
    return identifier(node.child("label") or node, label=label, given=node.child("id"), derive=label_id)
