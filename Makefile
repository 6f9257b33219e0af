# Everything a newcomer needs is `make run` and `make test`; `make help` lists the rest. ARGS passes options on.
.DEFAULT_GOAL := help
SHELL := /bin/sh
BIN := .venv/bin
READY := .venv/.ready
PACKAGES := comity domain executor fis sim2d

.PHONY: help run test check format bench oracle golden studies mutants card clean

help: ## list what can be made
	@awk -F ':.*## ' '/^[a-z]+:.*## / {printf "  make %-9s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

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
	@$(BIN)/python -m pytest -n auto -m "not study" $(ARGS)

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

studies: $(READY) ## run the full numbers behind the tables in the docs
	@$(BIN)/python -m pytest -m study $(ARGS)

mutants: $(READY) ## change the software one small thing at a time; do the scenarios notice?
	@$(BIN)/python -m tests.mutants $(ARGS)

card: $(READY) ## compute the model card's tables anew
	@$(BIN)/python tests/docs/test_model_card.py

clean: ## remove the environment, caches and runs
	rm -rf .venv .venv-bench runs build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis
