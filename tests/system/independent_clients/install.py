"""Installs the clients of `make test-wire` where they are missing: Debian packages, and one package of npm.

As root with apt-get it installs; else it tells what to install and fails. What is there already is left alone, so a
second run takes a moment only.
"""

import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
CACHE = HERE.parents[2] / ".cache" / "wire"
PROGRAMS = {
    "mbpoll": "mbpoll",
    "socat": "socat",
    "tshark": "tshark",
    "text2pcap": "wireshark-common",
    "collectd": "collectd-core",
    "node": "nodejs",
    "npm": "npm",
}
"""Program -> Debian package. collectd's modbus plugin needs libmodbus5, which collectd-core only suggests."""

PATIENCE = 600
"""Seconds for one installer, also on a slow line."""


def missing() -> list[str]:
    """Return the Debian packages whose programs are not found."""
    places = os.pathsep.join((os.environ.get("PATH", os.defpath), "/usr/sbin"))
    packages = [package for program, package in PROGRAMS.items() if not shutil.which(program, path=places)]
    library = shutil.which("ldconfig", path=places)
    known = library and subprocess.run([library, "-p"], capture_output=True, text=True, check=False).stdout  # noqa: S603 (no shell)
    return packages if known and "libmodbus.so.5" in known else [*packages, "libmodbus5"]


def install_packages(packages: list[str]) -> None:
    """Install Debian packages without a question; ends the program where that cannot be done here."""
    by_hand = f"apt-get install --no-install-recommends {' '.join(packages)}"
    if os.geteuid() != 0 or not shutil.which("apt-get"):
        sys.exit(f"the wire tests need programs that are not installed here; as root: {by_hand}")
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    for arguments in (["update", "-qq"], ["install", "-y", "-qq", "--no-install-recommends", *packages]):
        done = subprocess.run(  # noqa: S603 (a fixed program, no shell)
            ["apt-get", *arguments],  # noqa: S607 (as the system has it)
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            timeout=PATIENCE,
            check=False,
        )
        if done.returncode:
            sys.exit(f"apt-get {arguments[0]} failed with {done.returncode}; try it by hand: {by_hand}")


def install_node_modules() -> None:
    """Install what package-lock.json pins, without scripts: its native part comes ready-made in the packages."""
    lock = (HERE / "node" / "package-lock.json").read_bytes()
    stamp, wanted = CACHE / ".installed", hashlib.sha256(lock).hexdigest()
    if stamp.is_file() and stamp.read_text(encoding="ascii") == wanted:
        return
    CACHE.mkdir(parents=True, exist_ok=True)
    for name in ("package.json", "package-lock.json"):
        shutil.copy(HERE / "node" / name, CACHE / name)
    done = subprocess.run(
        ["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error"],  # noqa: S607 (as installed)
        cwd=CACHE,
        env={"NODE_EXTRA_CA_CERTS": os.environ.get("SSL_CERT_FILE", ""), **os.environ},
        stdin=subprocess.DEVNULL,
        timeout=PATIENCE,
        check=False,
    )
    if done.returncode:
        sys.exit(f"npm ci failed with {done.returncode} in {CACHE}")
    stamp.write_text(wanted, encoding="ascii")


if __name__ == "__main__":
    absent = missing()
    if absent:
        print(f"installing {', '.join(absent)}")  # noqa: T201 (a program of its own)
        install_packages(absent)
    install_node_modules()
