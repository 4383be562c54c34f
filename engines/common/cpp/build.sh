# shellcheck shell=bash
# Sourced by the engine.sh of C++ adapters, in their folder.

# build_engine: builds the adapter in build/.
build_engine()
{
    local launcher=()
    [ -z "$(command -v ccache)" ] || launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
    say "Building ${PWD##*/} into engines/${PWD##*/}/build"
    cmake -S . -B build -G Ninja "${launcher[@]}" && cmake --build build ||
        fail "engines ${PWD##*/}: the adapter does not build"
}

# missing_build PROGRAM: prints that the program is not built, or which of its libraries is missing.
missing_build()
{
    [ -x "build/$1" ] || {
        echo "${PWD##*/} is not built"
        return
    }
    local gone
    gone=$(ldd "build/$1" 2>/dev/null | sed -n 's/^\s*\(\S*\) => not found/\1/p' | head -n 1)
    [ -z "$gone" ] || echo "$gone is missing"
}
