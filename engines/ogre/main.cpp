// Lets Gnomon drive OGRE (docs/renderer_protocol.md). README.md explains how.
#include "cpp/program.hpp"
#include "ogre_engine.hpp"

#include <memory>

int main(int argc, char** argv)
{
    return engine::run("ogre", argc, argv, [](engine::Mask mask) {
        return std::make_unique<engine::ogre_adapter::OgreEngine>(mask);
    });
}
