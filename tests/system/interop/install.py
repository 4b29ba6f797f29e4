"""Installs the programs of `make test-interop` where they are missing: each into a folder of its own below `.cache`.

Python packages into a venv, packages of npm into a folder, Debian packages into the system (as root with apt-get; else
it tells what to install and fails). What is there already is left alone, so a second run takes a moment only. It needs
nothing but Python's own library, so it can run while the environment of the project is still being made.

    python tests/system/interop/install.py [NAME...]
"""

import json
import os
import shutil
import subprocess
import sys
import time
from dataclasses import asdict, dataclass, field
from pathlib import Path

CACHE = Path(__file__).parents[3] / ".cache" / "interop"

PATIENCE = 900
"""Seconds for one installer, also on a slow line."""


@dataclass(frozen=True, slots=True)
class Consumer:
    """A program that reads exports: its name, and what it is made of.

    `pip` and `npm` are packages with their versions; what these need besides is what they ask for. `programs` are
    programs of the system, with the Debian package of each. `unpacked` are Debian packages of which the files are
    wanted in the folder, and nothing installed.
    """

    name: str
    pip: tuple[str, ...] = ()
    npm: tuple[str, ...] = ()
    programs: dict[str, str] = field(default_factory=dict)
    unpacked: tuple[str, ...] = ()

    @property
    def folder(self) -> Path:
        """Where it is installed."""
        return CACHE / self.name

    @property
    def python(self) -> Path:
        """The interpreter of its venv."""
        return self.folder / "venv" / "bin" / "python"

    @property
    def missing(self) -> tuple[str, ...]:
        """The Debian packages whose programs are not found."""
        places = os.pathsep.join((os.environ.get("PATH", os.defpath), "/usr/sbin"))
        absent = [package for name, package in self.programs.items() if not shutil.which(name, path=places)]
        return tuple(dict.fromkeys(absent))

    @property
    def installed(self) -> bool:
        """Whether all of it is there, in these versions."""
        if self.missing:
            return False
        stamp = self.folder / ".installed"
        return not (self.pip or self.npm or self.unpacked) or (
            stamp.is_file() and stamp.read_text(encoding="utf-8") == self.stamp
        )

    @property
    def stamp(self) -> str:
        """What a folder says that has all of it."""
        return json.dumps([asdict(self), sys.version_info[:2]])


NODE = {"node": "nodejs", "npm": "npm"}

CONSUMERS = (
    Consumer("c-compiler", programs={"gcc": "gcc", "g++": "g++"}),
    Consumer("home-assistant", pip=("homeassistant==2024.3.3", "pymodbus==3.6.6")),
    Consumer("esphome", pip=("esphome==2026.6.5",)),
    Consumer("zabbix-agent2", programs={"zabbix_agent2": "zabbix-agent2", "node": "nodejs"}),
    Consumer("pymodbus-simulator", pip=("pymodbus==3.16.1", "aiohttp")),
    Consumer("zabbix-frontend", programs={"php": "php-cli"}, unpacked=("zabbix-frontend-php",)),
    Consumer("promtool", programs={"promtool": "prometheus"}),
    Consumer("asyncua", pip=("asyncua==2.1.0",)),
    Consumer("node-red", npm=("node-red@4.1.15", "node-red-contrib-modbus@5.23.3"), programs=NODE),
    Consumer("node-wot", npm=("@node-wot/core@0.8.16", "@node-wot/binding-modbus@0.8.16"), programs=NODE),
)
"""Every program, in the order in which they are installed: a new one is a line here and a file test_<name>.py."""


def consumer(name: str) -> Consumer:
    """Return the program of this name."""
    return next(one for one in CONSUMERS if one.name == name)


def install(consumers: tuple[Consumer, ...]) -> None:
    """Install what is missing of these; ends the program where that cannot be done here."""
    wanted = [one for one in consumers if not one.installed]
    if packages := tuple(dict.fromkeys(package for one in wanted for package in one.missing)):
        _debian(packages)
    for one in wanted:
        if one.pip or one.npm or one.unpacked:
            begun = time.monotonic()
            shutil.rmtree(one.folder, ignore_errors=True)
            one.folder.mkdir(parents=True)
            _venv(one)
            _modules(one)
            _unpack(one)
            (one.folder / ".installed").write_text(one.stamp, encoding="utf-8")
            print(f"installed {one.name} in {time.monotonic() - begun:.0f} s", flush=True)  # noqa: T201 (a program of its own)


def _debian(packages: tuple[str, ...]) -> None:
    by_hand = f"apt-get install --no-install-recommends {' '.join(packages)}"
    if os.geteuid() != 0 or not shutil.which("apt-get"):
        sys.exit(f"the tests need programs that are not installed here; as root: {by_hand}")
    print(f"installing {', '.join(packages)}", flush=True)  # noqa: T201 (a program of its own)
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive", "RUNLEVEL": "1"}  # starts no service
    waiting = ["-o", f"DPkg::Lock::Timeout={PATIENCE}"]  # another test run may be installing as well
    for arguments in (["update", "-qq"], ["install", "-y", "-qq", "--no-install-recommends", *packages]):
        _run(["apt-get", *waiting, *arguments], by_hand, environment=environment)


def _venv(one: Consumer) -> None:
    if not one.pip:
        return
    _run([sys.executable, "-m", "venv", str(one.folder / "venv")], f"making the venv of {one.name}")
    if _quickly(one):
        return
    options = ["--quiet", "--disable-pip-version-check", "--no-input"]
    _run([str(one.python), "-m", "pip", "install", *options, *one.pip], f"pip install {' '.join(one.pip)}")


def _quickly(one: Consumer) -> bool:
    """Install by uv, which takes a tenth of the time of pip; False where it is not to be had, or cannot."""
    uv = CACHE / "uv" / "bin" / "uv"
    if not uv.exists():
        made = _tried([sys.executable, "-m", "venv", str(CACHE / "uv")])
        if not (made and _tried([str(CACHE / "uv" / "bin" / "pip"), "install", "--quiet", "uv"])):
            return False
    return _tried([str(uv), "pip", "install", "--quiet", "--python", str(one.python), *one.pip])


def _tried(command: list[str]) -> bool:
    done = subprocess.run(  # noqa: S603 (fixed programs, no shell)
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        timeout=PATIENCE,
        check=False,
    )
    return done.returncode == 0


def _modules(one: Consumer) -> None:
    if one.npm:
        options = ["--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error", "--prefix", str(one.folder)]
        _run(["npm", "install", *options, *one.npm], f"npm install {' '.join(one.npm)}", environment=_trusting())


def _trusting() -> dict[str, str]:
    """The environment, in which npm trusts the certificates that other programs are told to trust."""
    certificates = os.environ.get("SSL_CERT_FILE", "")
    return {**({"NODE_EXTRA_CA_CERTS": certificates} if certificates else {}), **os.environ}


def _unpack(one: Consumer) -> None:
    if one.unpacked and os.geteuid() == 0:
        _run(["apt-get", "update", "-qq"], "apt-get update")
    for package in one.unpacked:
        _run(["apt-get", "download", "-qq", package], f"apt-get download {package}", folder=one.folder)
        (file,) = one.folder.glob(f"{package}_*.deb")
        _run(["dpkg", "-x", str(file), str(one.folder)], f"dpkg -x {file} {one.folder}")
        file.unlink()


def _run(command: list[str], what: str, environment: dict[str, str] | None = None, folder: Path | None = None) -> None:
    """Run an installer, which says something only if it fails; that ends the program."""
    done = subprocess.run(  # noqa: S603 (fixed programs, no shell)
        command,
        env=environment,
        cwd=folder,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    if done.returncode:
        sys.exit(f"{done.stdout[-4000:]}\n{command[0]} failed with {done.returncode}; try it by hand: {what}")


if __name__ == "__main__":
    known = {one.name: one for one in CONSUMERS}
    if unknown := [name for name in sys.argv[1:] if name not in known]:
        sys.exit(f"there is no consumer {unknown[0]}; there are {', '.join(known)}")
    install(tuple(known[name] for name in sys.argv[1:]) or CONSUMERS)
