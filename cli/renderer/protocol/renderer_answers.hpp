#pragma once

#include "cli/renderer/protocol/answer_object.hpp"
#include "scene/job/value.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::cli {

inline constexpr std::int64_t protocol_version = 1;

/// A key of a renderer's own: engine.NAME of a job.
struct EngineKey {
    std::string name; ///< without "engine."
    scene::Domain domain;
    scene::JobValue default_value;
    std::string unit; ///< empty: none
    std::string help; ///< one sentence
};

/// What a renderer says of itself.
struct RendererHello {
    std::string name;
    std::string version;
    std::string device;
    std::vector<EngineKey> keys;

    /// "three.js 0.187.0, ANGLE (…)": what made a mask, and where.
    [[nodiscard]] std::string title() const;
};

/// A frame, as a renderer says that it drew it.
struct DrawnAnswer {
    double seconds = 0;
    std::map<std::string, std::string> files; ///< raw floats by their key of [files], file names
    AnswerJson tables = AnswerJson::object(); ///< what the engine did, in a case's tables
};

/// Tables that an answer's `case` may have: those of case.toml that say how a frame was made.
[[nodiscard]] const std::vector<std::string_view>& answered_tables();

/// @throws BadAnswer  naming what is missing or wrong.
[[nodiscard]] RendererHello read_hello(const AnswerJson& answer);
/// The conventions that it gives, as of case.toml; an empty object: those of the mesh.
/// @throws BadAnswer
[[nodiscard]] AnswerJson read_opened(const AnswerJson& answer);
/// @throws BadAnswer
[[nodiscard]] DrawnAnswer read_drawn(const AnswerJson& answer);

/// What the renderer cannot do, as (key, sentence), the key empty where it names none; empty: the
/// answer is no error.
/// @throws BadAnswer  if `error` is neither a sentence nor sentences by key.
[[nodiscard]] std::vector<std::pair<std::string, std::string>>
read_errors(const AnswerJson& answer);

/// The value as JSON says it.
[[nodiscard]] AnswerJson to_json(const scene::JobValue& value);

} // namespace gnomon::cli
