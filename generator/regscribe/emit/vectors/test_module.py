"""The generated pytest module: names and paths only; what is tested stands in `regscribe.testing`."""

from collections.abc import Iterable

from regscribe.emit.header import header
from regscribe.emit.python.formatting import call, lay
from regscribe.emit.python.literals import literal
from regscribe.model import Model, RegisterMap
from regscribe.model.identifiers import module_names

HEAD = '''"""The driver against its vectors, and properties that hold for every value."""

{header}

from pathlib import Path

import pytest

from regscribe.testing import DriverUnderTest, driver_module, load
from regscribe.testing import properties as hold

GENERATED = Path(__file__).parents[2]
VECTORS = load(GENERATED / "vectors" / {maker_text} / {file_text})
MODULE = driver_module(GENERATED, "{package}.{module}")
CLASSES = {classes}
DRIVERS = [DriverUnderTest(cls, VECTORS) for cls in CLASSES]


def models(drivers: list[DriverUnderTest]) -> pytest.MarkDecorator:
    return pytest.mark.parametrize("driver", drivers, ids=[one.model for one in drivers])


every_model = models(DRIVERS)
'''

CHECKS = {
    "check_registers": "the_driver_has_the_registers_of_its_model_at_their_addresses",
    "check_device": "requests_keep_to_the_limits_of_the_device_and_commands_send_what_the_map_says",
    "check_decoding": "words_decode_to_the_values_of_the_vectors",
    "check_encoding": "values_encode_to_the_words_of_the_vectors",
    "check_refusals": "values_that_no_words_can_carry_are_refused",
    "check_conditions_of_writing": "writes_are_allowed_exactly_under_their_conditions",
    "check_examples": "the_worked_examples_of_the_manual_hold",
}
"""Names of tests by the method of `DriverUnderTest` that each calls."""

COMPUTED = {"check_computed": "computed_values_follow_from_the_words_of_registers"}
"""The same, of maps with computed values."""

PROPERTIES = {
    "total_decoding": ("", "any_words_give_a_value_or_a_documented_error"),
    "covering_reads": ("readable", "a_read_covers_each_register_once_and_crosses_no_hole_and_no_limit"),
    "batches": ("readable", "registers_read_together_have_the_values_that_they_have_alone"),
    "round_trip": ("written", "what_was_encoded_decodes_to_the_same_value"),
    "refusal": ("written", "a_value_outside_the_domain_is_refused"),
    "agreement": ("mirrored", "the_views_of_a_register_agree"),
}
"""By the function of `regscribe.testing.properties`: what a driver must have (empty: nothing), and the test's name."""


def module_text(register_map: RegisterMap) -> str:
    """Return the text of the test module of a map; maker and file names are checked identifiers of the map."""
    maker, family = register_map.id.split("/")
    package, module = module_names(register_map.id)
    head = HEAD.format(
        header=header(register_map, prefix="# ", separator="\n# "),
        package=package,
        module=module,
        maker_text=literal(maker),
        file_text=literal(f"{family}.json"),
        classes=_classes(register_map.models),
    )
    registers = [register for model in register_map.models for register in model.registers]
    had = {
        "": True,
        "readable": any(register.access.readable for register in registers),
        "written": any(register.access.writable for register in registers),
        "mirrored": any(register.access.writable and len(register.views) > 1 for register in registers),
    }
    named = CHECKS | (COMPUTED if any(model.computed for model in register_map.models) else {})
    checks = [_test(name, ["@every_model"], [], f"driver.{check}()") for check, name in named.items()]
    properties = [_property(name, needed, function) for function, (needed, name) in PROPERTIES.items() if had[needed]]
    return "".join([head, *checks, *properties])


def _property(name: str, needed: str, function: str) -> str:
    drivers = f"@models([driver for driver in DRIVERS if driver.{needed}])" if needed else "@every_model"
    decorators = [drivers, "@hold.each_run", "@hold.drawn"]
    return _test(name, decorators, ["data: hold.Data"], f"hold.{function}(driver, data)")


def _test(name: str, decorators: Iterable[str], more: Iterable[str], body: str) -> str:
    signature = lay(call(f"test_{name}", "driver: DriverUnderTest", *more), head="def ", tail=" -> None:")
    return "\n".join(["", "", *decorators, *signature, f"    {body}", ""])


def _classes(models: Iterable[Model]) -> str:
    names = [f"MODULE.{model.class_name}" for model in models]
    # as `ruff format` has it: a tuple of one stays on its line
    return f"({names[0]},)" if len(names) == 1 else "\n".join(["(", *(f"    {name}," for name in names), ")"])
