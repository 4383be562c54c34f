# shellcheck shell=bash
# The requirements of engines/ogre. Sourced by ./dev engines, whose functions it may call, and by the tests,
# in this folder.
source ../common/cpp/build.sh

install_engine()
{
    install_packages cmake g++ ninja-build nlohmann-json3-dev libegl-dev libopengl-dev libogre-1.12-dev xvfb
    build_engine
}

# missing_of_engine: prints the first missing requirement, in one line.
missing_of_engine()
{
    missing_program Xvfb && return
    missing_build gnomon_ogre
}
