#!/usr/bin/env bash
# parallel_test.sh: the test of the example for GNU parallel, where that is installed.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# moreutils has a program of this name, too.
parallel --version 2>/dev/null | grep -q 'GNU parallel' || {
    echo "SKIPPED: GNU parallel is missing: apt-get install parallel"
    exit 77
}
exec /usr/bin/python3 -B "$here/parallel_example_test.py"
