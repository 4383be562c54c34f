# shellcheck shell=bash
# What engines/godot needs; read by ./dev engines, whose functions are there to be called, and by the
# tests; the working directory is this folder.

install_engine()
{
    install_packages godot3-runner python3-numpy xvfb
}

# missing_of_engine: the first thing that is not there, in one line; nothing where all is.
missing_of_engine()
{
    missing_program Xvfb && return
    missing_program godot3-runner && return
    /usr/bin/python3 -c 'import numpy' 2>/dev/null || echo "there is no python3-numpy"
}
