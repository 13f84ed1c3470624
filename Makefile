# Two commands that do everything on a fresh Debian 12: make demo, make test.
BUILD := build/release
NEPHROID := $(BUILD)/bin/nephroid

.PHONY: demo test test-quick test-nightly test-blender test-view program build deps deps-clang clang sanitize asan tsan fuzz format check-format \
  check docs clean

demo: program
	@mkdir -p out
	$(NEPHROID) render scenes/coffee-cup/scene.pbrt -o out/coffee-cup.exr --time 90s
	@echo "The picture: $(CURDIR)/out/coffee-cup.png"

# Runs ctest with the options $(1), then prints the time of each suite beside its budget
# (docs/testing.md). The exit status is that of ctest; its output holds the times of all test cases.
define run_tests
@ctest --test-dir $(BUILD) --output-on-failure -j $$(nproc) $(1) --output-junit tests.xml \
  --test-output-size-passed 100000000 --test-output-size-failed 100000000; status=$$?; \
  tools/test_times $(BUILD)/tests.xml; exit $$status
endef

test: build check
	$(call run_tests)

# For the loop of edit and test: less than 90 seconds after the build, on two idle cores.
test-quick: build check
	$(call run_tests,-L quick)

# The suites that compare random estimates, with the seeds of today.
test-nightly: export NEPHROID_TEST_SEED ?= $(shell date +%Y%m%d)
test-nightly: build
	@echo "NEPHROID_TEST_SEED=$$NEPHROID_TEST_SEED"
	$(call run_tests,-L nightly)

# The Blender add-on beside Cycles, about three minutes. Pictures of both: out/blender/*.png. Not part of make test.
test-blender: program
	@tools/install_deps blender
	@mkdir -p out/blender
	@blender -b --factory-startup --python-exit-code 1 -P tests/blender/scenes.py -- out/blender >out/blender/scenes.log
	@blender -b --factory-startup --python-exit-code 1 -P tests/blender/run.py -- out/blender

# The page of the view in headless Chromium, against the program and against a stand-in. Screenshots: out/view. Not part of
# make test.
test-view: program
	@tools/install_deps view
	@tests/view/run $(NEPHROID) out/view

program: deps
	@cmake --preset release >/dev/null
	@cmake --build --preset release --target nephroid

build: deps
	@cmake --preset release >/dev/null
	@cmake --build --preset release

deps:
	@tools/install_deps

deps-clang:
	@tools/install_deps clang

# Layers, and the links and generated pages of the documentation. Needs no build.
check:
	@python3 tools/check_layers.py
	@python3 tools/check_docs.py
	@python3 tools/list_messages.py --check

# The documentation as a site, with a reference from the headers: build/site/index.html. Needs no build of the program.
docs:
	@tools/install_deps docs
	@sphinx-build -q -c docs/site docs build/site
	@doxygen docs/site/Doxyfile
	@echo "The documentation: $(CURDIR)/build/site/index.html, for developers: $(CURDIR)/build/site/reference/index.html"

# Compiles everything with clang, or the targets that CLANG_TARGETS names. Its warnings are errors, too; not optimised, with
# assertions. Runs only the program, for one small pass.
CLANG_TARGETS ?=
clang: deps-clang
	@cmake --preset clang >/dev/null
	@cmake --build --preset clang $(if $(CLANG_TARGETS),--target $(CLANG_TARGETS))
	build/clang/bin/nephroid render scenes/coffee-cup/scene.pbrt --passes 1 --resolution 60x40 --quiet --no-state \
	  -o build/clang/smoke.exr

# All tests (of those with most passes one in 24, the next ones with SHARD=1 ...) under address,
# undefined behaviour and thread sanitizers; or those that TESTS names ("unit_core unit_input").
SHARD ?= 0
TESTS ?=
empty :=
sanitize: asan tsan

asan tsan: deps
	@cmake --preset $@ -DNEPHROID_SANITIZED_SHARD=$(SHARD) >/dev/null
	@cmake --build --preset $@ $(if $(TESTS),--target $(TESTS:%=test_%))
	ctest --test-dir build/$@ --output-on-failure -j $$(nproc) \
	  $(if $(TESTS),-R '^($(subst $(empty) $(empty),|,$(strip $(TESTS))))$$')

# Each fuzzer for FUZZ_TIME seconds (docs/reliability.md), by clang. What they learn stays in
# build/fuzz/corpus, what they find in build/fuzz/found. OpenImageIO loses the text of an error of libpng.
FUZZ_TIME ?= 1200
FUZZ_TARGETS ?= scene ply obj gltf mitsuba serialized volume bsdf routes image environment nanovdb \
  checkpoint learned command view_request
fuzz: deps-clang
	@cmake --preset fuzz >/dev/null
	@cmake --build --preset fuzz
	@for target in $(FUZZ_TARGETS); do \
	  mkdir -p build/fuzz/corpus/$$target build/fuzz/found; \
	  dict=tests/fuzz/$$target.dict; \
	  case $$target in image|environment) leaks=0 ;; *) leaks=1 ;; esac; \
	  ASAN_OPTIONS=detect_leaks=$$leaks build/fuzz/bin/fuzz_$$target \
	    -max_total_time=$(FUZZ_TIME) -timeout=60 -rss_limit_mb=2048 -max_len=16384 \
	    $$(test -f $$dict && echo -dict=$$dict) \
	    -artifact_prefix=build/fuzz/found/$$target- \
	    -print_final_stats=1 build/fuzz/corpus/$$target tests/fuzz/corpus/$$target || exit 1; \
	done

format:
	@tools/install_deps checks
	@tools/format

check-format:
	@tools/install_deps checks
	@tools/format --check

clean:
	rm -rf build out
