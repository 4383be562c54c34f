# shellcheck shell=bash
# missing_program NAME: prints that the program is missing; fails if it exists.
missing_program()
{
    ! command -v "$1" >/dev/null || return 1
    echo "$1 is missing"
}

# missing_of FOLDER: prints the first missing requirement of the engine in the folder, in one line.
missing_of()
{
    (
        cd "$1" || exit
        # shellcheck source=/dev/null
        source ./engine.sh
        missing_of_engine
    )
}
