"""`make bench`: speed and size as ratios, side by side in one run; exit 1 if a budget is missed.

Usage: python tests/system/bench/run.py [--full]

--full adds PeakRDL-python on 10,000 registers and the full read of every model at 9600 baud, which take minutes.
"""

import sys
from collections.abc import Iterator

import compiling
import lines
import planning
import polling
import serving
import talking
from measure import Row
from rich.console import Console
from rich.table import Table


def rows() -> Iterator[Row]:
    """All measurements."""
    yield from compiling.rows(1000, peers=True)
    yield from compiling.rows(10_000, peers="--full" in sys.argv)
    yield from talking.decoding()
    yield from polling.rows()
    yield from serving.rows()
    yield from lines.rows(every="--full" in sys.argv)
    yield from compiling.start_up()
    yield from compiling.real_maps()
    yield from planning.rows()


def main() -> int:
    """Print the table; 1 if a budget was missed."""
    table = Table("measured (against)", "ours", "theirs", "ratio", "budget", "kept")
    found = list(rows())
    for row in found:
        ratio = "-" if row.ratio != row.ratio else f"{row.ratio:.2f}"
        table.add_row(row.what, row.ours, row.theirs, ratio, row.budget, "yes" if row.kept else "NO")
    Console().print(table)
    return 0 if all(row.kept for row in found) else 1


if __name__ == "__main__":
    sys.exit(main())
