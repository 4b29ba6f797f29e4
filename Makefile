# Everything a developer does; each target calls one tool. A fresh machine needs python3 (3.11 or newer), make and git.

PYTHON ?= python3
BIN := .venv/bin
INSTALLED := .venv/.installed

# the tests that coverage is measured with: quick ones that go through all rooms, few of them: measured code takes more than
# twice its time, and what runs in another process is not measured
COVERING := tests/regscribe/cli/test_commands.py tests/regscribe/breaking/test_facts.py tests/regscribe/emit/vectors/test_sound_maps.py \
	$(addprefix tests/regscribe/,source schema compose lower checks export importers language_server site map_format) \
	$(addprefix tests/runtime/,wire registers planning operations driver) \
	--ignore=tests/regscribe/language_server/test_stdio.py

# the tests of an installation that CI runs, 40 s; the others of that room take minutes
PACKAGING := $(addprefix tests/system/packaging/,test_user_repository.py test_published.py test_dockerfile.py)

# what needs no programs by others; and of that what takes no more than a few seconds
OURS := not wire and not interop and not browser and not editors
QUICK := not slow and $(OURS)

.DEFAULT_GOAL := generate
.PHONY: generate test test-all coverage test-wire test-interop test-browser test-editors test-versions test-packaging check lint drift types types-windows format bench site pictures conformance fuzz mutate sessions lock clean

generate: $(INSTALLED) ## compile all maps, write the manual pages; only what changed is written
	@$(BIN)/regscribe generate
	@$(BIN)/regscribe man -q -o generator/man

test: $(INSTALLED) ## run the tests
	$(BIN)/pytest -q -n 2 -m "$(QUICK)"

test-all: $(INSTALLED) ## run the tests, the slow ones too
	$(BIN)/pytest -q -n 2 -m "$(OURS)"

test-wire: $(INSTALLED) ## let clients by others talk to the simulated devices; installs them (Debian packages, npm)
	$(BIN)/python tests/system/independent_clients/install.py
	$(BIN)/pytest -q -n 8 -m wire tests/system/independent_clients

test-interop: $(INSTALLED) ## let the programs that exports are for read a simulated device; installs them (pip, npm, Debian packages)
	$(BIN)/python tests/system/interop/install.py
	$(BIN)/pytest -q -n 2 --dist loadfile -m interop tests/system/interop

test-browser: $(INSTALLED) ## let Chromium show the pages that are made; installs it (Debian package)
	$(BIN)/python tests/system/browser/install.py
	$(BIN)/pytest -q -n 2 -m browser tests/system/browser

test-editors: $(INSTALLED) ## build the extension for Visual Studio Code and let it talk to the language server (npm)
	$(BIN)/python tests/system/editors/install.py
	$(BIN)/pytest -q -n 2 -m editors tests/system/editors

test-packaging: $(INSTALLED) ## install the wheels as users do, and run the tests and type checkers of theirs (pip)
	$(BIN)/pytest -q -n 2 --dist loadfile -m "slow and $(OURS)" $(PACKAGING)

test-versions: ## run the tests of runtime and drivers with the oldest and newest pymodbus, on every Python that is here
	$(PYTHON) tests/repository/versions.py

coverage: $(INSTALLED) ## how much of generator/ the quick tests run, against the floor in pyproject.toml
	@$(BIN)/pytest -q -n 2 -m "$(QUICK)" --cov --cov-report= $(COVERING)
	@$(BIN)/coverage report --format=total
	@$(BIN)/coverage report >/dev/null

check: lint types types-windows drift coverage ## all that CI runs besides tests; --jobs=2 --output-sync for two at a time

lint: $(INSTALLED) ## rules and format of the code
	$(BIN)/ruff check
	$(BIN)/ruff format --check

drift: $(INSTALLED) ## whether maps are laid out alike, and what is generated is that of the maps and commands
	$(BIN)/regscribe fmt --check
	$(BIN)/regscribe generate --check
	$(BIN)/regscribe man -q -o generator/man && git diff --exit-code --stat generator/man

types: $(INSTALLED) ## types of code and generated drivers
	$(BIN)/mypy generator generated/regscribe_devices
	$(BIN)/pyright

types-windows: $(INSTALLED) ## the same, for Windows
	$(BIN)/mypy --platform win32 --cache-dir .mypy_cache/win32 generator generated/regscribe_devices
	$(BIN)/pyright --pythonplatform Windows

format: $(INSTALLED) ## format the code
	$(BIN)/ruff check --fix
	$(BIN)/ruff format

bench: $(INSTALLED) ## measure against the budgets and against other tools, side by side
	$(BIN)/python tests/system/bench/run.py

fuzz: $(INSTALLED) ## random maps in thousands (FUZZ_MAPS=..): drivers, reference, simulator, vectors, plans, generated tests and calculator must agree
	$(BIN)/pytest -q -m slow tests/conformance/test_differential.py \
		tests/conformance/test_plans.py tests/conformance/test_properties.py tests/conformance/test_browser_random.py

conformance: $(INSTALLED) ## what the language means, as bytes and values: the cases of tests/conformance, by everybody who is judged
	$(BIN)/pytest -q -n 2 -m "not slow" tests/conformance
	$(BIN)/pytest -q -m slow tests/conformance/test_matrix.py tests/conformance/test_matrix_keys.py tests/conformance/test_browser_mutants.py

mutate: $(INSTALLED) ## break scales, codes, addresses, orders and limits: the tests must notice each
	$(BIN)/python tests/system/mutate/run.py

MINUTES ?= 2
soak: $(INSTALLED) ## drive the drivers over bad lines for MINUTES=.. and report operations, faults, errors, wrong values
	@SOAK_MINUTES=$(MINUTES) $(BIN)/pytest -q tests/system/bad_lines/test_soak.py

site: $(INSTALLED) ## the pages of docs/, all references and the runtime's names as a site to search, in site/
	$(BIN)/regscribe site --docs . --api --title regscribe --out site

sessions: $(INSTALLED) ## carry out the sessions of docs/cli.md, settings.md and programs.md anew and write what they print
	$(BIN)/python tests/regscribe/cli/live/sessions.py

pictures: $(INSTALLED) ## draw the pictures of the README anew; Chromium as for `make test-browser`
	$(BIN)/python tests/system/browser/install.py
	$(BIN)/python -m tests.system.browser.pictures

lock: $(INSTALLED) ## pin the newest versions that requirements.in allows
	$(BIN)/pip install --quiet uv
	$(BIN)/uv pip compile --quiet --universal --upgrade --no-header --no-annotate --no-emit-index-url \
		--python-version 3.11 requirements.in --output-file requirements.lock

clean: ## remove the environment and all caches
	rm -rf .venv .cache .mypy_cache .ruff_cache .pytest_cache .hypothesis dist

$(INSTALLED): requirements.lock pyproject.toml generator/runtime/pyproject.toml generated/pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
		{ echo "regscribe needs Python 3.11 or newer; name one: make PYTHON=python3.12 ..." >&2; exit 1; }
	@$(PYTHON) -c 'import venv, ensurepip' 2>/dev/null || \
		{ echo "$(PYTHON) lacks venv or ensurepip; on Debian and Ubuntu: apt-get install python3-venv" >&2; exit 1; }
	@test -x $(BIN)/python || $(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --requirement requirements.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation \
		--editable generator/runtime --editable generated --editable .
	@$(BIN)/python -m compileall -q generator generated/regscribe_devices # where Python writes no bytecode, each start would compile
	@touch $@
