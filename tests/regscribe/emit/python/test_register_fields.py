"""A driver's register and the model's have their facts under the same names, and a declaration tells all of them."""

import inspect
from dataclasses import fields
from fractions import Fraction

from regscribe.emit.python.constants import Pool
from regscribe.emit.python.enum_classes import Content
from regscribe.emit.python.expressions import Specs
from regscribe.emit.python.register_lines import Declarations
from regscribe.model import (
    ALWAYS,
    Access,
    BitField,
    Condition,
    Conversion,
    Governs,
    Interval,
    Is,
    Kind,
    Model,
    Range,
    ReadFacts,
    Register,
    Sentinel,
    Setting,
    View,
    WireType,
    WriteCondition,
    always,
)
from regscribe_runtime import Register as DriverRegister
from regscribe_runtime import number

FIELDS = set(inspect.signature(DriverRegister.__init__).parameters) - {"self"}
BY_POSITION = {"at", "views", "value_type"}
"""`value_type` says of the kind what values look like in Python."""
EVERYTHING = Register(
    id="level",
    path="level",
    name="Level",
    kind=Kind.NUMBER,
    access=Access.READ_WRITE,
    at=7,
    views=(View("base", WireType.INT16),),
    section="1",
    aliases=(70,),
    scale=always(Conversion(Fraction(1, 10))),
    special_scale=always(Conversion(Fraction(1, 10))),
    unit=always("s"),
    range=always(Range((Interval(0, 5),))),
    valid=always(Range((Interval(0, 9),))),
    sentinels=(Sentinel(-1, "LOW", "low"),),
    default=Fraction(3),
    writable=WriteCondition(ALWAYS, "always"),
    persistence="ram",
    rescales="temperature",
    unlock="unlock",
    apply="apply",
    danger="it stops",
    stays="line",
    governs=Governs(Setting.BAUD),
    settle=5,
    when=Condition((Is("mode", ((1, 1),)),)),
    reading=ReadFacts(clears=True),
    static=True,
    mandatory=True,
    block="head",
    default_cases=always(Fraction(4)),
    fields=(BitField("hot", "hot", 0, 0, when=Condition((Is("mode", ((1, 1),)),))),),
)


class Names:
    def name(self, wanted: str, content: Content) -> str:  # noqa: ARG002 (nothing here has a class of its own)
        return wanted


def test_the_model_has_every_field_of_a_register_of_a_driver() -> None:
    worked_out = {"value_type", "partial"}
    assert FIELDS - worked_out <= {field.name for field in fields(Register)}
    assert EVERYTHING.partial
    assert DriverRegister(0, EVERYTHING.views, number).kind is EVERYTHING.kind


def test_a_declaration_tells_every_field_that_is_not_at_its_default() -> None:
    model = Model(name="A", class_name="A", registers=(EVERYTHING,))
    declared = Declarations(Specs(model, Pool()), Names()).call(EVERYTHING)
    assert {prefix.rstrip("=") for prefix, _ in declared.items if prefix} == FIELDS - BY_POSITION
    assert len([prefix for prefix, _ in declared.items if not prefix]) == len(BY_POSITION)
