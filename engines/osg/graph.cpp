#include "graph.hpp"

#include <osg/Camera>
#include <osg/Geometry>
#include <osg/NodeCallback>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <cstddef>
#include <span>

namespace engine::osg_adapter {
namespace {

/// Limit of a geometry. With 131,072 triangles, llvmpipe draws nothing, and softpipe reads out of
/// bounds.
constexpr std::size_t coordinates_at_once = std::size_t{9} * 16'384;

/// Hides a node from one camera.
class UnseenBy : public osg::NodeCallback {
public:
    explicit UnseenBy(const osg::Camera& eye) : eye_{eye} {}

    void operator()(osg::Node* node, osg::NodeVisitor* visitor) override
    {
        auto* const cull = visitor->asCullVisitor();
        if (cull == nullptr || cull->getCurrentCamera() != &eye_) {
            traverse(node, visitor);
        }
    }

private:
    const osg::Camera& eye_;
};

osg::ref_ptr<osg::Geometry> make_geometry(std::span<const float> corners)
{
    const osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array;
    const osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array;
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        positions->push_back({corners[i], corners[i + 1], corners[i + 2]});
    }
    for (std::size_t i = 0; i < positions->size(); i += 3) {
        const osg::Vec3 a = positions->at(i);
        osg::Vec3 normal = (positions->at(i + 1) - a) ^ (positions->at(i + 2) - a);
        normal.normalize();
        normals->insert(normals->end(), 3, normal);
    }
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(positions);
    geometry->setTexCoordArray(position_unit, positions);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    const osg::ref_ptr<osg::Vec4Array> white = new osg::Vec4Array;
    white->push_back({1, 1, 1, 1});
    geometry->setColorArray(white, osg::Array::BIND_OVERALL);
    geometry->addPrimitiveSet(
        new osg::DrawArrays{GL_TRIANGLES, 0, static_cast<GLsizei>(positions->size())});
    return geometry;
}

} // namespace

osg::ref_ptr<osg::Group> make_objects(const Scene& scene, const osg::Camera& eye)
{
    const osg::ref_ptr<osg::Group> objects = new osg::Group;
    for (const SceneObject& object : scene.objects) {
        // Each object needs a group: a drawable's cull callback runs before the camera is known.
        const osg::ref_ptr<osg::Group> group = new osg::Group;
        const std::span<const float> corners{object.shape.corners};
        for (std::size_t begin = 0; begin < corners.size(); begin += coordinates_at_once) {
            const osg::ref_ptr<osg::Geometry> geometry = make_geometry(
                corners.subspan(begin, std::min(coordinates_at_once, corners.size() - begin)));
            geometry->setNodeMask(is_drawn | (object.casts ? casts_shadow : 0));
            group->addChild(geometry);
        }
        if (!object.is_seen) {
            group->setCullCallback(new UnseenBy{eye});
        }
        objects->addChild(group);
    }
    return objects;
}

osg::ref_ptr<osg::Light> make_light(const Light& light)
{
    const osg::ref_ptr<osg::Light> made = new osg::Light;
    made->setLightNum(0);
    if (light.type == LightType::directional) {
        made->setPosition(osg::Vec4d{-osg_vector(light.direction), 0});
        return made;
    }
    made->setPosition(osg::Vec4d{osg_vector(light.position), 1});
    if (light.type == LightType::spot) {
        made->setDirection(osg_vector(light.direction));
        made->setSpotCutoff(static_cast<float>(light.cone_deg / 2));
    }
    return made;
}

osg::Vec3d osg_vector(const Vector3& v)
{
    return {v[0], v[1], v[2]};
}

Vector3 vector_of(const osg::Vec3d& v)
{
    return {v.x(), v.y(), v.z()};
}

} // namespace engine::osg_adapter
