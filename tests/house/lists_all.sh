#!/usr/bin/env bash
# lists_all.sh PROGRAM FILTER…: the filters of a test program's entries leave none of its test cases out.
set -euo pipefail
program=$1
shift
filter=$(IFS=: && echo "$*")
diff <(GTEST_FILTER='*' "$program" --gtest_list_tests) <(GTEST_FILTER=$filter "$program" --gtest_list_tests) || {
    echo "$program: no CTest entry runs the test cases above; CMake finds them by TEST(, TEST_F(, TEST_P( and" \
        "RC_GTEST_PROP( at a line's begin" >&2
    exit 1
}
