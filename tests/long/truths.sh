#!/bin/bash
# Every row of the tables of METHODS.md, section 13 (tests/truths.md has what
# came out); the rows take what they need, up to 20 s each of the processor.
SECONDS_A_ROW=20 "$B"/tests/unit/test_truth_tables all
