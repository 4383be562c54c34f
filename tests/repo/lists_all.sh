#!/usr/bin/env bash
# lists_all.sh PROGRAM FILTER: expects the filter, which joins those of all entries, to select every test case.
set -euo pipefail
program=$1
filter=$2
all=$(GTEST_FILTER="*" "$program" --gtest_list_tests | sed "s,  # .*,,") # parameters may be addresses
chosen=$(GTEST_FILTER=$filter "$program" --gtest_list_tests | sed "s,  # .*,,")
[ -n "$all" ]
diff <(echo "$all") <(echo "$chosen") || {
    echo "$program: no CTest entry runs the test cases above: CMake must run again, or does not know their macro" \
        "(gnomon_tests_of)" >&2
    exit 1
}
