"""The picture of a program: valid, the same every time, nothing beside the paper, and true."""

from decimal import Decimal
from xml.etree import ElementTree as ET

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from regscribe.pictures.drawing import Box, DrawnLine, Text
from regscribe.tools.programs import Amount, Final, Program, Segment, setting
from regscribe.tools.programs.picture import RIGHT, drawing, picture
from regscribe.tools.programs.profile import profile

NAMES = {"svg": "http://www.w3.org/2000/svg"}


def overlap(one: Box, other: Box) -> bool:
    """Whether both cover a point; edges that touch do not count."""
    across = one.x < other.x + other.width and other.x < one.x + one.width
    return across and one.y < other.y + other.height and other.y < one.y + one.height


def segment(to: str, ramp: str, soak: str | None = None, **outputs: str) -> Segment:
    return Segment(to=setting(to), ramp=setting(ramp), soak=None if soak is None else setting(soak), outputs=outputs)


ANNEAL = Program(
    name="anneal <&> co",
    cycles="forever",
    segments=(
        segment("200 °C", "1 h", "30 min", event="ON"),
        segment("600 °C", "90 min", "2 h", event="OFF"),
        segment("600 °C", "0 min", "1 h", event="OFF"),
        segment("50 °C", "DISABLED", "2 h", event="ON"),
    ),
)


def test_the_profile_is_what_the_settings_say() -> None:
    legs = profile(ANNEAL).legs

    assert [(leg.segment, leg.kind, leg.start / 60, leg.end / 60, leg.to) for leg in legs] == [
        (1, "ramp", 0, 60, 200),
        (1, "soak", 60, 90, 200),
        (2, "ramp", 90, 180, 600),
        (2, "soak", 180, 300, 600),
        (3, "ramp", 300, 300, 600),
        (3, "soak", 300, 360, 600),
        (4, "ramp", 360, 360, 50),
        (4, "soak", 360, 480, 50),
    ]
    assert [leg.source for leg in legs] == [None, 200, 200, 600, 600, 600, 600, 50]


def test_the_picture_is_valid_and_the_same_every_time() -> None:
    text = picture(ANNEAL)

    assert picture(ANNEAL) == text
    assert ET.fromstring(text.split("\n", 1)[1]).findtext("svg:title", namespaces=NAMES) == "anneal <&> co"  # noqa: S314 - our own text
    assert "@media(prefers-color-scheme:dark)" in text


def test_the_curve_passes_through_the_setpoints_at_their_times() -> None:
    (curve,) = [item for item in drawing(ANNEAL).items if isinstance(item, DrawnLine) and item.style == "curve"]
    points = curve.points
    span, height = RIGHT - 100, points[2][1] - points[0][1]

    assert points[0][0] == pytest.approx(100 + span * 60 / 480)
    assert points[-1][0] == pytest.approx(RIGHT)
    assert (points[-1][1] - points[0][1]) / height == pytest.approx((50 - 200) / (600 - 200))


def test_what_is_not_known_is_dashed() -> None:
    with_final = Program(segments=ANNEAL.segments, final=Final(to=setting("20 °C")))

    def dashed(program: Program) -> int:
        return sum(isinstance(item, DrawnLine) and "dashed" in item.style for item in drawing(program).items)

    assert (dashed(ANNEAL), dashed(with_final)) == (1, 2)


def test_raw_numbers_are_called_so() -> None:
    program = Program(segments=(segment("90 raw", "5 raw"),), time_unit="h", number_of_segments=1)
    words = " ".join(item.text for item in drawing(program).items if isinstance(item, Text))

    assert "does not state the decimals of times and setpoints" in words
    assert "times count in h" in words
    assert "whether it counts the first one is not stated" in words


_amounts = st.builds(Amount, st.decimals(-5000, 5000, places=1), st.sampled_from(["°C", "raw"]))
_times = st.builds(Amount, st.decimals(0, 10**6, places=0), st.sampled_from(["s", "min", "h", "d"]))
_states = st.sampled_from(["A_VERY_LONG_NAME_OF_A_STATE_THAT_FITS_NOWHERE", "ON", "OFF", "OPEN_<&>"])
_segments = st.builds(
    Segment,
    to=_amounts,
    ramp=_times | st.just("DISABLED"),
    soak=st.none() | _times,
    outputs=st.dictionaries(st.sampled_from(["op3", "an_output_of_a_very_long_name", "c"]), _states),
)
_any = st.builds(
    Program,
    name=st.text(max_size=200),
    segments=st.lists(_segments, max_size=16).map(tuple),
    final=st.none() | st.builds(Final, to=_amounts),
    time_unit=st.none() | st.sampled_from(["s", "h"]),
)


@settings(max_examples=60)
@given(_any)
def test_any_program_is_drawn_inside_its_paper_and_texts_do_not_overlap(program: Program) -> None:
    found = drawing(program)
    texts = [item.box for item in found.items if isinstance(item, Text)]
    ET.fromstring(picture(program).split("\n", 1)[1])  # noqa: S314 - our own text

    assert all(box.x >= 0 and box.x + box.width <= found.width and box.y + box.height <= found.height for box in texts)
    for number, box in enumerate(texts):
        assert not any(overlap(box, other) for other in texts[number + 1 :])


def test_a_program_without_time_or_segments_is_drawn() -> None:
    still = Program(segments=(Segment(to=Amount(Decimal(5)), ramp="DISABLED"),))

    assert "no segments" in picture(Program(segments=()))
    assert "one cycle takes 0 s" in picture(still)
