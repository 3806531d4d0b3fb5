# make demo | test | lint | build | stub | bench | asan | clean. Everything lives in .venv; nothing else is touched.
# PYTHON=python3.12 chooses the interpreter, CXX=clang++ the compiler.
PYTHON ?= python3
VENV ?= .venv
EXTRAS ?= video,dev
BIN := $(VENV)/bin
LOG := $(VENV)/log.txt
# other extras are another build
comma := ,
BUILT := $(VENV)/built-$(subst $(comma),-,$(EXTRAS))
NATIVE := $(wildcard flaprig/native/*.cpp flaprig/native/*.hpp flaprig/native/plugin/*)
export PIP_DISABLE_PIP_VERSION_CHECK := 1

# a stage says one line, and shows its output only when it fails: $(call stage,words,command)
stage = @printf '%s\n' '== $(1)'; \
	{ $(2); } > $(LOG) 2>&1 || { cat $(LOG); printf '%s\n' '== failed: $(1)' >&2; exit 1; }

.PHONY: demo test lint build stub bench asan clean
.DEFAULT_GOAL := demo

demo: build
	@printf '%s\n' '== demo: the rig in water, into demo_output/'
	@$(BIN)/python -m flaprig demo --out demo_output

test: lint
	@printf '%s\n' '== pytest'
	@$(BIN)/python -m pytest -n auto

lint: build
	$(call stage,ruff check,$(BIN)/ruff check .)
	$(call stage,mypy,$(BIN)/mypy)

build: $(BUILT)
	@:

# after a change of bindings.cpp: the types that mypy and editors see
stub: build
	$(call stage,flaprig/native/_native.pyi,$(BIN)/python -m nanobind.stubgen -q \
		-m flaprig.native._native -o flaprig/native/_native.pyi)

# with the peer beside the extras asked for
bench:
	@$(MAKE) --no-print-directory build EXTRAS=$(EXTRAS)$(if $(findstring bench,$(EXTRAS)),,$(comma)bench)
	@printf '%s\n' '== flaprig bench --all: some minutes, into docs/benchmarks.md'
	@$(BIN)/python -m flaprig bench --all
	@printf '%s\n' '== benchmarks/'
	@$(BIN)/python -m pytest benchmarks -o 'python_files=bench_*.py' -p no:xdist --benchmark-enable --benchmark-only
	@if $(BIN)/python -c 'import stable_baselines3' 2> /dev/null; then \
		$(BIN)/python benchmarks/bench_vector.py; \
	else echo 'benchmarks/bench_vector.py is left out: it needs the extra train'; fi

# perturbed states under the address sanitizer (gcc, Linux), in a build of its own
PERTURBATIONS ?= 100000
ASAN := build/asan
asan: build
	$(call stage,the compiled part with sanitizers,$(BIN)/cmake -S . -B $(ASAN) -G Ninja \
		-DCMAKE_MAKE_PROGRAM=$(abspath $(BIN)/ninja) -DFLAPRIG_SANITIZE=ON -DSKBUILD_STATE=editable \
		-DSKBUILD_PROJECT_VERSION=0 -DPython_EXECUTABLE=$(abspath $(BIN)/python) \
		-Dnanobind_DIR=$$($(BIN)/python -m nanobind --cmake_dir) && $(BIN)/cmake --build $(ASAN))
	@LD_PRELOAD=$$($${CXX:-c++} -print-file-name=libasan.so) ASAN_OPTIONS=detect_leaks=0 \
		$(BIN)/python tests/plugin/perturb.py $(PERTURBATIONS) $(ASAN)

clean:
	rm -rf $(VENV) build dist demo_output .mypy_cache .ruff_cache .pytest_cache .hypothesis .benchmarks

# the version check comes first: an older python3 may also fail to make the environment
$(BIN)/python:
	@command -v $(PYTHON) > /dev/null || \
		{ echo '$(PYTHON) was not found: install Python 3.11 or newer, or make PYTHON=...' >&2; exit 1; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
		{ echo "flaprig needs Python 3.11 or newer and $(PYTHON) is $$($(PYTHON) -V): make PYTHON=python3.11" >&2; exit 1; }
	@printf '%s\n' '== python environment in $(VENV)'
	@$(PYTHON) -m venv $(VENV) || { rm -rf $(VENV); exit 1; }

# an edit of Python needs no build (editable); one of C++ compiles that file (build/ is kept)
$(BUILT): pyproject.toml constraints.txt CMakeLists.txt $(wildcard cmake/*) $(NATIVE) | $(BIN)/python
	@for compiler in $${CXX:-c++ g++ clang++}; do command -v $$compiler > /dev/null && exit 0; done; \
		echo 'no C++ compiler was found: install g++ or clang++, or make CXX=...' >&2; exit 1
	$(call stage,build tools,$(BIN)/python -m pip install -q -c constraints.txt \
		scikit-build-core nanobind cmake ninja mujoco)
	$(call stage,flaprig and what it needs (C++ is compiled now),$(BIN)/python -m pip install -q \
		-c constraints.txt --no-build-isolation --editable '.[$(EXTRAS)]')
	@touch $@
