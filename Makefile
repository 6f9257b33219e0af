# Everything a newcomer needs is `make run` and `make test`; `make help` lists the rest. ARGS passes options on.
.DEFAULT_GOAL := help
SHELL := /bin/sh
BIN := .venv/bin
READY := .venv/.ready
PLATFORMS := x86_64-manylinux_2_28 aarch64-manylinux_2_28 x86_64-apple-darwin aarch64-apple-darwin x86_64-pc-windows-msvc
PACKAGES := comity domain executor fis sim2d

.PHONY: help run test check format bench oracle golden studies mutants tables integration platforms lowest clean

help: ## list what can be made
	@awk -F ':.*## ' '/^[a-z]+:.*## / {printf "  make %-11s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

# The first interpreter that runs and is new enough: a shim on the PATH may exist and not run.
$(READY): pyproject.toml
	@python=; for name in $(PYTHON) python3.13 python3.12 python3.11 python3; do \
	  if $$name -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then python=$$name; break; fi; \
	done; \
	if [ -z "$$python" ]; then \
	  echo "Comity needs Python 3.11 or newer, and none was found. Install one, or name it: make run PYTHON=/path/to/python3" >&2; exit 1; \
	fi; \
	echo "Installing Comity into .venv with $$($$python --version)"; \
	$$python -m venv --clear .venv || { echo "Python's venv module is missing: on Debian, install python3-venv." >&2; exit 1; }
	@# Older pip knows no dependency groups.
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --upgrade 'pip>=25.1'
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable . --group test
	@touch $(READY)

run: $(READY) ## run an episode, by default the visit to Johanna: make run ARGS="two-visits --as guest=german_man"
	@$(BIN)/comity run $(ARGS)

test: $(READY) ## run the tests, with a fixed sample of every study: make test ARGS="-k greeting"
	@$(BIN)/python -m pytest -n auto --dist worksteal -m "not study and not integration" $(ARGS)

integration: $(READY) ## run the tests that install or take away something: the wheel elsewhere on disk, Python without POSIX
	@$(BIN)/python -m pytest -m integration $(ARGS)

check: $(READY) ## read the code: ruff, mypy --strict, pyright, import contracts
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .
	@$(BIN)/mypy
	@$(BIN)/pyright --pythonpath $(BIN)/python
	@$(BIN)/lint-imports --no-cache

format: $(READY) ## put the code into the shape that `check` wants
	@$(BIN)/ruff check --fix-only --quiet .
	@$(BIN)/ruff format --quiet .

bench: $(READY) ## measure speed: ratios against other tools, as JSON and a table
	@$(BIN)/python -m tests.bench $(ARGS)

oracle: $(READY) ## compare 540 episodes with what they were before: other plans, other outcomes
	@$(BIN)/python -m tests.oracle $(ARGS)

golden: $(READY) ## write again how the scenarios move, after a change that means to alter it
	@$(BIN)/python -m tests.scenarios.golden

studies: $(READY) ## run the full numbers behind the tables in the docs, and many examples of costly laws
	@$(BIN)/python -m pytest -m "study or sampled" --hypothesis-profile study $(ARGS)

mutants: $(READY) ## change the software one small thing at a time; do the scenarios notice?
	@$(BIN)/python -m tests.mutants $(ARGS)

tables: $(READY) ## compute the tables of the metrics and of the model card in the docs again
	@$(BIN)/python -m tests.docs.test_metrics_page
	@$(BIN)/python -m tests.docs.test_model_card

platforms: $(READY) ## resolve Comity from wheels alone for each platform and Python that the docs name
	@for platform in $(PLATFORMS); do for python in 3.11 3.12 3.13 3.14; do echo $$platform $$python; done; done \
	  | xargs -n 2 -P 8 sh -c '$(BIN)/uv pip compile --quiet --only-binary :all: --python-platform $$0 --python-version $$1 \
	    pyproject.toml >/dev/null || { echo "no wheels for $$0 and Python $$1" >&2; exit 255; }'
	@echo "Wheels resolve for $(PLATFORMS), Python 3.11 to 3.14."

lowest: $(READY) ## play an episode and some tests with the lowest versions that pyproject.toml allows
	@$(BIN)/uv venv --quiet --clear --python $(BIN)/python .venv-lowest
	@$(BIN)/uv pip install --quiet --python .venv-lowest --resolution lowest-direct --editable . 'pytest>=8.3' 'hypothesis>=6.120'
	@cd "$$(mktemp -d)" && "$(CURDIR)/.venv-lowest/bin/comity" run johanna --gif
	@# The file that is left out reads trees back by a parser that is newer than what Comity needs of py_trees.
	@.venv-lowest/bin/python -m pytest -q -m "not study and not integration" tests/executor --ignore tests/executor/test_btcpp.py \
	  tests/platforms tests/fis/test_batch.py tests/fis/test_matlab_writer.py tests/domain/test_ties.py tests/domain/test_plan.py \
	  tests/comity/test_front_door.py tests/comity/test_store.py tests/comity/test_views.py

clean: ## remove the environment, caches and runs
	rm -rf .venv .venv-bench .venv-lowest runs build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis
