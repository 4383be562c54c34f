# shellcheck shell=bash
# What engines/vtk needs; read by ./dev engines, whose functions are there to be called, and by the
# tests; the working directory is this folder.

install_engine()
{
    install_packages python3-vtk9 python3-numpy xvfb
}

# missing_of_engine: the first thing that is not there, in one line; nothing where all is.
missing_of_engine()
{
    missing_program Xvfb && return
    /usr/bin/python3 -c 'import numpy, vtkmodules' 2>/dev/null || echo "there is no python3-vtk9"
}
