# The two commands a newcomer needs are `make demo` and `make test`; the rest is for development.
PRESET ?= release
JOBS ?= $(shell nproc 2>/dev/null || echo 2)

FUZZ_SECONDS ?= 60
.PHONY: build demo test test-release test-sanitized test-sanitized-all fuzz test-campus bench bench-perceive ablation models wall-pictures tidy coverage packages deb docs format format-check clean

build: packages
	cmake --preset $(PRESET)
	cmake --build --preset $(PRESET) -j $(JOBS) --target gramap_command documents

demo: build
	examples/demo

test: packages test-release test-sanitized

test-release:
	cmake --preset release
	cmake --build --preset release -j $(JOBS)
	ctest --preset release

# Tests of the language and of the exact geometry under the address and undefined-behaviour sanitizers.
SANITIZED = test_geometry test_grammar_language
test-sanitized:
	cmake --preset asan-ubsan
	cmake --build --preset asan-ubsan -j $(JOBS) --target $(SANITIZED)
	ctest --preset asan-ubsan -R '^(test_geometry|test_grammar_language)$$'

# The same for every test, and whether that build type writes the same bytes as the other: an hour.
test-sanitized-all: build
	cmake --preset asan-ubsan
	cmake --build --preset asan-ubsan -j $(JOBS)
	ctest --preset asan-ubsan
	tests/app/same-bytes $(CURDIR) $(CURDIR)/build/gramap $(CURDIR)/build/asan-ubsan/gramap

# Every fuzzer for FUZZ_SECONDS, two at a time, and a row for each; what they find lies in build/fuzz/fuzz/NAME/.
fuzz: packages
	scripts/install-packages packages-fuzz.txt
	cmake --preset fuzz -DGRAMAP_FUZZ_SECONDS=$(FUZZ_SECONDS)
	cmake --build --preset fuzz -j $(JOBS) --target fuzzers
	ctest --preset fuzz && tests/fuzz/report build/fuzz

# examples/campus under Snakemake: killed half-way and resumed, it must give the bytes of an uninterrupted run.
test-campus: build
	scripts/install-packages packages-campus.txt
	tests/campus/run $(CURDIR)/build/gramap $(CURDIR)/build/tests/campus

# Every stage over a ladder of sizes: a Markdown table, to be compared with tests/bench/compare. On a quiet machine.
bench: build
	cmake --build --preset $(PRESET) -j $(JOBS) --target bench_measure
	tests/bench/table build | tee build/bench.md

# The forests that ship (models/README.md), made again: the same bytes as long as nothing changes that they are made from.
models: build
	build/gramap train openings --buildings 60 -o models/openings.forest
	build/gramap train furniture --buildings 60 -o models/furniture.forest

# How much worse doors, windows and furniture are found without one thing or another.
ablation: build
	build/gramap train openings --buildings 24 --ablation
	build/gramap train furniture --buildings 24 --ablation

# Time of perception stage by stage: a furnished room, a hallway with doors and windows.
bench-perceive: build
	cmake --build --preset $(PRESET) -j $(JOBS) --target bench_perceive
	build/tests/bench/bench_perceive

# docs/walls, from the scans of the institute's first floor.
FLOOR ?= ../shared/data/institute-1og
wall-pictures: build
	rm -rf build/walls && build/gramap perceive $(FLOOR)/scans/201 $(FLOOR)/scans/220 --wall-images build/walls -o build/walls
	cp build/walls/201_wall2.png docs/walls/windows.png
	cp build/walls/220_wall0.png docs/walls/hallway.png
	cp build/walls/201_wall3.png docs/walls/cupboard.png

# clang-tidy over all sources (.clang-tidy says what); what it finds is an error. Stopped, it goes on where it was.
tidy: packages
	scripts/install-packages packages-tidy.txt
	cmake --preset tidy
	cmake --build --preset tidy -j $(JOBS) -- -k 0

# The share of lines of gramap that the tests run.
coverage: packages
	scripts/install-packages packages-coverage.txt
	cmake --preset coverage
	cmake --build --preset coverage -j $(JOBS)
	ctest --preset coverage
	gcovr --root . --filter 'geometry/' --filter 'grammar/' --filter 'perception/' --filter 'floor/' --filter 'app/' build/coverage --print-summary

packages:
	scripts/install-packages

# docs/verbs, from the options as they are declared.
docs: packages
	cmake --preset $(PRESET)
	cmake --build --preset $(PRESET) -j $(JOBS) --target documents
	rm -rf docs/verbs && cp -r build/documents/verbs docs/verbs

# The Debian packages, in build/: gramap_*.deb (the command) and libgramap-dev_*.deb (for find_package(gramap)).
deb: packages
	scripts/install-packages packages-deb.txt
	cmake --preset package
	cmake --build --preset package -j $(JOBS)
	cd build/package && cpack -B .. && rm -rf ../_CPack_Packages
	ls -l build/*.deb

format:
	git ls-files '*.h' '*.cpp' | xargs clang-format -i

format-check:
	git ls-files '*.h' '*.cpp' | xargs clang-format --dry-run --Werror

clean:
	rm -rf build
