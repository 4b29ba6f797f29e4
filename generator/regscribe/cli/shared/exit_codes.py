"""The exit codes of all commands, in one place."""

FINDINGS = REFUSED = 1
USAGE = 2
SILENT = 3
UNKNOWN_STATE = 4
INTERNAL, OUTPUT = 70, 74
"""EX_SOFTWARE and EX_IOERR, as sysexits.h has them."""

INTERRUPTED, CLOSED_PIPE, STOPPED = 130, 141, 143
"""128 + SIGINT, SIGPIPE or SIGTERM, as in a shell."""

EXIT_CODES = {
    0: "done, or nothing found to complain about",
    FINDINGS: "findings: errors in a map, a difference, a refusal (by the device or before it), or nothing was found",
    USAGE: "wrong usage: the command line, or a name or a file in it; nothing was sent to a device",
    SILENT: "nobody answers: the link cannot be opened, was lost, the device is silent, or a gateway says so",
    UNKNOWN_STATE: "a write broke off or reads back differently: look at what the device holds",
    INTERNAL: "internal error: a bug in regscribe; nothing is known of the map or the device",
    OUTPUT: "standard output or a file cannot be written (a full disk, no such folder), or standard output is closed",
    INTERRUPTED: "Ctrl-C",
    CLOSED_PIPE: "whoever read the output went away (`dump oven | head -1`); nothing is said",
    STOPPED: "`simulate` was stopped by the signal TERM",
}
"""What each says; README.md, docs/cli.md and the manual pages have this table."""
