# shellcheck shell=bash
# The requirements of engines/blender. Sourced by ./dev engines, whose functions it may call, and by the tests,
# in this folder.

install_engine()
{
    install_packages blender python3-numpy python3-openimageio xvfb mesa-utils
}

# missing_of_engine: prints the first missing requirement, in one line.
missing_of_engine()
{
    missing_program Xvfb && return
    missing_program glxinfo && return
    missing_program blender && return
    /usr/bin/python3 -c 'import numpy, OpenImageIO' 2>/dev/null || echo "python3-openimageio is missing"
}
