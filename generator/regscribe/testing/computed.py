"""Compare what a driver computes from the words of registers with a vector."""

from collections.abc import Iterator, Mapping
from typing import Any

from regscribe.testing.compare import differs, same
from regscribe.testing.vectors import Json, known
from regscribe_runtime import Computed, NotDecodable, NotPresent, OutOfRange, RegscribeError
from regscribe_runtime.operations.compute import computed as compute
from regscribe_runtime.registers import codec
from regscribe_runtime.registers.presence import absence

OUTCOMES: dict[type[RegscribeError], str] = {
    NotPresent: "not_present",
    OutOfRange: "out_of_range",
    NotDecodable: "not_decodable",
}


def computed_of(driver: Any) -> dict[str, Computed]:  # noqa: ANN401 (a generated class)
    """The computed values of a driver by id."""
    return {name: one for base in driver.__mro__ for name, one in vars(base).items() if isinstance(one, Computed)}


def computed(driver: Any, wanted: Computed, case: Json) -> Iterator[str]:  # noqa: ANN401 (as above)
    """Yield a line if a computed value is anything but that of the vector."""
    _, givens = known(case)
    where = f"{wanted.path} with {[(one['register'], one['words']) for one in case['words']]}"
    expected = case.get("value", case.get("outcome"))
    try:
        found = compute(wanted, _entries(driver, case["words"], givens), givens)
    except (NotPresent, OutOfRange, NotDecodable) as error:
        yield from differs(where, "outcome", OUTCOMES[type(error)], case.get("outcome", f"{expected} ({error})"))
    else:
        if not ("value" in case and same(found, case["value"])):
            yield f"{where}: value {found!r}, expected {expected!r}"


def _entries(driver: Any, held: list[Json], givens: Mapping[str, Any]) -> dict[str, Any]:  # noqa: ANN401 (as above)
    """The values of registers, and the errors of those without, as a snapshot has them."""
    values: dict[str, Any] = {}
    errors: dict[str, RegscribeError] = {}
    for one in held:
        register = driver.registers[one["register"]]
        try:
            if gone := absence(register.path, register.when, values, givens, errors):
                raise gone
            state = codec.known_state(register, values, errors)
            values[register.path] = codec.decode(register, register.views[0], one["words"], state, givens)
        except RegscribeError as error:
            errors[register.path] = error
    return values | errors
