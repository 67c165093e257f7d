# `make` builds build/brume. `make demo` and `make test` need nothing but git
# and make on a fresh Debian 12: .ci/setup installs the rest for them.
# Settings stand on the command line or in config.mak, which git ignores.
-include config.mak
PREFIX  ?= /usr/local
DESTDIR ?=
CC      ?= cc
CXX     ?= c++
NVCC    ?= nvcc
CUDA    ?= $(if $(shell command -v $(NVCC) 2>/dev/null),1,0)
# The GPU at hand; without one, code that any from sm_75 on can translate.
CUDA_ARCH ?= $(if $(shell command -v nvidia-smi 2>/dev/null),native,sm_75)
SAN     ?= 0
FUZZ    ?= 0
WERROR  ?= 1
V       ?= 0

# ---- compilers and libraries

B       := build
OPT     := -O2 -g
# The sanitizers have a folder of their own, so that both builds can stay.
ifeq ($(SAN),1)
B       := build/san
OPT     := -O1 -g -fsanitize=address,undefined -fno-omit-frame-pointer \
           -fno-sanitize-recover=undefined -DBRUME_FENCE
endif
# What is fuzzed tells which of its branches were taken; clang alone can.
# What it compares is not told: the dictionaries do better, and it takes longer
# than all the rest.
ifeq ($(FUZZ),1)
B       := build/fuzz
CC      := clang
CXX     := clang++
OPT     := -O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined \
           -fsanitize=float-cast-overflow -fno-sanitize-recover=all \
           -fsanitize-coverage=inline-8bit-counters,pc-table -DBRUME_FENCE
endif
WARN    := -Wall -Wextra -Wpedantic -Wvla $(if $(filter 1,$(WERROR)),-Werror)
# The bytes of a picture must not depend on the processor: no contraction of
# a * b + c into one rounding, no fast-math.
COMMON  := $(OPT) -ffp-contract=off -fvisibility=hidden -pthread $(WARN)
C       := $(CC) -std=c11 $(COMMON) -Wmissing-prototypes -Wstrict-prototypes
CPP     := $(CXX) -std=c++17 $(COMMON)
CU      := $(NVCC) -std=c++17 -O2 -diag-suppress 177,550 $(if $(filter 1,$(WERROR)),-Werror all-warnings) -fmad=false -arch=$(CUDA_ARCH)

PACKAGES := OpenEXR libpng libjpeg jansson freetype2 zlib
CPPFLAGS += -I. -I$(B) -D_GNU_SOURCE
C       += $(shell pkg-config --cflags $(PACKAGES) 2>/dev/null)
CPP     += $(shell pkg-config --cflags $(PACKAGES) 2>/dev/null)
# Nor for giflib.
OTHER_LIBS := -lgif -lm -pthread
LIBS     = $(shell pkg-config --libs $(PACKAGES) 2>/dev/null) $(OTHER_LIBS)
# What lib/vdb_module.cc uses; Debian has no .pc file for OpenVDB.
VDB_LIBS := -lopenvdb -ltbb -lblosc
# The folders in which a program finds that module: an RPATH, as a RUNPATH does
# not hold where the sanitizer calls dlopen for it.
rpath    = -Wl,--disable-new-dtags,-rpath,'$1'

# $(call run,VERB,COMMAND): the command, shown as a short line unless V=1.
define run
@mkdir -p $(@D)
$(if $(filter 1,$(V)),$2,@echo '  $1	$@'; $2)
endef

# ---- sources

objects  = $(patsubst %,$(B)/%.o,$(basename $1))
programs = $(patsubst %.c,$(B)/%,$(wildcard $1/*.c))
LIB      := $(call objects,$(wildcard lib/*.c))
MODULE   := $(B)/brume_vdb.so
IN_MODULE := $(addprefix $(B)/lib/,vdb_module.o vdb_file.o grid.o memory.o error.o)
CORE     := $(call objects,$(wildcard core/*.c core/cpu/*.c))
# Those that take longest come first, before all that is short.
CUDA_SRC := $(if $(filter 1,$(CUDA)),$(wildcard core/cuda/sample_*.cu) \
    $(filter-out core/cuda/sample_%,$(wildcard core/cuda/*.cu)))
GENERATED := $(B)/parser/lexer.o $(B)/parser/grammar.o
PARSER   := $(call objects,$(wildcard parser/*.c)) $(GENERATED)
# What tests link of the front end: all but the program.
FRONT    := $(filter-out $(B)/parser/main.o,$(PARSER))
UNITS    := $(call programs,tests/unit)
TOOLS    := $(call programs,tests/tools) $(call programs,tests/bench)
FUZZERS  := $(call programs,tests/fuzz)
ifneq ($(CUDA_SRC),)
CUDA_ANY := $(B)/core/cuda/photons_all.o $(B)/core/cuda/sample_all.o
CUDA_LINKED := $(B)/core/cuda/linked.o
CORE     := $(call objects,$(CUDA_SRC)) $(CUDA_LINKED) $(CORE)
CPPFLAGS += -DBRUME_CUDA
OTHER_LIBS += -L$(dir $(shell command -v $(NVCC)))../lib64 -lcudart_static \
    -lstdc++ -ldl -lrt
TOOLS    += $(B)/tests/gpu/trees
ON_GPU   := $(call objects,$(wildcard tests/gpu/*.cu))
GPU_TESTS := $(B)/tests/tools/compare $(B)/tests/bench/grids \
    $(B)/tests/gpu/trees $(B)/tests/unit/test_truth_tables
endif

.DELETE_ON_ERROR:
.SECONDARY:
.PHONY: all unit tools fuzzers setup demo film test test-all fuzz mutants bench \
        do-demo do-film do-test do-test-all \
        lint format install bundle gpu-bundle clean
all: $(B)/brume

$(B)/brume: $(PARSER) $(B)/libbrume.a | $(MODULE)
	$(call run,link,$(C) $(CFLAGS) -o $@ $^ $(LDFLAGS) $(LIBS) \
	    $(call rpath,$$ORIGIN:$$ORIGIN/../lib/brume))

$(MODULE): $(IN_MODULE)
	$(call run,link,$(CPP) $(CXXFLAGS) -shared -o $@ $^ $(LDFLAGS) $(VDB_LIBS))
$(IN_MODULE): C += -fPIC
$(IN_MODULE): CPP += -fPIC

$(B)/libbrume.a: $(CORE) $(LIB)
	$(call run,ar,rm -f $@ && $(AR) rcs $@ $^)

$(B)/%.o: %.c
	$(call run,cc,$(C) $(CPPFLAGS) $(CFLAGS) -MMD -MP -c -o $@ $<)

# What all voxels of grids and all cells of films pass through: with vectors.
VECTORS  := $(wildcard core/filter*.c) core/prepare_glow.c lib/grid.c
$(call objects,$(VECTORS)): C += $(if $(filter 0,$(SAN)),-O3)

# The scanner and the grammar of the scene language.
$(B)/parser/lexer.c: parser/lexer.l
	$(call run,flex,flex -Cfe -o $@ $<)

$(B)/parser/grammar.c $(B)/parser/grammar.h &: parser/grammar.y
	$(call run,bison,bison -Wall -Werror -o $(B)/parser/grammar.c \
	    --header=$(B)/parser/grammar.h $<)

$(GENERATED): %.o: %.c
	$(call run,cc,$(C) -Wno-unused-function $(CPPFLAGS) $(CFLAGS) \
	    -MMD -MP -c -o $@ $<)
$(PARSER) $(UNITS:=.o): | $(B)/parser/grammar.h

$(B)/%.o: %.cc
	$(call run,c++,$(CPP) $(CPPFLAGS) $(CXXFLAGS) -MMD -MP -c -o $@ $<)

# The kernels for any scene at all call functions that nvlink joins to them. As
# one piece each kernel has copies of its own, and ptxas works on these for
# longer than a quarter of an hour. 128 registers are what the kernels have.
$(CUDA_ANY): CU += -rdc=true -maxrregcount=128
$(CUDA_LINKED): $(CUDA_ANY)
	$(call run,nvlink,$(CU) -maxrregcount=128 -dlink -o $@ $^)

$(B)/%.o: %.cu
	$(call run,nvcc,$(CU) $(CPPFLAGS) -MMD -MP -c -o $@ $<)

# One program a file; each test can be run by itself.
$(UNITS) $(TOOLS): %: %.o $(FRONT) $(B)/libbrume.a | $(MODULE)
	$(call run,link,$(C) $(CFLAGS) -o $@ $^ $(LDFLAGS) -lcmocka $(LIBS) \
	    $(call rpath,$$ORIGIN/../..))
unit: $(UNITS)
tools: $(TOOLS)

# What a test asks of a GPU.
$(B)/tests/gpu/trees $(B)/tests/unit/test_truth_tables: $(ON_GPU)

# Programs that give inputs of their own making to a part of the program;
# OpenVDB asks for the sanitizers of C++.
$(FUZZERS): %: %.o $(FRONT) $(B)/libbrume.a | $(MODULE)
	$(call run,link,$(CPP) $(CXXFLAGS) -fsanitize=fuzzer -o $@ $^ $(LDFLAGS) $(LIBS) \
	    $(call rpath,$$ORIGIN/../..))
fuzzers: $(FUZZERS)

-include $(patsubst %.o,%.d,$(ON_GPU) $(LIB) $(IN_MODULE) $(CORE) $(PARSER)) $(UNITS:=.d) $(TOOLS:=.d) \
    $(FUZZERS:=.d)

# ---- the two commands
# The variables above are made when make starts, before there may be a
# compiler or pkg-config: so make starts anew after the set-up.

setup:
	@.ci/setup

demo film test test-all: setup
	@+$(MAKE) --no-print-directory $(if $(findstring -j,$(MAKEFLAGS)),,-j$$(nproc)) do-$@

do-demo: $(B)/brume
	@mkdir -p $(B)/demo
	$(B)/brume scenes/quickstart.pov +W640 +H480 +O$(B)/demo/quickstart.exr
	$(B)/brume scenes/quickstart.pov +W640 +H480 +O$(B)/demo/quickstart.png
	$(FILM)
	@echo 'The pictures are $(B)/demo/quickstart.exr and .png,'
	@echo 'the film $(B)/demo/campfire1.png to campfire8.png; make film joins it.'

# Eight frames, those that are finished left out; as a film where ffmpeg is.
FILM_WORDS ?= +W192 +H144
FILM_TO    ?= $(B)/demo
FILM = $(B)/brume scenes/campfire.ini $(FILM_WORDS) +V --resume +O$(FILM_TO)/campfire.png
do-film: $(B)/brume
	@mkdir -p $(FILM_TO)
	$(FILM)
	@if command -v ffmpeg >/dev/null; then \
	    ffmpeg -v error -y -framerate 12 -i $(FILM_TO)/campfire%d.png \
	        -vf loop=5:8 -pix_fmt yuv420p $(FILM_TO)/campfire.mp4 && \
	    echo 'The film is $(FILM_TO)/campfire.mp4.'; \
	else echo 'ffmpeg, which would join the frames, is not installed.'; fi

do-test: $(B)/brume $(UNITS) $(TOOLS)
	@B=$(B) tests/run

do-test-all: $(B)/brume $(UNITS) $(TOOLS)
	@B=$(B) tests/run --all

# FUZZ_RUNS inputs for each of the programs of tests/fuzz/.
FUZZ_RUNS ?= 200000
fuzz:
	@+$(MAKE) --no-print-directory FUZZ=1 CUDA=0 WERROR=0 fuzzers
	@B=build/fuzz tests/fuzz/run $(FUZZ_RUNS)

# What is there for extremes, taken out: each must be missed by its test.
mutants:
	@B=$(B) tests/mutations/run

# The published scenes, so many seconds each: tests/bench/results/.
BENCH_SECONDS ?= 60
bench: $(B)/brume $(B)/tests/bench/grids $(B)/tests/tools/compare
	@B=$(B) tests/bench/bench.py --budget $(BENCH_SECONDS)

# ---- house-keeping

lint:
	@NVCC=$(if $(filter 1,$(CUDA)),$(NVCC)) CC='$(CC)' CXX='$(CXX)' tests/lint

format:
	clang-format -i $$(git ls-files '*.c' '*.cc' '*.cu')

# The headers lie in one folder: #include <brume/brume.h>.
HEADERS := core/brume.h core/brume_film.h core/brume_function.h core/particles.h \
    core/volume_photons.h lib/error.h lib/grid.h lib/mesh.h
VERSION  = $(shell sed -n 's/^\#define BRUME_VERSION "\(.*\)"/\1/p' core/brume.h)
ROOT     = $(DESTDIR)$(PREFIX)
install: $(B)/brume
	@install -D -t $(ROOT)/bin $(B)/brume
	@install -D -m644 -t $(ROOT)/lib $(B)/libbrume.a
	@install -D -m644 -t $(ROOT)/lib/brume $(MODULE)
	@install -d $(ROOT)/include/brume $(ROOT)/lib/pkgconfig
	@for h in $(HEADERS); do sed 's,"\(lib\|core\)/,",' $$h \
	    >$(ROOT)/include/brume/$${h##*/} || exit; done
	@printf '%s\n' 'prefix=$${pcfiledir}/../..' 'Name: brume' \
	    'Description: renderer of scenes with participating media' \
	    'Version: $(VERSION)' 'Requires: $(PACKAGES)' \
	    'Cflags: -I$${prefix}/include' \
	    'Libs: -L$${prefix}/lib -lbrume $(OTHER_LIBS)' \
	    >$(ROOT)/lib/pkgconfig/brume.pc
	@for m in $(wildcard man/*.[1-8]); do install -D -m644 -t \
	    $(ROOT)/share/man/man$${m##*.} $$m || exit; done
	@cd scenes && find . -type f -exec install -D -m644 {} \
	    $(abspath $(ROOT))/share/brume/scenes/{} \;
	@echo '  installed	$(ROOT)'

# A folder, and programs beside bin/brume in it.
define pack
	@rm -rf $(1)
	@$(MAKE) --no-print-directory install DESTDIR= PREFIX=$(1)
	@$(C) $(CFLAGS) -s -o $(1)/bin/brume $(PARSER) $(B)/libbrume.a \
	    $(LDFLAGS) $(LIBS) \
	    $(call rpath,$$ORIGIN/../lib:$$ORIGIN/../lib/brume)
	@.ci/bundle $(1) $(2)
endef

# Runs from any place on any x86-64 Linux with glibc >= 2.36.
bundle: $(B)/brume
	$(call pack,$(B)/bundle)

# The same with what tests/gpu/run needs where there is a GPU and little else.
gpu-bundle: $(B)/brume $(GPU_TESTS)
	$(if $(GPU_TESTS),,$(error make gpu-bundle: there is no nvcc, or CUDA=0))
	$(call pack,$(B)/gpu-bundle,$(GPU_TESTS))

clean:
	rm -rf build
