#pragma once

#include "cpp/json.hpp"

#include <osg/Camera>
#include <osg/ref_ptr>
#include <osgShadow/ShadowTechnique>

#include <string>
#include <vector>

namespace engine::osg_adapter {

/// A technique of osgShadow whose fragments are world position and V instead of a colour. Its map's
/// camera is valid after a frame was drawn.
struct Technique {
    osg::ref_ptr<osgShadow::ShadowTechnique> technique;
    osg::Camera* (*camera)(const osgShadow::ShadowTechnique&) = nullptr;
};

/// The values of the key `technique`.
[[nodiscard]] std::vector<std::string> technique_names();

/// @param engine      the job's [engine] table, with every key.
/// @param resolution  side of the map [texels].
[[nodiscard]] Technique make_technique(const Json& engine, int resolution);

/// OpenSceneGraph's unmodified technique, whose fragments are colours.
[[nodiscard]] osg::ref_ptr<osgShadow::ShadowTechnique> make_own_technique(const Json& engine,
                                                                          int resolution);

} // namespace engine::osg_adapter
