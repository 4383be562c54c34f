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

/// A key that a renderer adds to jobs, as engine.NAME.
struct EngineKey {
    std::string name; ///< without "engine."
    scene::Domain domain;
    scene::JobValue default_value;
    std::string unit; ///< empty: none
    std::string help; ///< one sentence
};

/// A renderer's answer to `hello`.
struct RendererHello {
    std::string name;
    std::string version;
    std::string device;
    std::vector<EngineKey> keys;

    /// "three.js 0.187.0, ANGLE (…)".
    [[nodiscard]] std::string title() const;
};

/// A renderer's answer to `draw`.
struct DrawnAnswer {
    double seconds = 0;
    std::map<std::string, std::string> files; ///< names of raw files by their key of [files]
    AnswerJson tables = AnswerJson::object(); ///< the settings it used, as a case's tables
};

/// The tables that an answer's `case` may have: those of case.toml about how a frame was made.
[[nodiscard]] const std::vector<std::string_view>& answered_tables();

/// @throws BadAnswer  naming what is missing or wrong.
[[nodiscard]] RendererHello read_hello(const AnswerJson& answer);
/// The answer's conventions, as in case.toml; an empty object means those of the mesh.
/// @throws BadAnswer
[[nodiscard]] AnswerJson read_opened(const AnswerJson& answer);
/// @throws BadAnswer
[[nodiscard]] DrawnAnswer read_drawn(const AnswerJson& answer);

/// The errors in an answer as (key, sentence); the key may be empty. Empty if the request
/// succeeded.
/// @throws BadAnswer  if `error` is neither a sentence nor sentences by key.
[[nodiscard]] std::vector<std::pair<std::string, std::string>>
read_errors(const AnswerJson& answer);

[[nodiscard]] AnswerJson to_json(const scene::JobValue& value);

} // namespace gnomon::cli
