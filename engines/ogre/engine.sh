# shellcheck shell=bash
# What engines/ogre needs; read by ./dev engines, whose functions are there to be called, and by the
# tests; the working directory is this folder.
source ../common/cpp/build.sh

install_engine()
{
    install_packages cmake g++ ninja-build nlohmann-json3-dev libegl-dev libopengl-dev libogre-1.12-dev xvfb
    build_engine
}

# missing_of_engine: the first thing that is not there, in one line; nothing where all is.
missing_of_engine()
{
    missing_program Xvfb && return
    missing_build gnomon_ogre
}
