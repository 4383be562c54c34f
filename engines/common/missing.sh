# shellcheck shell=bash
# missing_program NAME: says that there is no such program, and fails where there is.
missing_program()
{
    ! command -v "$1" >/dev/null || return 1
    echo "there is no $1"
}

# missing_of FOLDER: what the engine in the folder lacks, in one line; nothing where it lacks nothing.
missing_of()
{
    (
        cd "$1" || exit
        # shellcheck source=/dev/null
        source ./engine.sh
        missing_of_engine
    )
}
