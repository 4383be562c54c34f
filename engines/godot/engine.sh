# shellcheck shell=bash
# The requirements of engines/godot. Sourced by ./dev engines, whose functions it may call, and by the tests,
# in this folder.

install_engine()
{
    install_packages godot3-runner python3-numpy xvfb
}

# missing_of_engine: prints the first missing requirement, in one line.
missing_of_engine()
{
    missing_program Xvfb && return
    missing_program godot3-runner && return
    /usr/bin/python3 -c 'import numpy' 2>/dev/null || echo "python3-numpy is missing"
}
