"""Registers of 32 bits among those of 16 (Enron's): one address has one length."""

from collections.abc import Iterator

from regscribe.checks.addresses import stretches
from regscribe.checks.rule import Finding, RuleScope, model_rule
from regscribe.model import Register, Related, Space
from regscribe_runtime.values.wire_types import WIRE


@model_rule("RS0681", "Address of a register of 16 and of one of 32 bits")
def of_two_lengths(scope: RuleScope) -> Iterator[Finding]:
    """Both are asked for by the same functions, so the device could not tell which is meant."""
    short: dict[int, Register] = {}
    for register in scope.model.registers:
        for stretch in stretches(register) if not register.block else ():
            if stretch.space is Space.HOLDING:
                short |= dict.fromkeys((at & WIRE for at in range(stretch.first, stretch.last + 1)), register)
    for register in scope.model.registers:
        for stretch in stretches(register):
            taken = range(stretch.first, stretch.last + 1) if stretch.space is Space.ENRON else ()
            address = next((at for each in taken if (at := Space.ENRON.plain(each)) in short), None)
            if address is not None:
                other = short[address]
                related = Related(f"`{other.path}` takes holding {address}", other.span)
                message = f"takes {stretch}, and address {address} is a holding register of 16 bits as well"
                yield Finding.at(register, message, "correct `at` or `space` of one of them", related)
