"""Words for values that are bytes: texts with their form, and dates with their layout."""

from regscribe.model import Kind, Register
from regscribe_runtime.values.octets import BLANK, FF, NUL, PLAIN_TEXT

NAMES = {BLANK: "blanks", NUL: "NUL", FF: "FF"}
KINDS = {
    Kind.BYTES: "raw bytes",
    Kind.IPV4: "IPv4 address",
    Kind.IPV6: "IPv6 address",
    Kind.MAC: "hardware address",
    Kind.DATETIME: "date and time",
    Kind.DATE: "date",
    Kind.TIME: "time",
}


def octets_words(register: Register) -> str:
    """Return what the bytes of a register are: `text of 8 characters`, `date and time, as yM Dh ms`."""
    if register.kind is Kind.STRING:
        return _text(register)
    about = f" ({LETTERS})" if register.layout and not _counts(register.layout) else ""
    return f"{KINDS[register.kind]}{register.layout and f', as {register.layout}'}{about}"


LETTERS = "Y year, y year since 2000, M month, D day, h hour, m minute, s second; a word or a byte each, or digits"


def _counts(layout: str) -> bool:
    return layout.split(" ", maxsplit=1)[0] in {"unix", "unix64", "minutes", "seconds", "iec870"}


def _end(ends: tuple[int, ...]) -> str:
    if ends == PLAIN_TEXT.ends:
        return ""
    return f"up to the first {' or '.join(NAMES[end] for end in ends)}" if ends else "nothing but its length ends it"


def _text(register: Register) -> str:
    form = register.text
    room = register.base.words if form.per_register else 2 * register.base.words // form.size
    parts = [
        f"text of {room} characters",
        form.encoding if form.encoding != PLAIN_TEXT.encoding else "",
        f"one in the {form.per_register} byte of each register" if form.per_register else "",
        f"filled up with {NAMES[form.padding]}" if form.padding != BLANK else "",
        _end(form.ends),
    ]
    return ", ".join(filter(None, parts))
