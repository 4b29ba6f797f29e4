"""Pictures for the reference docs as SVG: address spaces, bits of status words, arrays; no clock, no order of sets."""

from regscribe.emit import picture_paths
from regscribe.emit.header import header
from regscribe.emit.markdown.alt_text import fixed
from regscribe.emit.outline import Branch, leaves, outline
from regscribe.model import RegisterMap
from regscribe.pictures.addresses import addresses
from regscribe.pictures.arrays import array
from regscribe.pictures.bits import bits
from regscribe.pictures.drawing import Drawing
from regscribe.pictures.svg import svg

__all__ = ["drawings", "render"]


def render(register_map: RegisterMap) -> dict[str, str]:
    """Return the pictures of a map, at `docs/<maker>/<family>/<name>.svg`."""
    comment = header(register_map)
    found = drawings(register_map)
    return {picture_paths.path(register_map.id, name): svg(drawing, comment) for name, drawing in found.items()}


def drawings(register_map: RegisterMap) -> dict[str, Drawing]:
    """Return the pictures by file name before they become SVG."""
    registers = [register for model in register_map.models for register in model.registers]
    if not registers:
        return {}
    found = {picture_paths.ADDRESSES: addresses(register_map)} if fixed(register_map) else {}
    nodes = outline(register_map.models)
    for leaf in leaves(nodes):
        if any(register.fields for _, register in leaf.register.versions):
            found[picture_paths.bits(leaf.register.key)] = bits(register_map, leaf)
    for node in nodes:
        if isinstance(node, Branch):
            found[picture_paths.array(node.array.first.id)] = array(register_map, node)
    return found
