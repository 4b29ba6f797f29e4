"""`regscribe new`: start a map from a commented skeleton."""

from pathlib import Path

import click

from regscribe.cli.shared.exit_codes import OUTPUT
from regscribe.cli.shared.failure import Failure
from regscribe.cli.shared.map_heads import parts_of, schema_for, skeleton
from regscribe.cli.shared.output import refuse, tell_done
from regscribe.visible import safe


@click.command(
    epilog="Example: regscribe new acme/oven-3\n\nExit code 0: done, 2: wrong usage, 74: the map cannot be written.",
)
@click.argument("map_id", metavar="MAKER/FAMILY")
@click.option("--dir", "folder", type=click.Path(path_type=Path), default=Path("maps"), show_default=True)
def command(*, map_id: str, folder: Path) -> None:
    """Start a map: a commented skeleton that passes `regscribe check`; `regscribe import` begins with a table instead.

    Nothing is overwritten. If there is no schema beside the folder, a copy of it is put there, so that an editor can
    complete and explain the keys.
    """
    maker, family = parts_of(map_id)
    path = folder / maker / f"{family}.yaml"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("x", encoding="utf-8", newline="\n") as file:
            file.write(skeleton(map_id, schema_for(folder)))
    except FileExistsError:
        refuse(f"{path} exists; nothing was changed. Choose another name or edit that map")
    except OSError as error:
        message = f"cannot write {path}: {error.strerror}; choose another folder with --dir"
        raise Failure(message, kind="file", code=OUTPUT) from None
    tell_done(safe(f"{path} is ready to be filled in; then: regscribe check {path}") + "\n")
