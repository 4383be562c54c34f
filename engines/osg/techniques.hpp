#pragma once

#include "cpp/json.hpp"

#include <osg/Camera>
#include <osg/ref_ptr>
#include <osgShadow/ShadowTechnique>

#include <string>
#include <vector>

namespace engine::osg_adapter {

/// A technique of osgShadow whose fragments are the world's position and V in place of a colour,
/// and whose map's camera can be asked for once a frame has been drawn.
struct Technique {
    osg::ref_ptr<osgShadow::ShadowTechnique> technique;
    osg::Camera* (*camera)(const osgShadow::ShadowTechnique&) = nullptr;
};

/// The values of the key `technique`.
[[nodiscard]] std::vector<std::string> technique_names();

/// @param engine      The job's [engine] table, every key of it.
/// @param resolution  Texels along a side.
[[nodiscard]] Technique make_technique(const Json& engine, int resolution);

/// The same technique as OpenSceneGraph has it, whose fragments are its own colours.
[[nodiscard]] osg::ref_ptr<osgShadow::ShadowTechnique> make_own_technique(const Json& engine,
                                                                          int resolution);

} // namespace engine::osg_adapter
