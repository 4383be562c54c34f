#pragma once

#include "cli/renderer/protocol/renderer_requests.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/case/space.hpp"

#include <string>
#include <string_view>

namespace gnomon::cli {

/// Files in a frame's folder, besides those that the renderer names.
inline constexpr const char* frame_file = "frame.exr";
inline constexpr const char* frame_case_file = "case.toml";

/// Converts a JSON object to a table of case.toml; an empty object gives an empty text.
/// @throws BadAnswer  for values that TOML cannot express.
[[nodiscard]] std::string toml_table(std::string_view name, const AnswerJson& table);

/// The case.toml that describes a renderer's frame to `evaluate` (docs/evaluate.md): the mesh,
/// camera and light of the request, in the renderer's space, and the requested settings, replaced
/// by those that the renderer says it used.
/// @param mesh       the mesh's path, relative to the frame's folder.
/// @param has_frame  whether it drew `frame_file`.
/// @throws BadAnswer  for values that TOML cannot express.
[[nodiscard]] std::string frame_case(const RendererHello& hello, const RendererScene& scene,
                                     const RendererDraw& draw, const DrawnAnswer& drawn,
                                     const AnswerJson& conventions, const scene::CaseSpace& space,
                                     const std::string& mesh, bool has_frame);

/// How two frames differ, bit by bit: "the mask differs at 12 pixels, first at (3, 4)"; empty if
/// they are equal.
[[nodiscard]] std::string frame_difference(const scene::CaseLayers& a, const scene::CaseLayers& b);

} // namespace gnomon::cli
