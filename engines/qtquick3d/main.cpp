// Qt Quick 3D as a renderer that Gnomon drives: docs/renderer_protocol.md. README.md says how it is
// made to say what it does.
#include "cpp/program.hpp"
#include "qt_engine.hpp"

#include <memory>

int main(int argc, char** argv)
{
    return engine::run("qtquick3d", argc, argv, [](engine::Mask mask) {
        return std::make_unique<engine::qt_adapter::QtEngine>(mask);
    });
}
