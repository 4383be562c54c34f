// Lets Gnomon drive OpenSceneGraph (docs/renderer_protocol.md). README.md explains how.
#include "cpp/program.hpp"
#include "osg_engine.hpp"

#include <memory>

int main(int argc, char** argv)
{
    return engine::run("osg", argc, argv, [](engine::Mask mask) {
        return std::make_unique<engine::osg_adapter::OsgEngine>(mask);
    });
}
