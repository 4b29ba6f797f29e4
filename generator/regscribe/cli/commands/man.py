"""`regscribe man`: the manual pages of all commands."""

from pathlib import Path

import click

from regscribe.cli.shared.man_page import pages
from regscribe.cli.shared.output import tell_done
from regscribe.cli.shared.output_file import make_folder, save
from regscribe.visible import safe


@click.command(epilog="Example: regscribe man -o ~/.local/share/man/man1 && man regscribe-read")
@click.option("-o", "--out", type=click.Path(path_type=Path), required=True, metavar="DIR", help="Where the pages go.")
@click.pass_context
def command(context: click.Context, *, out: Path) -> None:
    """Write the manual pages of regscribe and of each of its commands, for man(1).

    They say what the help of each command says. A folder man1 below one of `manpath` is where man finds them.
    """
    root = context.find_root().command
    assert isinstance(root, click.Group)  # noqa: S101 - it has this command
    make_folder(out)
    written = dict(pages(root))
    for name, text in written.items():
        save(out / name, text)
    tell_done(f"{len(written)} pages in {safe(str(out))}\n")
