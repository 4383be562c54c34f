#include "qt_engine.hpp"

#include "scene_item.hpp"
#include "settings.hpp"
#include "triangles.hpp"

#include <QVariant>
#include <QtGlobal>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace engine::qt_adapter {
namespace {

constexpr int most_pixels = 16384;

using Shapes = std::vector<std::unique_ptr<Triangles>>;

/// The objects for scene.qml.
QVariantList objects_of(const Scene& scene, Shapes& shapes)
{
    QVariantList objects;
    for (const SceneObject& object : scene.objects) {
        shapes.push_back(std::make_unique<Triangles>(object.shape));
        objects.append(QVariantMap{{"geometry", QVariant::fromValue<QObject*>(shapes.back().get())},
                                   {"casts", object.casts},
                                   {"isSeen", object.is_seen}});
    }
    return objects;
}

} // namespace

Identity QtEngine::identity()
{
    return {"Qt Quick 3D", qVersion(), view_.device(), keys()};
}

void QtEngine::open(const Scene& scene)
{
    if (std::max(scene.width, scene.height) > most_pixels) {
        throw Refusal{"images have at most 16384 pixels a side"};
    }
    scene_ = scene;
    view_.resize(scene.width, scene.height);
}

std::vector<float> QtEngine::seen(const Json& draw, bool is_picture, bool casts)
{
    const Json& engine = draw.at("engine");
    const double scale = units_per_metre(engine);
    Shapes shapes;
    const QVariantMap properties{{"isPicture", is_picture},
                                 {"objects", objects_of(scene_, shapes)},
                                 {"unitsPerMetre", scale},
                                 {"cullMode", cull_mode(engine)}};
    return view_.draw(properties, [&](QObject& item) {
        set_camera(item, scene_, scale);
        set_light(item, scene_.light, engine, draw.at("shadow_map").at("resolution").get<int>(),
                  casts);
    });
}

Drawn QtEngine::draw(const Json& draw)
{
    check(draw, scene_.light.type);
    const bool casts = draw.at("engine").at("castsShadow").get<bool>();
    const std::vector<float> pixels = seen(draw, false, casts);
    Floats position{"position", scene_.width, scene_.height, 3, {}};
    Floats shadow{"shadow", scene_.width, scene_.height, 1, {}};
    constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t i = 0; i < pixels.size(); i += 4) {
        const bool is_seen = !(pixels[i + 3] > 0);
        for (std::size_t k = 0; k < 3; ++k) {
            position.values.push_back(is_seen ? pixels[i + k] : nothing);
        }
        shadow.values.push_back(is_seen ? -pixels[i + 3] : 0);
    }
    Drawn drawn{{}, tables(draw, scene_)};
    if (mask_ == Mask::shader) {
        drawn.files = {std::move(position), std::move(shadow)};
        return drawn;
    }
    drawn.files = mask_of_pictures(seen(draw, true, casts), seen(draw, true, false), scene_);
    drawn.files.push_back(std::move(position));
    return drawn;
}

} // namespace engine::qt_adapter
