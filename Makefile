# Two commands that do everything on a fresh Debian 12: make demo, make test.
BUILD := build/release
NEPHROID := $(BUILD)/bin/nephroid

.PHONY: demo test program build deps asan tsan format check clean

demo: program
	@mkdir -p out
	$(NEPHROID) render scenes/coffee-cup/scene.pbrt -o out/coffee-cup.exr --time 90s
	@echo "The picture: $(CURDIR)/out/coffee-cup.png"

test: build check
	ctest --test-dir $(BUILD) --output-on-failure -j $$(nproc)

program: deps
	@cmake --preset release >/dev/null
	@cmake --build --preset release --target nephroid

build: deps
	@cmake --preset release >/dev/null
	@cmake --build --preset release

deps:
	@tools/install_deps

# What needs no build: layers, and documentation that is generated.
check:
	@python3 tools/check_layers.py

asan tsan: deps
	@cmake --preset $@ >/dev/null
	@cmake --build --preset $@
	ctest --test-dir build/$@ --output-on-failure -j $$(nproc)

format:
	clang-format -i $$(git ls-files '*.h' '*.cpp')

clean:
	rm -rf build out
