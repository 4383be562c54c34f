#include "shadow_camera.hpp"

#include "cpp/scene.hpp"

#include <OgreCamera.h>
#include <OgreSceneNode.h>

#include <memory>

namespace engine::ogre_adapter {
namespace {

Ogre::Vector3 ogre_vector(const Vector3& v)
{
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

class PlacedAsTold : public Ogre::ShadowCameraSetup {
public:
    explicit PlacedAsTold(const Json& map) : near_{map.at("near")}, far_{map.at("far")}
    {
        const Json& camera = map.at("light_camera");
        forward_ = vector_of(camera.at("forward"));
        up_ = vector_of(camera.at("up"));
        const double left = camera.at("left");
        const double right = camera.at("right");
        const double bottom = camera.at("bottom");
        const double top = camera.at("top");
        width_ = right - left;
        height_ = top - bottom;
        const Vector3 aside = normalized(cross(forward_, up_));
        // OGRE's near must be positive: move the camera back by the map's depth range.
        position_ = vector_of(camera.at("position")) + (left + right) / 2 * aside +
                    (bottom + top) / 2 * up_ + (near_ - (far_ - near_)) * forward_;
    }

    void getShadowCamera(const Ogre::SceneManager*, const Ogre::Camera*, const Ogre::Viewport*,
                         const Ogre::Light*, Ogre::Camera* map, size_t) const override
    {
        const double range = far_ - near_;
        map->setCustomViewMatrix(false);
        map->setCustomProjectionMatrix(false);
        map->setProjectionType(Ogre::PT_ORTHOGRAPHIC);
        map->setOrthoWindow(static_cast<float>(width_), static_cast<float>(height_));
        map->setNearClipDistance(static_cast<float>(range));
        map->setFarClipDistance(static_cast<float>(2 * range));
        map->getParentSceneNode()->setPosition(ogre_vector(position_));
        map->getParentSceneNode()->setOrientation(
            Ogre::Math::lookRotation(ogre_vector(-1 * forward_), ogre_vector(up_)));
    }

private:
    double near_;
    double far_;
    Vector3 forward_;
    Vector3 up_;
    Vector3 position_;
    double width_;
    double height_;
};

} // namespace

Ogre::ShadowCameraSetupPtr place_as_told(const Json& shadow_map)
{
    return std::make_shared<PlacedAsTold>(shadow_map);
}

} // namespace engine::ogre_adapter
