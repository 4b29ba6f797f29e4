"""`regscribe watch`: values as they change, with a chart and a log."""

import sys
from collections.abc import Iterator, Sequence
from contextlib import closing, nullcontext
from pathlib import Path

import click

from regscribe.cli.shared.completion_values import complete_register
from regscribe.cli.shared.exit_codes import OUTPUT
from regscribe.cli.shared.failure import Failure
from regscribe.cli.shared.live_report import failure
from regscribe.cli.shared.live_view import Screen, lines
from regscribe.cli.shared.output import print_json_line, tell
from regscribe.cli.shared.target_options import opened, target_options
from regscribe.tools.live import log as logs
from regscribe.tools.live import names
from regscribe.tools.live.target import Target
from regscribe.tools.live.watch import GaveUp, Round, watch
from regscribe_runtime import Computed


@click.command(
    epilog="Example: regscribe watch oven process_value alarm --every 2 --chart process_value --log oven.csv\n\n"
    "Exit code 0: --count rounds are done, 1: the log cannot be written any more, 2: wrong usage, 3: nobody answers, "
    "or not any more, 130: Ctrl-C (the log is whole).",
)
@target_options
@click.argument("wanted", nargs=-1, required=True, metavar="NAME...", shell_complete=complete_register)
@click.option("--every", type=click.FloatRange(0, 86_400.0), default=1.0, show_default=True, metavar="SECONDS")
@click.option("--count", type=click.IntRange(0), default=0, help="Stop after so many rounds (0: never).")
@click.option(
    "--chart", "charts", multiple=True, metavar="NAME", help="Draw the curve of a number. Repeat for several."
)
@click.option("--log", "log_path", type=click.Path(path_type=Path), help="Keep all: .csv, .jsonl or .sqlite.")
@click.option(
    "--give-up",
    type=click.IntRange(0),
    default=5,
    show_default=True,
    metavar="N",
    help="End after N rounds in a row without an answer (0: never).",
)
def command(
    *,
    target: Target,
    as_json: bool,
    wanted: tuple[str, ...],
    every: float,
    count: int,
    charts: tuple[str, ...],
    log_path: Path | None,
    give_up: int,
) -> int:
    """Read registers again and again: a live table with changes marked, on a pipe a line for each change.

    The line is never asked faster than it can answer: a round begins when the last is done and a tenth of its time
    passed.
    """
    every_name = (*wanted, *charts)
    with opened(target, check=lambda driver: names.chosen(driver, every_name)) as device:
        named = names.chosen(type(device), every_name)
        followed = [one for one in named if one.path in every_name or _is_followed(one)]
        curves = [one.path for one in names.chosen(type(device), charts)]
        rounds = watch(device, followed, every=every, count=count, give_up=give_up)
        try:
            with closing(logs.open_log(log_path, str(target))) if log_path else nullcontext() as log:
                _follow(_logged(rounds, log), followed, curves, str(target), as_json=as_json)
        except GaveUp as end:
            raise failure(end.error) from None
        except logs.LogError as error:
            raise Failure(str(error), kind="log", code=OUTPUT) from None
    return 0


def _is_followed(one: names.Readable) -> bool:
    return isinstance(one, Computed) or one.reading.poll != "never"


def _logged(rounds: Iterator[Round], log: logs.TextLog | logs.SqliteLog | None) -> Iterator[Round]:
    for one in rounds:
        if log is not None:
            log.write(one)
        yield one


def _follow(
    rounds: Iterator[Round], followed: Sequence[names.Readable], curves: Sequence[str], device: str, *, as_json: bool
) -> None:
    screen = Screen(device, [one.path for one in followed], curves)
    if as_json:
        for one in rounds:
            print_json_line(**logs.plain(one, device))
    elif sys.stdout.isatty():
        screen.follow(rounds)
    else:
        for one in rounds:
            tell("".join(lines(one)))
            sys.stdout.flush()
            screen.take(one)
        tell(screen.drawn(width=80))
