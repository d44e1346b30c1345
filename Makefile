# make figures   set up a local environment and run the campaign: every table and figure, in results/
# make test      set up and pass the tests that say in minutes whether everything works
# make test-all  pass all others: the paper's campaign, every scene and fault, and what needs Debian's chromium,
#                chromium-driver (the pages in a browser), slurm-wlm and munge (the campaign on a cluster of one node)
# make check     formatting, lint, types, workflow lint
# make bench     time scenes in-process, the campaign against its floor, and planning; writes the tables of the pages
# make accuracy  measure accuracy against cost, in about an hour; writes the pages on it
# make stability run the matrix of extremes and draw its map; writes the page on it
# make report    gather every figure and table with its caption in one page, results/report.html
# make docs      write config/README.md, the schema of the config and the picture of the architecture anew
# make site      build the documentation into build/site, offline: it runs every example and checks every link
# make clean     remove results; make distclean removes the environment too

PYTHON ?= python3
VENV ?= .venv
JOBS ?= 2
CONFIG ?=

export PATH := $(abspath $(VENV))/bin:$(PATH)
unexport PYTHONPATH

.PHONY: figures report test test-all check docs bench accuracy stability site format clean distclean

figures: $(VENV)/.ready
	snakemake -j$(JOBS) $(if $(CONFIG),--configfile $(CONFIG))

# Snakemake's report runs nothing: it shows what there is, of accuracy and stability too.
report: figures
	snakemake everything $(if $(CONFIG),--configfile $(CONFIG)) --report "$$(python -c \
		'import sys; from rubfric.config.campaign import load; print(load(*sys.argv[1:]).results)' \
		config/config.yaml $(CONFIG))/report.html"

docs: $(VENV)/.ready
	python -m rubfric.config.page
	python tools/architecture.py

test: $(VENV)/.ready
	python -m pytest -n $(JOBS)

test-all: $(VENV)/.ready
	python -m pytest -n $(JOBS) -m thorough

check: $(VENV)/.ready
	ruff check .
	ruff format --check .
	lint-imports --no-cache
	mypy
	MYPYPATH=tests/support mypy tests/cluster tests/support/on_cluster.py
	snakefmt --check Snakefile workflow
	snakemake --lint

bench: $(VENV)/.ready
	python tools/benchmark/scenes.py
	python tools/benchmark/campaign.py
	python tools/benchmark/transient.py
	python tools/benchmark/dag.py
	python tools/benchmark/contact.py

accuracy: $(VENV)/.ready
	snakemake -j$(JOBS) accuracy
	python tools/benchmark/accuracy.py

stability: $(VENV)/.ready
	snakemake -j$(JOBS) stability
	python tools/benchmark/stability.py

site: $(VENV)/.ready
	sphinx-build -q -W -n --keep-going -j $(JOBS) -d build/doctrees docs build/site
	python tools/site/check.py build/site

format: $(VENV)/.ready
	ruff check --fix .
	ruff format .
	snakefmt Snakefile workflow

clean:
	rm -rf results .snakemake

distclean: clean
	rm -rf $(VENV) build docs/gallery docs/tutorials examples/*/results *.egg-info .pytest_cache .mypy_cache .ruff_cache

$(VENV)/.ready: environment.txt pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "rubfric needs Python 3.11 or later; this is %s. Set PYTHON=..." % sys.version.split()[0])'
	$(PYTHON) -m venv $(VENV)
	$(VENV)/bin/python -m pip install --quiet --disable-pip-version-check -r environment.txt
	$(VENV)/bin/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --editable .
	@touch $@
