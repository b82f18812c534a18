# Short names for what one does here.  The build itself is CMake's: see CMakePresets.json for the presets.
.DEFAULT_GOAL := help
.PHONY: help build all test run bench validate format format-check check manual install package sanitize clean

jobs    := $(shell nproc)
sources := find src tests bench examples -name '*.[ch]pp'

configure = cmake --preset $(1) --log-level=WARNING >/dev/null
compile   = cmake --build --preset $(1) --parallel $(jobs)

help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' Makefile | expand -t 16

build: ## the program, build/livebed
	@tools/install-dependencies build
	@$(call configure,release)
	@$(call compile,release) --target livebed

all: ## the program, its tests and its benchmarks
	@tools/install-dependencies test
	@$(call configure,release)
	@$(call compile,release)

test: ## all tests
	@./test

run: ## the paper's case and its report
	@./run

bench: all ## the speed of flow and grains, then of the kernels
	@build/livebed bench flow
	@build/livebed bench grains
	@for program in build/bench_*; do [ ! -x $$program ] || $$program || exit 1; done

validate: all ## the comparisons with known solutions
	@ctest --preset release --output-on-failure -R '^verification\.'

check: format-check ## what .ci/run checks without compiling
	@tools/check-includes

format: ## let clang-format rewrite the sources
	@$(sources) -exec clang-format -i {} +

format-check: ## are the sources formatted?
	@$(sources) -exec clang-format --dry-run --Werror {} +

manual: ## the manual, build/manual/index.html
	@tools/make-manual

PREFIX ?= /usr/local
install: build ## into PREFIX=/usr/local: program, cases, man page, completions, Python reader, libraries
	@$(call compile,release) --target livebed_printed
	@cmake --install build --prefix $(DESTDIR)$(PREFIX)

# A folder of its own: the packages are for other machines than this one.
package: ## build-package/livebed_*.deb and livebed-dev_*.deb, for Debian 12 on x86-64-v2
	@tools/install-dependencies package
	@cmake --preset package --log-level=WARNING >/dev/null
	@cmake --build --preset package --parallel $(jobs)
	@cd build-package && cpack --config CPackConfig.cmake

sanitize: ## all tests under the address and undefined-behaviour sanitizers
	@tools/install-dependencies test
	@$(call configure,sanitizers)
	@$(call compile,sanitizers)
	@ctest --preset sanitizers -j2

clean: ## remove the build folders of the presets
	@rm -rf build build-debug build-sanitizers build-clang build-package
