#pragma once

#include "cpp/program.hpp"
#include "cpp/serve.hpp"

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
    explicit OgreEngine(Mask mask);
    OgreEngine(const OgreEngine&) = delete;
    OgreEngine& operator=(const OgreEngine&) = delete;
    ~OgreEngine() override;

    Identity identity() override;
    void open(const Scene& scene) override;
    Drawn draw(const Json& draw) override;

private:
    /// Four numbers a pixel, top row first: world position and V.
    [[nodiscard]] std::vector<float> seen(const Json& draw);
    /// OGRE's own picture with its white material.
    [[nodiscard]] std::vector<float> picture(const Json& draw, bool has_shadows);
    [[nodiscard]] std::vector<float> render(Ogre::SceneManager& manager, const Json& draw,
                                            const Ogre::MaterialPtr& material,
                                            const Ogre::String& scheme);
    [[nodiscard]] std::vector<float> pixels_seen_by(Ogre::Camera& camera,
                                                    const Ogre::String& scheme);

    Mask mask_;
    Xvfb display_; // declared first: the members below draw on it
    std::unique_ptr<Ogre::LogManager> log_;
    std::unique_ptr<Ogre::Root> root_;
    Ogre::MaterialPtr material_;
    Ogre::TexturePtr target_;
    Scene scene_;
};

} // namespace engine::ogre_adapter
