# shellcheck shell=bash
# The requirements of engines/qtquick3d. Sourced by ./dev engines, whose functions it may call, and by the tests,
# in this folder.
source ../common/cpp/build.sh

install_engine()
{
    install_packages cmake g++ ninja-build nlohmann-json3-dev libegl-dev libopengl-dev libgl-dev \
        qt6-declarative-dev qt6-quick3d-dev qt6-shadertools-dev \
        qml6-module-qtqml-workerscript qml6-module-qtquick qml6-module-quick3d xvfb
    build_engine
}

# missing_of_engine: prints the first missing requirement, in one line.
missing_of_engine()
{
    missing_program Xvfb && return
    missing_build gnomon_qtquick3d
}
