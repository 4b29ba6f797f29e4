"""The generated pytest module: names and paths only; what is tested stands in `regscribe.testing`."""

from regscribe.emit.header import header
from regscribe.emit.python.literals import literal
from regscribe.model import RegisterMap

BODY = '''"""The driver against its vectors, and properties that hold for every value."""

{header}

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe.testing import DriverUnderTest, load
from regscribe.testing import properties as hold
from regscribe_devices.{maker} import {module} as module

VECTORS = load(Path(__file__).parents[2] / "vectors" / {maker_text} / {file_text})
CLASSES = {classes}
DRIVERS = [DriverUnderTest(cls, VECTORS) for cls in CLASSES]


def models(drivers: list[DriverUnderTest]) -> pytest.MarkDecorator:
    return pytest.mark.parametrize("driver", drivers, ids=[one.model for one in drivers])


every_model = models(DRIVERS)


@every_model
def test_the_driver_has_the_registers_of_its_model_at_their_addresses(driver: DriverUnderTest) -> None:
    driver.check_registers()


@every_model
def test_requests_keep_to_the_limits_of_the_device_and_commands_send_what_the_map_says(driver: DriverUnderTest) -> None:
    driver.check_device()


@every_model
def test_words_decode_to_the_values_of_the_vectors(driver: DriverUnderTest) -> None:
    driver.check_decoding()


@every_model
def test_values_encode_to_the_words_of_the_vectors(driver: DriverUnderTest) -> None:
    driver.check_encoding()


@every_model
def test_values_that_no_words_can_carry_are_refused(driver: DriverUnderTest) -> None:
    driver.check_refusals()


@every_model
def test_writes_are_allowed_exactly_under_their_conditions(driver: DriverUnderTest) -> None:
    driver.check_conditions_of_writing()


@every_model
def test_the_worked_examples_of_the_manual_hold(driver: DriverUnderTest) -> None:
    driver.check_examples()


@every_model
@hold.each_run
@given(data=st.data())
def test_any_words_give_a_value_or_a_documented_error(driver: DriverUnderTest, data: st.DataObject) -> None:
    hold.total_decoding(driver, data)
'''


READ = """

@models([driver for driver in DRIVERS if driver.readable])
@hold.each_run
@given(data=st.data())
def test_a_read_covers_each_register_once_and_crosses_no_hole_and_no_limit(
    driver: DriverUnderTest, data: st.DataObject
) -> None:
    hold.covering_reads(driver, data)


@models([driver for driver in DRIVERS if driver.readable])
@hold.each_run
@given(data=st.data())
def test_registers_read_together_have_the_values_that_they_have_alone(
    driver: DriverUnderTest, data: st.DataObject
) -> None:
    hold.batches(driver, data)
"""

WRITTEN = """

@models([driver for driver in DRIVERS if driver.written])
@hold.each_run
@given(data=st.data())
def test_what_was_encoded_decodes_to_the_same_value(driver: DriverUnderTest, data: st.DataObject) -> None:
    hold.round_trip(driver, data)


@models([driver for driver in DRIVERS if driver.written])
@hold.each_run
@given(data=st.data())
def test_a_value_outside_the_domain_is_refused(driver: DriverUnderTest, data: st.DataObject) -> None:
    hold.refusal(driver, data)
"""

MIRRORED = """

@models([driver for driver in DRIVERS if driver.mirrored])
@hold.each_run
@given(data=st.data())
def test_the_views_of_a_register_agree(driver: DriverUnderTest, data: st.DataObject) -> None:
    hold.agreement(driver, data)
"""


def module_text(register_map: RegisterMap) -> str:
    """Return the text of the test module of a map; maker and file names are checked identifiers of the map."""
    maker, family = register_map.id.split("/")
    registers = [register for model in register_map.models for register in model.registers]
    parts = (
        (READ, any(register.access.readable for register in registers)),
        (WRITTEN, any(register.access.writable for register in registers)),
        (MIRRORED, any(register.access.writable and len(register.views) > 1 for register in registers)),
    )
    body = BODY.format(
        header=header(register_map, prefix="# ", separator="\n# "),
        maker=maker.replace("-", "_"),
        module=family.replace("-", "_"),
        maker_text=literal(maker),
        file_text=literal(f"{family}.json"),
        classes=_classes([f"module.{model.class_name}" for model in register_map.models]),
    )
    return body + "".join(text for text, wanted in parts if wanted)


def _classes(names: list[str]) -> str:
    # as `ruff format` has it: a tuple of one stays on its line
    return f"({names[0]},)" if len(names) == 1 else "\n".join(["(", *(f"    {name}," for name in names), ")"])
