# Brume: `make` builds build/brume; `make demo` and `make test` need nothing
# but git and make on a fresh Debian 12. Settings below, or in config.mak.
-include config.mak
PREFIX  ?= /usr/local
CC      ?= cc
CXX     ?= c++
CUDA    ?= $(if $(shell command -v nvcc),1,0)
SAN     ?= 0
WERROR  ?= 1
V       ?= 0
B       ?= build

OPT     := -O2 -g
WARN    := -Wall -Wextra -Wpedantic -Wvla $(if $(filter 1,$(WERROR)),-Werror)
CWARN   := -Wmissing-prototypes -Wstrict-prototypes
# Bytes must not depend on the processor: no contraction, no fast-math.
FP      := -ffp-contract=off
ifeq ($(SAN),1)
B       := build/san
OPT     := -O1 -g -fsanitize=address,undefined -fno-omit-frame-pointer \
           -fno-sanitize-recover=undefined
endif
PC      := OpenEXR libpng jansson
CPPFLAGS += -I. -I$(B) -D_GNU_SOURCE $(shell pkg-config --cflags $(PC) 2>/dev/null)
CFLAGS  ?=
ALLC    := -std=c11 $(OPT) $(FP) $(WARN) $(CWARN) -fvisibility=hidden -pthread
ALLCXX  := -std=c++17 $(OPT) $(FP) -Wall -Wextra -fvisibility=hidden
LIBS    := $(shell pkg-config --libs OpenEXR libpng jansson 2>/dev/null) \
           -lOpenEXRCore -lopenvdb -ltbb -lstdc++ -lm -pthread
Q       := $(if $(filter 1,$(V)),,@)

LIB_SRC  := $(wildcard lib/*.c lib/*.cc)
CORE_SRC := $(wildcard core/*.c core/cpu/*.c)
PARSER_SRC := $(wildcard parser/*.c)
GEN      :=
objects  = $(patsubst %,$(B)/%.o,$(basename $(1)))
COMMON   := $(call objects,$(LIB_SRC) $(CORE_SRC)) \
            $(call objects,$(filter-out parser/main.c,$(PARSER_SRC)))

.DELETE_ON_ERROR:
.PHONY: all clean unit
all: $(B)/brume

$(B)/brume: $(B)/parser/main.o $(COMMON)
	$(if $(Q),@echo "  link  $@")
	$(Q)$(CC) $(ALLC) $(CFLAGS) -o $@ $^ $(LDFLAGS) $(LIBS)

$(B)/%.o: %.c
	@mkdir -p $(@D)
	$(if $(Q),@echo "  cc    $<")
	$(Q)$(CC) $(CPPFLAGS) $(ALLC) $(CFLAGS) -MMD -MP -c -o $@ $<

$(B)/%.o: %.cc
	@mkdir -p $(@D)
	$(if $(Q),@echo "  c++   $<")
	$(Q)$(CXX) $(CPPFLAGS) $(ALLCXX) $(CXXFLAGS) -MMD -MP -c -o $@ $<

# Unit tests: one program a file, linked with everything but main.
UNITS := $(patsubst tests/unit/%.c,$(B)/tests/unit/%,$(wildcard tests/unit/*.c))
$(B)/tests/unit/%: tests/unit/%.c $(COMMON)
	@mkdir -p $(@D)
	$(if $(Q),@echo "  cc    $<")
	$(Q)$(CC) $(CPPFLAGS) $(ALLC) $(CFLAGS) -MMD -MP -o $@ $< \
	    $(COMMON) $(LDFLAGS) -lcmocka $(LIBS)
unit: $(UNITS)

clean:
	rm -rf build

-include $(shell find $(B) -name '*.d' 2>/dev/null)
