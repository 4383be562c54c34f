#!/usr/bin/env bash
# include_order_test.sh WORK: plants one violation at a time, and expects include_order.py to name it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
work=$1

# expect NAME PATTERN FILE HEADER [FILE HEADER]…: in a checkout of these files, each including one header. PATTERN is
# part of what is said, or "nothing".
expect()
{
    local name=$1 pattern=$2 said status=0
    shift 2
    rm -rf "$work"
    while [ $# -gt 0 ]; do
        mkdir -p "$work/$(dirname "$1")"
        printf '#include "%s"\n' "$2" >"$work/$1"
        shift 2
    done
    said=$(python3 -B include_order.py "$work" 2>&1) || status=$?
    if [ "$pattern" = nothing ]; then
        [ "$status" -eq 0 ] || { echo "$name: should pass, but: $said" && exit 1; }
    elif [ "$status" -ne 1 ] || [[ $said != *"$pattern"* ]]; then
        echo "$name: expected '$pattern', got status $status: $said"
        exit 1
    fi
}

expect "a source and its header" nothing scene/a.cpp scene/a.hpp scene/a.hpp scene/b.hpp
expect "two units" "in a circle: scene/a, scene/b" scene/a.hpp scene/b.hpp scene/b.cpp scene/a.hpp
expect "over three units and two folders" "in a circle: scene/a, scene/job/b, scene/job/c" \
    scene/a.hpp scene/job/b.hpp scene/job/b.hpp scene/job/c.hpp scene/job/c.cpp scene/a.hpp
expect "a diamond is no circle" nothing scene/a.hpp scene/b.hpp scene/a.cpp scene/c.hpp scene/b.hpp scene/d.hpp \
    scene/c.hpp scene/d.hpp
expect "a subject includes one before it" nothing analysis/metrics/a.hpp analysis/bias/b.hpp
expect "a subject includes one after it" "analysis/bias/b.cpp: bias may include pixels, depth, lookup, bias of analysis" \
    analysis/bias/b.cpp analysis/metrics/a.hpp
expect "a subject includes what stands above all" "not analysis/comparison/comparison.hpp" analysis/lookup/a.hpp analysis/comparison/comparison.hpp
expect "the interface of the renderers is for all" nothing analysis/lookup/a.hpp analysis/renderers.hpp
expect "a command includes what commands share" nothing cli/compare/a.cpp cli/session/b.hpp
expect "a command includes another" "not cli/tune/b.hpp" cli/compare/a.cpp cli/tune/b.hpp
expect "what is shared includes a command" "not cli/compare/b.hpp" cli/session/a.cpp cli/compare/b.hpp
expect "exit codes are for all" nothing cli/compare/a.cpp cli/exit_codes.hpp
expect "no checkout" "no sources found" nowhere/a.hpp scene/a.hpp
echo "circles and subjects that know too much are named"
