#pragma once

#include "cli/renderer/protocol/renderer_requests.hpp"
#include "scene/case/space.hpp"

#include <string>
#include <string_view>

namespace gnomon::cli {

/// The files of a frame's folder, beside those that the renderer names.
inline constexpr const char* frame_file = "frame.exr";
inline constexpr const char* frame_case_file = "case.toml";

/// A table of a case.toml, of an object of JSON; empty of an empty one.
/// @throws BadAnswer  if it has what TOML cannot say.
[[nodiscard]] std::string toml_table(std::string_view name, const AnswerJson& table);

/// A renderer's frame as the case.toml that describes it to `evaluate` (docs/evaluate.md): mesh,
/// camera and light that it was told, in its own space, and its settings: what it was told, or says
/// that it did in place of that.
/// @param has_frame  it drew `frame_file`.
/// @param mesh       the mesh's path, relative to the frame's folder.
/// @throws BadAnswer  if a table has what TOML cannot say.
[[nodiscard]] std::string frame_case(const RendererHello& hello, const RendererScene& scene,
                                     const RendererDraw& draw, const DrawnAnswer& drawn,
                                     const AnswerJson& conventions, const scene::CaseSpace& space,
                                     const std::string& mesh, bool has_frame);

} // namespace gnomon::cli
