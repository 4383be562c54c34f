#pragma once

#include "cpp/serve.hpp"
#include "cpp/xvfb.hpp"

#include <OgreMaterial.h>
#include <OgreRoot.h>
#include <OgreTexture.h>

#include <memory>
#include <vector>

namespace Ogre {
class LogManager;
}

namespace engine::ogre_adapter {

/// OGRE, as README.md of this folder describes it.
class OgreEngine : public Engine {
public:
    OgreEngine();
    OgreEngine(const OgreEngine&) = delete;
    OgreEngine& operator=(const OgreEngine&) = delete;
    ~OgreEngine() override;

    Identity identity() override;
    void open(const Scene& scene) override;
    Drawn draw(const Json& draw) override;

private:
    /// Of four numbers a pixel, rows from the top.
    [[nodiscard]] std::vector<float> render(Ogre::Camera& camera);

    Xvfb display_; // before all that draws on it
    std::unique_ptr<Ogre::LogManager> log_;
    std::unique_ptr<Ogre::Root> root_;
    Ogre::MaterialPtr material_;
    Ogre::TexturePtr target_;
    Scene scene_;
};

} // namespace engine::ogre_adapter
