"""The properties of generated tests, on the maps of the cases: what a map may say, its generated tests can draw."""

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from regscribe.emit import python
from regscribe.emit.vectors.test_module import PROPERTIES
from regscribe.testing import DriverUnderTest
from regscribe.testing import properties as hold

from . import judges
from .strategies import FUZZ, STEADY, maps
from .suite import Built, Case, Json, build, cases, diagnose, errors_of, module_of, whole_map

FEW = 4
"""How many examples of each case; the generated tests of a map draw more."""
SOUND = [case for case in cases() if not case.refused and not case.place]


@pytest.mark.parametrize("case", SOUND, ids=repr)
def test_a_case_has_the_properties_of_generated_tests(case: Case) -> None:
    bench = judges.bench_of(build(whole_map(case.map)))

    @settings(STEADY, max_examples=FEW, derandomize=True)
    @given(data=st.data())
    def drawn(data: st.DataObject) -> None:
        _hold_all(bench, data)

    drawn()


@settings(STEADY, max_examples=40, derandomize=True)
@given(parts=maps(), data=st.data())
def test_random_maps_have_the_properties_of_generated_tests(parts: Json, data: st.DataObject) -> None:
    _hold_all(bench_of(parts), data)


@pytest.mark.slow
@settings(STEADY, max_examples=FUZZ)
@given(parts=maps(), data=st.data())
def test_many_random_maps_have_the_properties_of_generated_tests(parts: Json, data: st.DataObject) -> None:
    _hold_all(bench_of(parts), data)


def bench_of(parts: Json) -> DriverUnderTest:
    """The driver of a map that no rule refuses, beside its vectors."""
    register_map, found = diagnose(whole_map(parts))
    assume(register_map is not None and not errors_of(found))
    assert register_map is not None
    ((_, code),) = python.render(register_map).items()
    return judges.bench_of(Built(register_map, module_of(code)))


def _hold_all(bench: DriverUnderTest, data: st.DataObject) -> None:
    for name, (needed, _) in PROPERTIES.items():
        if not needed or getattr(bench, needed):
            getattr(hold, name)(bench, data)
