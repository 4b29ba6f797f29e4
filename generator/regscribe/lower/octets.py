"""Types that are bytes: how many words they take, the form of texts, and the layout of dates and times."""

from regscribe.lower.node import Keyed, Value
from regscribe.lower.rules import BAD_LAYOUT, IDLE_KEY, IDLE_LENGTH
from regscribe.model import Space, WireType
from regscribe_runtime.values.kinds import MOMENTS
from regscribe_runtime.values.octets import BLANK, FF, KINDS, LENGTHS, NUL, PLAIN_TEXT, TextForm, layout_of, unfit

_FREE = frozenset({WireType.STRING, WireType.BYTES})
_FILLS = {"blank": BLANK, "nul": NUL, "ff": FF}
_ENDS = {"nul": NUL, "ff": FF}
EXAMPLES = "`y M D h m s`, `yM Dh ms`, `hhmm`, `unix`, `minutes`"


def words_of(wire: WireType, keys: Keyed, space: Space) -> int:
    """The words of a type, by the keys of a register; nothing is missing where these are of a view set alone.

    RS0336 for a length that it cannot have or lacks, RS0341 for a layout that says no date or time.
    """
    length, where = keys.child("length"), keys.child("type") or keys.child("views")
    if wire.is_octets and KINDS[wire] in MOMENTS:
        return _laid_out(wire, keys.child("layout"), where)
    if length is None and wire in _FREE and space is not Space.IDENTIFICATION and where:
        where.report(
            IDLE_LENGTH, f"`type: {wire}` needs a `length`", remedy="say how many words it takes, as `length: 8`"
        )
    if length is None or wire in _FREE:
        usual = space.most if space is Space.IDENTIFICATION else wire.words  # an object tells its length itself
        return length.whole() if length and wire.is_octets else usual
    allowed = LENGTHS.get(wire, ())
    if length.whole() in allowed:
        return length.whole()
    if allowed:
        message = f"an {wire} takes {', '.join(map(str, allowed))} words, not {length.whole()}"
        length.report(IDLE_LENGTH, message, remedy=f"write one of {', '.join(map(str, allowed))}, or remove it")
    return wire.words


def bits_of(length: Value) -> WireType:
    """The type of flags or fields in as many words as `length` says; RS0336 for one that no request carries."""
    words, most = length.whole(), Space.HOLDING.most
    if 1 < words <= most:
        return WireType.of_words(words)
    message = f"flags and fields take 2 to {most} words by `length`, not {words}"
    length.report(IDLE_LENGTH, message, remedy="remove `length` where they stand in one word, or correct it")
    return WireType.UINT16


def _laid_out(wire: WireType, layout: Value | None, where: Value | None) -> int:
    if layout is None:
        if where:
            where.report(
                BAD_LAYOUT, f"`type: {wire}` needs a `layout`", remedy=f"say what the words hold, as {EXAMPLES}"
            )
        return 1
    text = " ".join(layout.text().split())
    try:
        words = layout_of(text).words
        why = unfit(KINDS[wire].value, text)
    except ValueError as error:
        words, why = 1, str(error)
    if why:
        message = f"the layout `{text}` is none of a {wire}: {why}"
        layout.report(BAD_LAYOUT, message, remedy=f"write it as {EXAMPLES}")
    return words


def text_of(keys: Keyed) -> TextForm:
    """The form of a text; the short form of `text` is the encoding alone."""
    node = keys.child("text")
    if node is None:
        return PLAIN_TEXT
    if node.is_text:
        return TextForm(node.text())
    ends = [element.text() for element in node.elements_of("ends")]
    form = TextForm(
        node.text_of("encoding", PLAIN_TEXT.encoding),
        node.text_of("one_per_register"),
        _FILLS[node.text_of("padding", "blank")],
        tuple(_ENDS[end] for end in ends if end in _ENDS) if ends else PLAIN_TEXT.ends,
    )
    if form.per_register and form.size > 1:
        message = f"a character of {form.encoding} fills its register"
        node.report(IDLE_KEY, f"`one_per_register` has no effect: {message}", remedy="remove it", at_key=True)
    return form
