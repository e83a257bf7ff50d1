# Set-up and every check of the project. `make serve` and `make test` need only Python >= 3.11 and
# make; both install what they use into .venv, and install it again only where the pins changed.

VENV := .venv
PY := $(VENV)/bin/python
ADDRESS ?= 127.0.0.1
PORT ?= 5006
WORKERS ?= 2
PIP := $(PY) -m pip --disable-pip-version-check --no-input
COMPILE := uv pip compile --quiet --universal --python-version 3.11 --generate-hashes \
	--no-emit-index-url --no-emit-find-links --custom-compile-command "make lock"

# A worker of pytest that has no test left takes over tests of the other one.
PYTEST := OMP_NUM_THREADS=1 $(PY) -m pytest --numprocesses auto --dist worksteal
FIND_BROWSER := CHROMIUM="$$($(PY) -m tests.testing.browser)" && export CHROMIUM

.PHONY: help serve lab test long lint unit coverage newest bench screenshots lock audit clean
.DEFAULT_GOAL := help

help: ## this list
	@grep -E '^[a-z]+:.*## ' $(firstword $(MAKEFILE_LIST)) | sed 's/:.*## /\t/' | expand -t 14

serve: $(VENV)/serve.stamp ## serve the dashboard (ADDRESS, PORT)
	@PYTHON=$(PY) ADDRESS=$(ADDRESS) PORT=$(PORT) exec deploy/start.sh

lab: $(VENV)/serve.stamp ## serve a class: nginx before WORKERS workers (docs/deploy.md)
	@ADDRESS=$(ADDRESS) PORT=$(PORT) ROTORSTAB_WORKERS=$(WORKERS) exec $(PY) -m deploy.lab

test: lint ## every check, and all tests but the long ones, with a browser (found, or installed)
	@$(FIND_BROWSER) && $(PYTEST) -m "not long"

long: $(VENV)/dev.stamp ## the long tests: classes, killed processes, whole deployments (CI runs them too)
	@$(FIND_BROWSER) && $(PYTEST) -m long

lint: $(VENV)/dev.stamp ## style, types, import borders, Dockerfile, compose file, citation
	$(PY) -m ruff check
	$(PY) -m ruff format --check
	$(PY) -m mypy
	$(VENV)/bin/lint-imports
	$(VENV)/bin/hadolint Dockerfile
	$(VENV)/bin/check-jsonschema --builtin-schema vendor.compose-spec compose.yaml
	$(VENV)/bin/check-jsonschema --builtin-schema vendor.citation-file-format CITATION.cff

unit: $(VENV)/dev.stamp ## the tests of `make test` that need no browser
	$(PYTEST) -m "not browser and not long"

coverage: $(VENV)/dev.stamp ## lines and branches of the library that `make unit` reaches
	$(PYTEST) -m "not browser and not long" --cov --cov-report term --cov-report html:build/coverage

newest: ## a few browser tests on the newest Panel and Bokeh, in an environment of their own
	@.ci/newest

bench: $(VENV)/dev.stamp ## time the solver and the redraw
	$(PY) -m benchmarks

screenshots: $(VENV)/dev.stamp ## picture every page in build/screenshots, and the README's
	@$(FIND_BROWSER) && $(PY) -m docs.screenshots

lock: $(VENV)/serve.stamp ## pin all requirements anew, with hashes
	$(PIP) install --quiet uv
	$(VENV)/bin/$(COMPILE) --upgrade --extra app --extra dev --constraint requirements/pins.txt \
		--output-file requirements/dev.txt pyproject.toml requirements/build.in
	$(VENV)/bin/$(COMPILE) --upgrade --extra app --constraint requirements/dev.txt \
		--output-file requirements/serve.txt pyproject.toml requirements/build.in

audit: $(VENV)/dev.stamp ## known faults of what is served, where their database can be reached
	@$(PY) -m venv $(VENV)/audit
	@if $(VENV)/audit/bin/python -m pip --disable-pip-version-check --no-input install --quiet pip-audit; then \
		$(VENV)/audit/bin/python requirements/audit.py; \
	else echo "audit: pip-audit is not to be had; nothing was checked"; fi

clean: ## remove the environment and all caches
	rm -rf $(VENV) .mypy_cache .pytest_cache .ruff_cache .import_linter_cache .hypothesis dist build
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

$(PY):
	@python="$$(deploy/python.sh)" && "$$python" -m venv $(VENV)

$(VENV)/%.stamp: requirements/%.txt pyproject.toml | $(PY)
	$(PIP) install --quiet --require-hashes --requirement $<
	$(PIP) install --quiet --no-deps --no-build-isolation --editable .
	@touch $@
