"""What every live command takes: TARGET and the options that describe it; and the open device that they lead to."""

import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import wraps
from inspect import getdoc
from typing import Any, TypeVar

import click

from regscribe.cli.shared.completion_values import complete_model, complete_target
from regscribe.cli.shared.exit_codes import REFUSED
from regscribe.cli.shared.failure import Failure
from regscribe.cli.shared.global_options import is_verbose
from regscribe.cli.shared.live_report import FrameTracer, reported
from regscribe.cli.shared.output import detail, remark
from regscribe.tools.live import catalogue
from regscribe.tools.live import config as configuration
from regscribe.tools.live import target as targets
from regscribe.tools.live.errors import TargetError
from regscribe_runtime import BareDevice

F = TypeVar("F", bound=Callable[..., Any])
Decorator = Callable[[Any], Any]

HELP = """TARGET is a link (tcp:10.0.0.7:502?unit=1&model=16C, rtu:/dev/ttyUSB0?baud=9600&parity=E) or a name of the
configuration. Without a model the device is asked what it is. Models are those of the maps in maps/ here, too, and of
the map that ?map=FILE (or --map) names."""
"""How a command's help explains TARGET."""


def declared(*options: Decorator) -> Decorator:
    """One decorator that declares several options or arguments, in this order."""

    def declare(command: Any) -> Any:  # noqa: ANN401 - a function that becomes a command
        for option in reversed(options):
            command = option(command)
        return command

    return declare


_package = click.option(
    "--package",
    "packages",
    multiple=True,
    metavar="NAME",
    help="A package of drivers of your own, or its folder. Repeat for several.",
)


def _tell_config(_context: click.Context, _option: click.Parameter, value: str | None) -> str | None:
    """Tell, with --verbose, which configuration counts."""
    if is_verbose():
        detail(f"configuration: {configuration.find(value) or 'none'}")
    return value


_config = declared(
    click.option(
        "--config",
        metavar="FILE",
        callback=_tell_config,
        help="Devices by name; without it $REGSCRIBE_CONFIG, regscribe.yaml here or in a folder above, or devices.yaml "
        "in the user's folder of configurations.",
    ),
    click.option("--no-config", "config", flag_value=configuration.NONE, help="Read no configuration at all."),
)


def _is_json(_context: click.Context, _option: click.Parameter, value: str | None) -> bool:
    return value == "json"


json_option = declared(
    click.option(
        "--format",
        "as_json",
        type=click.Choice(["text", "json"]),
        default="text",
        callback=_is_json,
        help="What is printed: for people, or one JSON object for programs.",
    ),
    click.option("--json", "as_json", flag_value="json", callback=_is_json, help="The same as --format json."),
)
driver_options = declared(_package, _config, json_option)
given_option = click.option(
    "--given",
    "givens",
    multiple=True,
    metavar="ID=VALUE",
    help="A fact that the manual leaves to another: codes (1,4..6) or true or false. Repeat for several.",
)
base_option = click.option(
    "--base",
    "bases",
    multiple=True,
    metavar="NAME=ADDRESS",
    help="Where a block begins, or the marker of a chain; without it an assumed address. Repeat for several.",
)
confirm_option = click.option("--confirm", is_flag=True, help="Write where the map calls it dangerous, too.")
identity_option = click.option(
    "--check-identity/--no-check-identity",
    "identity",
    default=True,
    help="Refuse a device that shows to be of another model, before anything is written (on unless switched off).",
)
"""The option of commands that write: `identity: bool` for `opened`."""

_target_options = declared(
    click.option("--unit", type=click.IntRange(0, 255), metavar="N", help="Unit id, in place of the target's."),
    click.option("--model", metavar="M", shell_complete=complete_model, help="Model, in place of the target's."),
    click.option("--map", "map_name", metavar="MAP", help="The map of the model: a file or an id."),
    given_option,
    _package,
    _config,
    click.option("--trace", is_flag=True, help="Tell of every frame on standard error, in hexadecimal and in names."),
    json_option,
    click.argument("target_text", metavar="TARGET", shell_complete=complete_target),
)


def target_options(function: F) -> F:
    """Give a command TARGET, --unit, --model, --map, --given, --package, --config, --trace and --json.

    The function is called with `target: Target` and `as_json: bool` in their place. A docstring as the command's help
    is followed by the explanation of TARGET.
    """

    @wraps(function)
    def with_target(
        *args: Any,  # noqa: ANN401 - whatever the command takes besides
        target_text: str,
        unit: int | None,
        model: str | None,
        map_name: str | None,
        givens: tuple[str, ...],
        packages: tuple[str, ...],
        config: str | None,
        trace: bool,
        **more: Any,  # noqa: ANN401 - as above
    ) -> Any:  # noqa: ANN401 - the command's own result
        with reported():
            target = targets.named(target_text, config, packages)
            given = targets.given_texts(givens)
            target = targets.override(target, unit=unit, model=model or "", map_name=map_name or "", given=given)
            target = replace(target, trace=FrameTracer(target)) if trace else target
        return function(*args, target=target, **more)

    with_target.__doc__ = f"{getdoc(function) or ''}\n\n{HELP}"
    result: F = _target_options(with_target)
    return result


@contextmanager
def opened(
    target: targets.Target, *, identity: bool = False, check: Callable[[type[BareDevice]], object] | None = None
) -> Iterator[BareDevice]:
    """The open driver of a target while the block runs; errors in it, too, become one message and an exit code.

    The device is asked for its model if the target has none. `check` is called with the driver's class before the link
    is opened: it raises TargetError for names that the model does not have. With `identity`, a device that shows
    another model than the target's is refused before anything else is sent.
    """
    silence_loggers()
    with reported():
        identified = targets.identified(target)
        driver = (known := identified.known()).driver
        if note := catalogue.instead_of_shipped(known):
            remark(note)
        if check is not None:
            check(driver)
        if isinstance(target.trace, FrameTracer):
            target.trace.decode_for(driver)
        with targets.connect(identified) as device:
            if identity:
                _check_identity(device, identified)
            yield device


@contextmanager
def opened_unknown(target: targets.Target) -> Iterator[BareDevice]:
    """As `opened`, for words at addresses: the device is not asked for its model."""
    silence_loggers()
    with reported(), targets.unknown_device(target) as device:
        yield device


def silence_loggers() -> None:
    """Keep what libraries log off the terminal: every error of the line is reported here, once."""
    logging.getLogger().addHandler(logging.NullHandler())


def _check_identity(device: BareDevice, target: targets.Target) -> None:
    """Ask the device whether it is of its driver's model; Failure if it shows to be another one."""
    try:
        targets.check_identity(device, target)
    except TargetError as error:
        raise Failure(str(error), kind="wrong-device", code=REFUSED) from None
