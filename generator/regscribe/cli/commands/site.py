"""`regscribe site`: references of maps, the register browser and a project's own pages as a static site."""

from pathlib import Path
from time import perf_counter

import click

from regscribe.cli.shared.compiled_maps import compiled_maps
from regscribe.cli.shared.completion_values import complete_map
from regscribe.cli.shared.diagnostic_text import count
from regscribe.cli.shared.failure import unwritten
from regscribe.cli.shared.map_arguments import find_maps
from regscribe.cli.shared.output import raised_as, tell, tell_done, warn
from regscribe.site import Site, SiteError, UnwrittenSiteError, make
from regscribe.visible import safe


@click.command(
    epilog="Example: regscribe site maps/ -o site/ && python -m http.server --directory site/\n\n"
    "Exit code 0: done, 1: errors in a map or links that lead nowhere (nothing is written), 2: wrong usage.",
)
@click.argument("maps", nargs=-1, metavar="[MAP]...", shell_complete=complete_map)
@click.option("-o", "--out", type=click.Path(path_type=Path), default=Path("site"), show_default=True, metavar="DIR")
@click.option(
    "--docs",
    "project",
    type=click.Path(path_type=Path, exists=True, file_okay=False),
    metavar="DIR",
    help="A project whose README.md is the first page, and whose *.md and docs/ come with the references.",
)
@click.option("--api", is_flag=True, help="With the reference of the Python names that drivers are used with.")
@click.option("--title", default="Registers", show_default=True, help="What the site is called.")
@click.option("--url", default="", help="Where it will be published (for its sitemap).")
def command(*, maps: tuple[str, ...], out: Path, project: Path | None, api: bool, title: str, url: str) -> int:
    """Make a static site of maps: a reference for each to search, and the register browser.

    MAP is a map file, a folder that is searched for *.yaml, or the id of a map (fdc/series-100). Without MAP: maps/.
    Every link of what was built is checked; where one leads nowhere, the site of before stays. The site is for a
    server; `regscribe browse` makes a page that opens from disk. It needs Zensical: pip install 'regscribe[site]'.
    """
    started = perf_counter()
    register_maps = compiled_maps(find_maps(maps), nothing="nothing was written")
    with raised_as(click.ClickException, SiteError), unwritten(UnwrittenSiteError):
        pages, faults = make(Site(register_maps, project, api=api, title=title, url=url), out)
    for fault in faults:
        tell(f"{safe(str(fault))}\n")
    if faults:
        warn(f"nothing was written: {count(len(faults), 'fault')}\n")
        return 1
    tell_done(safe(f"{count(pages, 'page')} in {out}; {perf_counter() - started:.1f} s") + "\n")
    return 0
