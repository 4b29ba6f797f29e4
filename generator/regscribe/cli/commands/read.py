"""`regscribe read`: values of registers, groups and array elements, with their units."""

from collections.abc import Mapping, Sequence
from functools import partial

import click

from regscribe.cli.shared.completion_values import complete_register
from regscribe.cli.shared.live_report import heading, plain, refused_if
from regscribe.cli.shared.output import alert, hexadecimal, print_json, remark, show_table, tell
from regscribe.cli.shared.target_options import opened, opened_unknown, target_options
from regscribe.tools.live import names
from regscribe.tools.live.addresses import NoRegisterError, is_address, raw_place, spelled
from regscribe.tools.live.errors import TargetError
from regscribe.tools.live.reading import readings, word_at
from regscribe.tools.live.target import Target
from regscribe.visible import safe
from regscribe_runtime import BareDevice, Computed
from regscribe_runtime.operations import tasks
from regscribe_runtime.operations.session import Task


@click.command(
    epilog="Example: regscribe read oven process_value alarm segments[1]\n\n"
    "Exit code 0: every register has a value, 1: one has none (a fault, a refusal), 2: wrong usage, 3: nobody answers.",
)
@target_options
@click.argument("wanted", nargs=-1, required=True, metavar="NAME...", shell_complete=complete_register)
@click.option("--value", "bare", is_flag=True, help="Print nothing but the values, one a line, without units.")
@click.option(
    "--raw",
    is_flag=True,
    help="Print words as they stand on the wire: of the view that is preferred, or of any address, known or not.",
)
def command(*, target: Target, as_json: bool, wanted: tuple[str, ...], bare: bool, raw: bool) -> int:
    """Read registers, groups, arrays (segments), their elements (segments[1]) and computed values in few requests.

    A flag or field of a word is read by name, too (status.running), and what stands at an address: 4049, 0xFD1, 44050,
    holding:4049 (also input, coil, discrete). An address of another view reads that view. Addresses are read --raw
    without a model, too.
    """
    if raw:
        unknown = not target.model and all(map(is_address, wanted))
        check = partial(_to_read_raw, wanted=wanted)
        with opened_unknown(target) if unknown else opened(target, check=check) as device:
            _show_words(device, target, _to_read_raw(type(device), wanted), as_json=as_json)
        return 0
    with opened(target, check=lambda driver: names.chosen(driver, wanted)) as device:
        chosen = names.choices(type(device), wanted)
        found = device.run(readings(names.chosen(type(device), wanted)))
    for note in dict.fromkeys(one.note for one in chosen if one.note and not as_json):
        remark(note)
    if as_json:
        print_json(**heading(device, target), registers={one.name: plain(one) for one in found})
    elif bare:
        tell("".join(f"{safe(one.text)}\n" for one in found))
        for one in found:
            if one.error is not None:
                alert(str(one.error))
    else:
        show_table(("REGISTER", "VALUE"), [(one.name, one.spelled) for one in found])
    return refused_if(any(one.error for one in found))


def _to_read_raw(driver: names.Driver, wanted: Sequence[str]) -> dict[str, Task[tuple[int, ...]]]:
    """How to read the words of each name; of an address that no register has, the word there."""
    found: dict[str, Task[tuple[int, ...]]] = {}
    for name in wanted:
        try:
            chosen = names.chosen(driver, [name])
        except NoRegisterError:
            place = raw_place(name)
            found[spelled(place)] = word_at(place)
            continue
        for one in chosen:
            if isinstance(one, Computed):
                message = f"`{one.path}` has no words of its own: it is {names.computed_from(one)}"
                raise TargetError(message)
            excerpt = one if isinstance(one, names.Excerpt) else names.Excerpt(one)
            found[one.path] = tasks.read_raw(excerpt.register, excerpt.view or None)
    return found


def _show_words(
    device: BareDevice, target: Target, wanted: Mapping[str, Task[tuple[int, ...]]], *, as_json: bool
) -> None:
    words = {name: device.run(task) for name, task in wanted.items()}
    if as_json:
        print_json(**heading(device, target), registers={name: {"words": list(one)} for name, one in words.items()})
    else:
        show_table(("REGISTER", "WORDS"), [(name, hexadecimal(one)) for name, one in words.items()])
