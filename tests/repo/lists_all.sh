#!/usr/bin/env bash
# lists_all.sh PROGRAM FILTER…: the filters of a test program's entries leave none of its test cases out.
set -euo pipefail
program=$1
shift
filter=$(IFS=: && echo "$*")
all=$(GTEST_FILTER="*" "$program" --gtest_list_tests | sed "s,  # .*,,") # parameters may be addresses
chosen=$(GTEST_FILTER=$filter "$program" --gtest_list_tests | sed "s,  # .*,,")
[ -n "$all" ]
diff <(echo "$all") <(echo "$chosen") || {
    echo "$program: no CTest entry runs the test cases above: CMake must run again, or does not know their macro" \
        "(gnomon_list_tests)" >&2
    exit 1
}
