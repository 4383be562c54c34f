# shellcheck shell=bash
# What engines/blender needs; read by ./dev engines, whose functions are there to be called, and by the
# tests; the working directory is this folder.

install_engine()
{
    install_packages blender python3-numpy python3-openimageio xvfb mesa-utils
}

# missing_of_engine: the first thing that is not there, in one line; nothing where all is.
missing_of_engine()
{
    missing_program Xvfb && return
    missing_program glxinfo && return
    missing_program blender && return
    /usr/bin/python3 -c 'import numpy, OpenImageIO' 2>/dev/null || echo "there is no python3-openimageio"
}
