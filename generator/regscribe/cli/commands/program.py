"""`regscribe program`: setpoint programs of controllers, shown, read, checked, written and run."""

from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path

import click

from regscribe.cli.shared.diagnostic_text import count
from regscribe.cli.shared.exit_codes import REFUSED, UNKNOWN_STATE
from regscribe.cli.shared.failure import Failure
from regscribe.cli.shared.live_report import code_of, heading, kind_of, reported
from regscribe.cli.shared.output import print_json, remark, show_table, tell
from regscribe.cli.shared.output_file import none_for_stdout, save_result
from regscribe.cli.shared.program_text import show_program
from regscribe.cli.shared.target_options import confirm_option, identity_option, json_option, opened, target_options
from regscribe.tools import programs
from regscribe.tools.live import catalogue
from regscribe.tools.live.errors import TargetError
from regscribe.tools.live.target import Target
from regscribe.tools.programs.picture import picture
from regscribe.tools.programs.run import Act
from regscribe.tools.programs.write import WhileRunning
from regscribe_runtime import BareDevice

program_option = click.option(
    "--program",
    "name",
    default="",
    metavar="NAME",
    help="Which program, where a device has several: its name or number.",
)
beyond_option = click.option(
    "--beyond-limits", is_flag=True, help="Allow setpoints beyond the controller's limits where its manual sets none."
)
file_argument = click.argument("file", type=click.Path(path_type=Path))

CODES = "Exit code 0: done, 1: refused, 2: wrong usage, 3: nobody answers, 4: what the device holds is unknown."


@click.group(epilog="Example: regscribe program write oven anneal.yaml && regscribe program start oven")
def command() -> None:
    """Setpoint programs (ramp and soak) of controllers: read as YAML, drawn, checked, written and run.

    The same file looks alike for every controller; its JSON Schema is schema/program.schema.json.
    """


def live(name: str, example: str = "", about: str = "") -> Callable[[Callable[..., int]], click.Command]:
    """Declare a command with TARGET and `--program`; its help is `about`, else the function's docstring."""

    def declare(function: Callable[..., int]) -> click.Command:
        function.__doc__ = about or function.__doc__
        epilog = f"{example}\n\n{CODES}" if example else CODES
        return command.command(name=name, epilog=epilog)(program_option(target_options(function)))

    return declare


@live("show", "Example: regscribe program show oven")
@click.option("--svg", type=click.Path(path_type=Path), metavar="FILE", help="Write the profile as a picture, too.")
def show(*, target: Target, as_json: bool, name: str, svg: Path | None) -> int:
    """Show a program: its settings, its segments and its profile."""
    with opened(target) as device:
        here = programs.place(device, name)
        found = device.run(programs.read(here))
    if as_json:
        print_json(**heading(device, target), program=programs.plain(found))
    else:
        show_program(found, first=here.spec.segments.first)
    if svg:
        save_result(svg, picture(found, first=here.spec.segments.first))
    return 0


@live("read", "Example: regscribe program read oven --out anneal.yaml")
@click.option(
    "--out",
    type=click.Path(path_type=Path),
    callback=none_for_stdout,
    metavar="FILE",
    help="The file; without it, or for -, standard output.",
)
def read_command(*, target: Target, as_json: bool, name: str, out: Path | None) -> int:
    """Read a program as a YAML file that `write` takes."""
    with opened(target) as device:
        found = device.run(programs.read(programs.place(device, name)))
    if as_json:
        print_json(**heading(device, target), program=programs.plain(found))
        return 0
    text = programs.dump(found, remarks=(f"The program of {target}.",))
    if out:
        save_result(out, text, count(len(found.segments), "segment"))
    else:
        tell(text)
    return 0


@live("validate")
@file_argument
@beyond_option
def validate(*, target: Target, as_json: bool, name: str, file: Path, beyond_limits: bool) -> int:
    """Hold a file against a device as it is configured now; nothing is written."""
    with reported():
        given = programs.load(file)
    with opened(target) as device:
        here = programs.place(device, name)
        _fits(given, here)
        checked = device.run(programs.check(here, given.program, beyond_limits=beyond_limits))
    if as_json:
        problems = [
            {"at": given.place(one.where), "where": one.label, "message": one.message} for one in checked.problems
        ]
        print_json(**heading(device, target), valid=not problems, problems=problems)
    elif checked.problems:
        raise _refused(given, programs.ProgramRefused(here, checked.problems))
    else:
        remark(f"{here.name} of the {here.model} can hold it: {count(len(checked.planned), 'register')}")
    return REFUSED if checked.problems else 0


@live(
    "write",
    "Example: regscribe program write oven anneal.yaml",
    "Write a file to a device: checked first, only what differs, read back in the end. Refused while a program runs.",
)
@file_argument
@click.option(
    "--while-running",
    type=click.Choice(["refuse", "reset", "write"]),
    default="refuse",
    show_default=True,
    help="What to do about a program that runs: refuse, end it first, or write all the same.",
)
@beyond_option
@confirm_option
@identity_option
def write_command(
    *,
    target: Target,
    as_json: bool,
    name: str,
    file: Path,
    while_running: WhileRunning,
    beyond_limits: bool,
    confirm: bool,
    identity: bool,
) -> int:
    """Write a file to a device."""
    with reported():
        given = programs.load(file)
    with opened(target, identity=identity) as device:
        here = programs.place(device, name)
        _fits(given, here)
        task = programs.write(
            here, given.program, while_running=while_running, beyond_limits=beyond_limits, confirm=confirm
        )
        try:
            done = device.run(task)
        except programs.ProgramRefused as error:
            raise _refused(given, error) from None
        except programs.ProgramUnfinished as error:
            raise Failure(str(error), kind=kind_of(error), code=UNKNOWN_STATE) from None
    if as_json:
        print_json(**heading(device, target), written=done.written, registers=done.total)
    else:
        remark(f"{here.name}: {done.written} of {count(done.total, 'register')} written, all read back")
    return 0


@live("status")
def status_command(*, target: Target, as_json: bool, name: str) -> int:
    """Tell whether a program runs, and where it is."""
    with opened(target) as device:
        now = device.run(programs.status(programs.place(device, name)))
    _show_state(device, target, now, as_json=as_json)
    return 0


def _act(what: Act, about: str) -> None:
    @live(what, about=about)
    @confirm_option
    @identity_option
    def run(*, target: Target, as_json: bool, name: str, confirm: bool, identity: bool) -> int:
        with opened(target, identity=identity) as device:
            now = device.run(programs.act(programs.place(device, name), what, confirm=confirm))
        _show_state(device, target, now, as_json=as_json)
        return 0


_act("start", "Start a program. Refused while one runs, or where the device is not set to run it.")
_act("hold", "Halt a program that runs, to be resumed.")
_act("resume", "Let a program that is held go on.")
_act("reset", "End a program that runs or is held.")


@command.command(name="draw", epilog="Example: regscribe program draw anneal.yaml --svg anneal.svg")
@file_argument
@click.option("--svg", type=click.Path(path_type=Path), metavar="FILE", help="Write the picture here.")
@json_option
def draw(*, file: Path, svg: Path | None, as_json: bool) -> int:
    """Draw the profile of a file, without a device: in the terminal, or as a picture."""
    with reported():
        given = programs.load(file).program
    first = _first(given)
    if svg:
        save_result(svg, picture(given, first=first))
    if as_json:
        print_json(file=str(file), svg=str(svg or ""), program=programs.plain(given))
    elif not svg:
        show_program(given, first=first)
    return 0


def _first(given: programs.Program) -> int:
    """The number of the first segment on the model that a file is for; 1 if it says nothing of it."""
    try:
        name = f"{given.map_id}:{given.model}" if given.map_id else given.model
        return programs.places(catalogue.find(name).driver)[0].spec.segments.first if given.model else 1
    except (TargetError, IndexError):
        return 1


def _fits(given: programs.ProgramFile, here: programs.ProgramSlot) -> None:
    """Print a remark if a file was made for another device; whether it fits nevertheless, the check decides."""
    made, own = (given.program.map_id, given.program.model), (here.map_id, here.model)
    if any(one and one != other for one, other in zip(made, own, strict=True)):
        remark(f"the file was made for {' '.join(filter(None, made))}; this is {' '.join(own)}")


def _refused(given: programs.ProgramFile, error: programs.ProgramRefused) -> Failure:
    lines = [f"{given.place(one.where)}: {one}" for one in error.problems]
    found = count(len(lines), "mistake") if len(lines) > 1 else "a mistake"
    return Failure("\n".join([f"{found}, so nothing is written", *lines]), kind=kind_of(error), code=code_of(error))


def _show_state(device: BareDevice, target: Target, now: programs.ProgramState, *, as_json: bool) -> None:
    facts = asdict(now) | {"setpoint": None if now.setpoint is None else str(now.setpoint)}
    if as_json:
        print_json(**heading(device, target), **facts)
    else:
        show_table(("", ""), [(key, str(value)) for key, value in facts.items() if value not in {None, ""}])
