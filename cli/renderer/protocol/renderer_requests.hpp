#pragma once

#include "cli/renderer/protocol/renderer_answers.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace gnomon::cli {

/// Values of a renderer's own keys, by name without "engine.".
using EngineValues = std::map<std::string, scene::JobValue, std::less<>>;

/// The scene, camera and light of an `open` request.
struct RendererScene {
    std::string name;
    const scene::TriangleScene& triangles;
    scene::CameraSettings camera;
    scene::LightSettings light;
    scene::ImageSize image;
};

/// The settings of a `draw` request.
struct RendererDraw {
    const scene::Job& job;
    const scene::View& view;
    /// The keys that the user set; those of the tables of `given_tables` are sent.
    std::vector<std::string> given;
    EngineValues engine; ///< for every key
};

/// @param mesh  the scene's .glb file.
[[nodiscard]] AnswerJson open_request(const RendererScene& scene,
                                      const std::filesystem::path& mesh);

[[nodiscard]] AnswerJson draw_request(const RendererDraw& draw);

/// The names of the scene's objects that lack the role.
[[nodiscard]] std::vector<std::string> objects_without(const scene::TriangleScene& scene,
                                                       bool scene::Object::*role);

/// The given keys of `[shadow_map]`, `[lookup]`, `[bias]` and `[method]`, by table.
[[nodiscard]] AnswerJson given_tables(const RendererDraw& draw);

} // namespace gnomon::cli
