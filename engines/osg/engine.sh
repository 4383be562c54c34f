# shellcheck shell=bash
# The requirements of engines/osg. Sourced by ./dev engines, whose functions it may call, and by the tests,
# in this folder.
source ../common/cpp/build.sh

install_engine()
{
    install_packages cmake g++ ninja-build nlohmann-json3-dev libegl-dev libopengl-dev libopenscenegraph-dev
    build_engine
}

# missing_of_engine: prints the first missing requirement, in one line.
missing_of_engine()
{
    missing_build gnomon_osg
}
