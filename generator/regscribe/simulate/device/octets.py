"""Texts and other bytes of a device: stored as they stand in the words, one letter of a Python text a byte."""

from regscribe.model import Register, Sentinel
from regscribe.reference import RefusedError
from regscribe.reference.octets import meaning_of, octets_of
from regscribe_runtime.values.octets import PLAIN_TEXT


def meant(register: Register, stored: str, sentinels: tuple[Sentinel, ...]) -> str:
    """Return what the stored bytes say, or the id of the sentinel that they are; bytes of no meaning as they are."""
    size = 2 * register.base.words
    raw = stored.encode("latin-1", "replace")[:size].ljust(size, b"\0")
    fault = next((one.id for one in sentinels if one.reports(int.from_bytes(raw, "big"))), "")
    said = meaning_of(register, raw)
    return fault or (stored.partition("\0")[0].rstrip(" ") if said is None else said)


def stored(register: Register, said: str) -> str:
    """Return the bytes that say a text or are the fault of this id; a text that none say as it is."""
    size = 2 * register.base.words
    fault = next((one.ends for one in register.sentinels if one.id == said), None)
    if fault:
        return int(fault[0]).to_bytes(size, "big").decode("latin-1")
    if register.text == PLAIN_TEXT and register.layout == "" and register.base.type == "string":
        return said
    try:
        return octets_of(register, said, size).decode("latin-1")
    except RefusedError:
        return said
