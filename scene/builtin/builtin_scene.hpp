#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/settings/job.hpp"

#include <map>
#include <string>
#include <vector>

namespace gnomon::scene {

/// One parameter of a built-in scene.
struct BuiltinParameter {
    std::string name; ///< with its unit suffix, e.g. "thickness_m"
    std::string description;
    std::string unit; ///< "m", "deg", "" for counts and words
    SceneParameter default_value;
    double lower = 0; ///< inclusive; numbers only
    double upper = 0; ///< inclusive; numbers only
    bool is_integer = false;
    std::vector<std::string> words; ///< allowed values when the parameter is a word
};

using ParameterValues = std::map<std::string, SceneParameter>;

/// A generated scene: its parameters, its triangles, and a job that shows it well.
struct BuiltinScene {
    std::string name;
    std::string description; ///< one line
    std::string origin;      ///< which lesson or closed form it comes from
    std::vector<BuiltinParameter> parameters;
    TriangleScene (*build)(const ParameterValues&);
    /// The default job for these parameters: camera, light, shadow map, lookup and bias.
    Job (*default_job)(const ParameterValues&);
};

} // namespace gnomon::scene
