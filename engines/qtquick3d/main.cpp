// Lets Gnomon drive Qt Quick 3D (docs/renderer_protocol.md). README.md explains how.
#include "cpp/program.hpp"
#include "qt_engine.hpp"

#include <memory>

int main(int argc, char** argv)
{
    return engine::run("qtquick3d", argc, argv, [](engine::Mask mask) {
        return std::make_unique<engine::qt_adapter::QtEngine>(mask);
    });
}
