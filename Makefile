# Everything from a fresh clone: each target sets up .venv and builds the kernel into it as far as that is not done.
# Nothing is installed outside this directory. Needs Python >= 3.11, a Rust toolchain and a C compiler, which links; says
# so where they are missing.

VENV := .venv
BENCH_VENV := .venv-bench
AUDIT_VENV := .venv-audit
PYTHON := $(VENV)/bin/python
RUST_SOURCES := Cargo.toml Cargo.lock $(shell find crates -name '*.rs' -o -name Cargo.toml)
DATA := $(shell find data -type f)
WEB_KERNEL := python/seismass/show/explore/seismass_web.wasm

export PATH := $(PATH):$(HOME)/.cargo/bin
export PIP_DISABLE_PIP_VERSION_CHECK := 1
export PIP_NO_INPUT := 1
export MPLBACKEND := Agg
export MPLCONFIGDIR := $(abspath $(VENV))/matplotlib

.PHONY: study explorer test test-all other-kernels unit-tests checks rust-tests lint lint-quick test-rust test-rust-quick \
	test-python test-python-quick test-wheel docs build web-kernel mutants bench bench-kernel count-instructions stress \
	stress-general stress-plane fuzz audit audit-packages wheels test-aarch64 clean

study: build
	$(VENV)/bin/seismass study --effective --sensitivity --out out/study

# The live page: out/explorer.html. Needs Rust's standard library for WebAssembly, or its sources, and says so.
explorer: build $(WEB_KERNEL)
	@mkdir -p out
	$(VENV)/bin/seismass explore --out out/explorer.html

# What to run at every change, in minutes.
test:
	@$(MAKE) --no-print-directory --jobs 2 build unit-tests
	@$(MAKE) --no-print-directory lint-quick
	@$(MAKE) --no-print-directory test-rust-quick
	@$(MAKE) --no-print-directory test-python-quick
	@echo "The quick checks have passed. make test-all adds clippy, doctests, the documentation, the wheel, pages in a browser,"
	@echo "the live page, more random scenes and the tests of tests/slow.txt; continuous integration runs it."

# Everything, as continuous integration runs it. What compiles for minutes on one core has something else beside it.
test-all:
	@$(MAKE) --no-print-directory --jobs 2 build other-kernels
	@$(MAKE) --no-print-directory --jobs 2 checks rust-tests
	@$(MAKE) --no-print-directory test-rust
	@$(MAKE) --no-print-directory test-python

other-kernels:
	@$(MAKE) --no-print-directory web-kernel
	@$(MAKE) --no-print-directory unit-tests

unit-tests:
	$(UNIT_TESTS) --no-run

checks:
	@$(MAKE) --no-print-directory lint
	@$(MAKE) --no-print-directory docs
	@$(MAKE) --no-print-directory test-wheel

rust-tests: build
	$(SHARED_RUST) --no-run --test '*' --examples
	$(SHARED_RUST) --no-run --exclude seismass --lib --bins

# Options other than --quick choose contestants or scenes of work_precision.py, which runs alone and writes nothing.
bench: build $(BENCH_VENV)/made
ifeq ($(filter-out --quick,$(BENCH_OPTIONS)),)
	$(BENCH_VENV)/bin/python benchmarks/study.py $(BENCH_OPTIONS)
	$(BENCH_VENV)/bin/python benchmarks/performance.py $(BENCH_OPTIONS)
	$(PYTHON) benchmarks/effective_mass.py --map
	$(BENCH_VENV)/bin/python benchmarks/campaign.py --write docs/scale.md
	$(BENCH_VENV)/bin/python benchmarks/spring_loops.py
	$(BENCH_VENV)/bin/python benchmarks/general_engine.py --write .
	[ -z "$$SEISMASS_SHARED" ] || $(BENCH_VENV)/bin/python benchmarks/sliding_base.py --write .
	$(PYTHON) tools/pages spring_loops
	[ -z "$$SEISMASS_SHARED" ] || $(BENCH_VENV)/bin/python benchmarks/ground_motions.py $(BENCH_OPTIONS)
	[ -z "$$SEISMASS_SHARED" ] || $(BENCH_VENV)/bin/python benchmarks/matching.py $(BENCH_OPTIONS)
	[ -z "$$SEISMASS_SHARED" ] || $(BENCH_VENV)/bin/python benchmarks/validation.py
	[ -z "$$SEISMASS_SHARED" ] || $(PYTHON) tools/pages validation
endif
	$(BENCH_VENV)/bin/python benchmarks/work_precision.py $(BENCH_OPTIONS)

# Wall times of the kernel alone; BENCH_OPTIONS goes to divan (a filter, --sample-count).
bench-kernel:
	cargo bench --locked -p seismass-bench --bench kernel -- $(BENCH_OPTIONS)

# Instructions beside those last recorded in benchmarks/results/instructions.csv: fails where one grew by more than 1 %.
# LABEL="what changed" records them there instead; BENCH_OPTIONS goes to benchmarks/instructions.py (--all, --tolerance).
count-instructions: build
	$(PYTHON) benchmarks/instructions.py $(if $(LABEL),--label "$(LABEL)") $(BENCH_OPTIONS)

# Mutated input files of every kind; FUZZ_COUNT files of each program, FUZZ_SEED chooses others. Files behind defects are
# kept in target/fuzz.
FUZZ_COUNT := 20000
FUZZ_SEED := 1
fuzz: build
	$(PYTHON) tools/fuzz_records.py --count $(FUZZ_COUNT) --seed $(FUZZ_SEED) --keep target/fuzz/records
	$(PYTHON) tools/fuzz_inputs.py --count $(FUZZ_COUNT) --seed $(FUZZ_SEED) --keep target/fuzz/inputs

# Crates and packages against the advisories that are published, their licences and where they come from (deny.toml). Asks the
# services that publish them: RustSec's repository, and PyPI's for packages. Needs cargo-deny, and says so.
audit: audit-packages
	@cargo deny --version >/dev/null || { echo "make audit needs cargo-deny: cargo install --locked cargo-deny" >&2; exit 1; }
	cargo deny --locked check

# Every package of .venv, pinned as it is there; one of which nothing is known is an error.
audit-packages: build $(AUDIT_VENV)/made
	$(PYTHON) -m pip list --format=freeze --exclude-editable --exclude seismass > $(AUDIT_VENV)/packages.txt
	$(AUDIT_VENV)/bin/pip-audit --strict --no-deps --disable-pip --requirement $(AUDIT_VENV)/packages.txt

# A run that was stopped goes on from target/stress/tally.tsv, where failing seeds are kept; a changed kernel or judge does
# not, until the tally is removed.
stress:
	cargo run --locked --release -p seismass-judge --bin stress -- --scenes 1000000 --judged 10000 --write docs/stress.md

# The same for the general engine; its tally is target/stress/general.tsv.
stress-general:
	cargo run --locked --release -p seismass-judge --bin stress_general -- --scenes 100000 --judged 2000 --write docs/stress_general.md

# The same in two directions; its tallies are target/stress/twins.tsv, of equal goods that start within 1e-8 s of each other,
# and plane.tsv.
stress-plane:
	cargo run --locked --release -p seismass-judge --bin stress_general -- --twins --scenes 10000 --judged 500
	cargo run --locked --release -p seismass-judge --bin stress_general -- --plane --scenes 100000 --judged 2200 \
		--write docs/stress_plane.md

# Faults planted one at a time in a copy of the tree, and what the tests see of them; MUTANTS_OPTIONS goes to
# tools/mutants.py (--full asks every test, --only chooses faults). Hours of processor time.
MUTANTS_OPTIONS := --generated 60 --generated-rust 60 --write docs/mutants.md
mutants: build
	$(PYTHON) tools/mutants.py $(MUTANTS_OPTIONS)

lint-quick: build
	@cargo fmt --version >/dev/null || \
		{ echo "make test needs rustfmt: rustup component add rustfmt" >&2; exit 1; }
	cargo fmt --all --check
	$(PYTHON) -m ruff check .
	$(PYTHON) -m ruff format --check .
	$(VENV)/bin/lint-imports --no-cache
	$(PYTHON) -m mypy

lint: lint-quick
	@cargo clippy --version >/dev/null || \
		{ echo "make lint and make test-all need clippy: rustup component add clippy" >&2; exit 1; }
	cargo clippy --locked --workspace --all-targets --features seismass/serde -- -D warnings
	# Alone, and thus without the kernel's feature tall-buildings, as it is compiled for the live page.
	cargo clippy --locked -p seismass-web -- -D warnings
	$(PYTHON) tools/make_stubs.py --check
	$(PYTHON) -m mypy.stubtest seismass._kernel --mypy-config-file pyproject.toml

# Integration tests share the kernel that is compiled for the extension: its profile, and the same packages, so that crates
# have the same features. Benchmarks hold no tests. The kernel's unit tests compile it once more, in a profile that compiles
# quickly, and with its feature serde, whose tests are among them.
SHARED_RUST := cargo test --locked --workspace --exclude seismass-bench --release
UNIT_TESTS := cargo test --locked -p seismass --lib --features serde

test-rust: build
	$(SHARED_RUST) --test '*' --examples
	$(SHARED_RUST) --exclude seismass --lib --bins
	$(UNIT_TESTS)
	$(SHARED_RUST) --doc

# Fewer random scenes, with the same checks of each.
test-rust-quick: build
	SEISMASS_STRESS_SCENES=300 SEISMASS_JUDGE_SCENES=20 $(SHARED_RUST) --test '*'
	$(SHARED_RUST) --exclude seismass --lib --bins
	$(UNIT_TESTS)

# Two processes, a file's tests in one of them: they share its fixtures.
PYTEST := $(PYTHON) -m pytest --numprocesses 2 --dist loadfile

test-python: build $(VENV)/browser web-kernel
	$(PYTEST)

test-python-quick: build
	$(PYTEST) -m "not slow" --ignore tests/browser

test-wheel: build web-kernel
	sh tools/check-wheel $(PYTHON)

# Wheels for Linux on x86-64 and aarch64 in dist, from either. Needs Rust's standard library for both, and says so.
wheels: build web-kernel
	$(PYTHON) -m pip install --quiet --group wheels
	env -u CONDA_PREFIX VIRTUAL_ENV="$(abspath $(VENV))" PATH="$(abspath $(VENV))/bin:$$PATH" sh tools/make-wheels $(PYTHON) dist

# The kernel's tests on an emulated aarch64; a quarter of an hour. Needs qemu-user and Rust's standard library for it.
test-aarch64:
	sh tools/test-aarch64

# The documentation site in out/site: pages, reference, examples that run, rustdoc. Warnings and broken links are errors.
docs: build web-kernel $(VENV)/site
	RUSTDOCFLAGS="-D warnings" cargo doc --locked --workspace --no-deps --features seismass/serde
	sh tools/make-site $(PYTHON) out/site

clean:
	cargo clean
	rm -rf $(VENV) $(BENCH_VENV) $(AUDIT_VENV) out dist python/seismass/data .pytest_cache .mypy_cache .ruff_cache .hypothesis
	rm -f python/seismass/_kernel*.so python/seismass/_kernel*.pyd $(WEB_KERNEL)
	find python tests -name __pycache__ -type d -prune -exec rm -rf {} +

build: $(VENV)/built

$(VENV)/created: tools/find-python
	@python=$$(sh tools/find-python) && echo "using $$($$python --version), $$python" && $$python -m venv --clear $(VENV)
	@touch $@

$(VENV)/installed: $(VENV)/created pyproject.toml
	$(PYTHON) -m pip install --quiet --upgrade 'pip>=25.1'
	$(PYTHON) -m pip install --quiet --group dev
	@touch $@

$(WEB_KERNEL): $(RUST_SOURCES) tools/make-web-kernel tools/reproducible-flags
	sh tools/make-web-kernel

# The same where a toolchain can; elsewhere the tests of the live page are skipped with a word.
web-kernel:
	@if sh tools/make-web-kernel --check 2>/dev/null; then $(MAKE) --no-print-directory $(WEB_KERNEL); \
		else echo "no toolchain for WebAssembly (make explorer says what is missing): the live page is not tested" >&2; fi

# Without it, or without a Chromium on the path, the tests that open pages are skipped with a word.
$(VENV)/browser: $(VENV)/installed
	@$(PYTHON) -m pip install --quiet --group browser && touch $@ || echo "no Playwright: pages are not opened" >&2

$(VENV)/site: $(VENV)/installed pyproject.toml
	@$(PYTHON) -m pip install --quiet --group docs
	@touch $@

$(BENCH_VENV)/made: tools/find-python tools/make-bench-env benchmarks/requirements.txt
	sh tools/make-bench-env $(BENCH_VENV)
	@touch $@

$(AUDIT_VENV)/made: $(VENV)/installed
	$(PYTHON) -m venv --clear $(AUDIT_VENV)
	$(AUDIT_VENV)/bin/python -m pip install --quiet --upgrade 'pip>=25.1'
	$(AUDIT_VENV)/bin/python -m pip install --quiet --group audit
	@touch $@

# Python sources are used in place (an editable install), so that only Rust, the metadata or the data need a new build.
$(VENV)/built: $(VENV)/installed $(RUST_SOURCES) $(DATA) packaging/README.md
	@echo "compiling the kernel: some minutes on two cores, and once for as long as it is not changed"
	env -u CONDA_PREFIX VIRTUAL_ENV="$(abspath $(VENV))" $(PYTHON) -m maturin develop --release --locked
	@touch $@
