"""Frames of worked examples, read by the standard; times by the manual's own arithmetic."""

from collections.abc import Callable

import pytest

from regscribe.checks.worked_frames import FrameFields, parse
from regscribe.model import Diagnostic
from regscribe_runtime.wire.packing import MalformedError


@pytest.mark.parametrize(
    ("text", "answer", "frame"),
    [
        ("01 03 00 40 00 04", False, FrameFields(1, 3, 64, 4)),
        ("01 03 04 43 7A 00 00", True, FrameFields(1, 3, None, 2, *[(0x437A, 0)] * 2)),
        ("01 06 00 48 68 25", False, FrameFields(1, 6, 72, 1, *[(26661,)] * 2)),
        ("01 10 1B 58 00 02 04 00 55 00 5C", False, FrameFields(1, 16, 7000, 2, *[(85, 92)] * 2)),
        ("01 10 1B 58 00 02", True, FrameFields(1, 16, 7000, 2)),
        ("01 05 00 14 FF 00", False, FrameFields(1, 5, 20, 1, (0xFF00,), (1,))),
        ("01 05 00 14 00 00", True, FrameFields(1, 5, 20, 1, (0,), (0,))),
        ("01 0F 00 14 00 0A 02 CD 01", False, FrameFields(1, 15, 20, 10, *[(1, 0, 1, 1, 0, 0, 1, 1, 1, 0)] * 2)),
        ("01 0F 00 14 00 0A", True, FrameFields(1, 15, 20, 10)),
        ("01 83 02", True, FrameFields(1, 3, exception=2)),
        ("01 07", False, FrameFields(1, 7)),
    ],
)
def test_a_frame_says_unit_function_address_count_and_words(text: str, answer: bool, frame: FrameFields) -> None:  # noqa: FBT001 (a column of the table)
    assert parse(bytes.fromhex(text), answer=answer) == frame


@pytest.mark.parametrize(
    "text",
    [
        "01",
        "01 03 00 40 00",
        "01 10 00 00 00 02 04 00 55",
        "01 10 00 00 00 02 02 00 55",
        "01 10",
        "01 10 00 00 00 00 00",
        "01 05 00 14 00 01",
        "01 05 00 14 FF FF",
        "01 0F 00 14 00 0A 01 CD",
        "01 0F 00 14 00 03 02 05 00",
        "01 0F 00 14 00 00 00",
    ],
)
def test_a_frame_that_no_device_takes_is_refused(text: str) -> None:
    with pytest.raises(MalformedError):
        parse(bytes.fromhex(text), answer=False)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("01 03", "0 bytes after the function code, 1 expected"),
        ("01 03 04 43 7A", "3 bytes after the function code, 5 expected"),
        ("01 03 03 43 7A 00", "3 bytes are no whole number of words"),
        ("01 06 00 48 68", "3 bytes after the function code, 4 expected"),
        ("01 05 00 14 12 34", "1234 is no state of a coil: FF00 is on, 0000 is off"),
        ("01 10 1B 58 00", "3 bytes after the function code, 4 expected"),
        ("01 83 02 00", "2 bytes after the function code, 1 expected"),
    ],
)
def test_an_answer_that_no_device_gives_is_refused(text: str, said: str) -> None:
    with pytest.raises(MalformedError, match=said):
        parse(bytes.fromhex(text), answer=True)


@pytest.mark.parametrize(
    ("frame", "said"),
    [
        ("9C 06 0F A9 00 32 C7 66", ""),
        ("9C 06 0F A9 00 32 66 C7", "the frame: its CRC is 66 C7, computed C7 66"),
    ],
)
def test_the_crc_of_a_printed_frame_is_computed(
    frame: str, said: str, diagnose: Callable[[str], list[Diagnostic]], small: Callable[..., str]
) -> None:
    found = diagnose(small("at: 4009, name: Word", tail=f"examples: [{{frame: {frame}}}]\n"))
    assert [one.message for one in found if one.rule == "RS0447"] == ([said] if said else [])


PLACES = (
    "at: 20, name: Coil, space: coil, type: bit",
    "at: 21, name: Next, space: coil, type: bit",
    "at: 20, name: Word",
)


@pytest.mark.parametrize(
    ("frame", "writes", "said"),
    [
        ("01 05 00 14 FF 00", "coil: 1", ""),
        ("01 05 00 14 00 00", "coil: 0", ""),
        ("01 05 00 14 00 00", "coil: 1", "`coil`: 0000 is 0, the manual says 1"),
        ("01 0F 00 14 00 02 01 02", "coil: 0, next: 1", ""),
        ("01 0F 00 14 00 02 01 02", "coil: 1", "`coil`: 0000 is 0, the manual says 1"),
        ("01 06 00 14 00 01", "coil: 1", "`coil`: it stands in space coil, which function 06 does not address"),
        ("01 05 00 14 FF 00", "word: 1", "`word`: it stands in space holding, which function 05 does not address"),
    ],
)
def test_what_a_frame_writes_is_compared(
    frame: str, writes: str, said: str, diagnose: Callable[[str], list[Diagnostic]], small: Callable[..., str]
) -> None:
    top = "protocol: {functions: [1, 3, 5, 6, 15, 16]}"
    tail = f"examples: [{{frame: {frame}, crc: false, writes: {{{writes}}}}}]\n"
    found = diagnose(small(*PLACES, top=top, tail=tail))
    assert [(one.rule, one.message) for one in found] == ([("RS0448", f"the frame: {said}")] if said else [])


@pytest.mark.parametrize(
    ("example", "said"),
    [
        ("register: word, words: [1], value: 2", "the example for `word`: "),
        ("frame: 01 06 00 14, crc: false", "the frame: "),
        (
            "timing: {baud: 9600, format: 8N1, function: 3, words: 2}, gap: 4, earliest: 4, latest: 4",
            "the timing example: ",
        ),
        ("source: '7.1', register: word, words: [1], value: 2", "the example of 7.1 for `word`: "),
    ],
)
def test_an_example_without_a_source_is_told_of_without_a_gap(
    example: str, said: str, diagnose: Callable[[str], list[Diagnostic]], small: Callable[..., str]
) -> None:
    (found,) = diagnose(small("at: 20, name: Word", tail=f"examples: [{{{example}}}]\n"))
    assert found.message.startswith(said)
