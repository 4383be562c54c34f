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

/// What a renderer is asked to look at, resolved: `open`.
struct RendererScene {
    std::string name; ///< for people
    const scene::TriangleScene& triangles;
    scene::CameraSettings camera;
    scene::LightSettings light;
    scene::ImageSize image;
};

/// What it is asked to draw there.
struct RendererDraw {
    const scene::Job& job;
    const scene::View& view;
    /// Keys that somebody gave, of which those of the tables that a renderer is told are sent.
    std::vector<std::string> given;
    EngineValues engine; ///< of every key
};

/// @param mesh  the .glb file that the scene was written to.
[[nodiscard]] AnswerJson open_request(const RendererScene& scene,
                                      const std::filesystem::path& mesh);

[[nodiscard]] AnswerJson draw_request(const RendererDraw& draw);

/// The objects of a scene that have not that role, by name.
[[nodiscard]] std::vector<std::string> objects_without(const scene::TriangleScene& scene,
                                                       bool scene::Object::*role);

/// The given keys of `[shadow_map]`, `[lookup]`, `[bias]` and `[method]`, by table.
[[nodiscard]] AnswerJson given_tables(const RendererDraw& draw);

} // namespace gnomon::cli
