# shellcheck shell=bash
# The requirements of engines/vtk. Sourced by ./dev engines, whose functions it may call, and by the tests,
# in this folder.

install_engine()
{
    install_packages python3-vtk9 python3-numpy xvfb
}

# missing_of_engine: prints the first missing requirement, in one line.
missing_of_engine()
{
    missing_program Xvfb && return
    /usr/bin/python3 -c 'import numpy, vtkmodules' 2>/dev/null || echo "python3-vtk9 is missing"
}
