# shellcheck shell=bash
# What engines/qtquick3d needs; read by ./dev engines, whose functions are there to be called, and by the
# tests; the working directory is this folder.
source ../common/cpp/build.sh

install_engine()
{
    install_packages cmake g++ ninja-build nlohmann-json3-dev libegl-dev libopengl-dev libgl-dev \
        qt6-declarative-dev qt6-quick3d-dev qt6-shadertools-dev \
        qml6-module-qtqml-workerscript qml6-module-qtquick qml6-module-quick3d xvfb
    build_engine
}

# missing_of_engine: the first thing that is not there, in one line; nothing where all is.
missing_of_engine()
{
    missing_program Xvfb && return
    missing_build gnomon_qtquick3d
}
