# make setup   what the others need, and each of them does by itself: packages, browser parts, case.schema.json
# make serve   the site with live reload at http://localhost:8000, or another PORT=8010
# make test    every test; sets everything up by itself
# make site    builds site/ strictly
# make bench   how long a build takes, cold and warm, and its parts, how soon a page is there; the table goes into *Work on the code*
# make growth  how the site grows to 1,000 cases; the table goes into *Work on the code*
# make releases   what every release of MuJoCo does with the cases that have changed, or with all by ALL=1, and which messages read otherwise; writes the two locks
# make lint    style, types, order of the storeys, spelling
# make healthy   the robots of other people's packages on which the rules of `clinic diagnose` are measured
# make lock    renews requirements.txt, requirements-parity.txt and requirements-healthy.txt
# make audit   asks the registries for known holes in what is locked
# make clean   forgets everything built

SHELL := /bin/bash
VENV := .venv
BIN := $(VENV)/bin
HEALTHY := .cache/healthy
export MUJOCO_GL ?= egl
# MkDocs' and Material's notices about the end of their lines: docs/contribute/work-on-the-code.md says what the way out is.
export NO_MKDOCS_2_WARNING := 1
export DISABLE_MKDOCS_2_WARNING := true
# Compiled modules are kept, whatever is usual here: each of a hundred processes would compile them again.
unexport PYTHONDONTWRITEBYTECODE

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.PHONY: help setup serve site test bench growth releases healthy lint lock audit clean

help:
	@sed -n 's/^# make/make/p' Makefile

setup: $(VENV)/.ready case.schema.json

$(VENV)/.ready: requirements.txt requirements-parity.txt pyproject.toml package-lock.json scripts/setup.sh
	@bash scripts/setup.sh $(VENV)
	@touch $@

# What an editor asks while a record is typed; see the first line of a new case.
case.schema.json: $(VENV)/.ready $(wildcard scripts/clinic/record/*.py) scripts/clinic/pages/schema.py
	@$(BIN)/clinic schema > $@

serve: setup
	$(BIN)/mkdocs serve --livereload --dirty --dev-addr localhost:$(or $(PORT),8000)

site: setup
	$(BIN)/mkdocs build --strict

test: setup healthy
	-@$(BIN)/clinic build --out .cache/pages >/dev/null  # every run that the tests read, made once
	$(BIN)/pytest -n auto --dist loadgroup

healthy: $(HEALTHY)/.ready

$(HEALTHY)/.ready: requirements-healthy.txt | $(VENV)/.ready
	@rm -rf $(HEALTHY)
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes --no-deps --target $(HEALTHY) -r $<
	@touch $@

bench: setup
	$(BIN)/python scripts/bench.py --tests --write

growth: setup
	$(BIN)/python scripts/growth.py --write

releases: setup
	$(BIN)/python -m clinic.commands.releases $(if $(ALL),--all)

lint: setup
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports --no-logo
	$(BIN)/codespell README.md CONTRIBUTING.md CHANGELOG.md cases docs scripts
	PATH="$(CURDIR)/$(BIN):$$PATH" npx --no-install tsc -b docs/playground

lock: setup
	$(BIN)/uv pip compile pyproject.toml --extra dev --universal --python-version 3.11 --generate-hashes \
	  --no-emit-index-url --no-emit-find-links --custom-compile-command "make lock" --upgrade --quiet --output-file requirements.txt
	sed -n 's/.*"@mujoco\/mujoco": "\(.*\)".*/mujoco==\1/p' package.json | $(BIN)/uv pip compile - --universal --python-version 3.11 \
	  --no-deps --generate-hashes --no-emit-index-url --no-emit-find-links --custom-compile-command "make lock" \
	  --upgrade --quiet --output-file requirements-parity.txt
	printf '%s\n' dm-control gymnasium gymnasium-robotics cloudpickle farama-notifications imageio typing-extensions glfw | $(BIN)/uv pip compile - --universal --python-version 3.11 \
	  --no-deps --generate-hashes --no-emit-index-url --no-emit-find-links --custom-compile-command "make lock" \
	  --upgrade --quiet --output-file requirements-healthy.txt

audit: setup
	$(BIN)/uv tool run pip-audit --strict --require-hashes --disable-pip -r requirements.txt
	$(BIN)/uv tool run pip-audit --strict --require-hashes --disable-pip -r requirements-parity.txt
	$(BIN)/uv tool run pip-audit --strict --require-hashes --disable-pip -r requirements-healthy.txt
	PATH="$(CURDIR)/$(BIN):$$PATH" npm audit

clean:
	rm -rf site .cache case.schema.json node_modules $(VENV)
