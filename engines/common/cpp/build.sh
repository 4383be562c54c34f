# shellcheck shell=bash
# For engine.sh of the adapters in C++, whose folder is the working directory.

# build_engine: makes the adapter in build/.
build_engine()
{
    local launcher=()
    [ -z "$(command -v ccache)" ] || launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
    say "Building ${PWD##*/} into engines/${PWD##*/}/build"
    cmake -S . -B build -G Ninja "${launcher[@]}" && cmake --build build ||
        fail "engines ${PWD##*/}: the adapter does not build"
}

# missing_build PROGRAM: says that the program has not been built, or which of its libraries is gone.
missing_build()
{
    [ -x "build/$1" ] || {
        echo "${PWD##*/} is not built"
        return
    }
    local gone
    gone=$(ldd "build/$1" 2>/dev/null | sed -n 's/^\s*\(\S*\) => not found/\1/p' | head -n 1)
    [ -z "$gone" ] || echo "there is no $gone"
}
