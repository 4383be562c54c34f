#pragma once

#include "api/advice.hpp"
#include "api/scene.hpp"
#include "scene/job/file.hpp"
#include "scene/job/setting_layers.hpp"
#include "scene/job/source.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::python {

/// Dotted keys with TOML text.
using TextPairs = std::vector<std::pair<std::string, std::string>>;

[[nodiscard]] std::vector<scene::Override> overrides_of(const TextPairs& keys);

/// Where a job comes from: a file, a built-in scene, or a scene in memory; and the keys that the
/// caller gave with it, over which others lie.
struct JobPlace {
    std::string path;
    std::string builtin;
    std::shared_ptr<const api::Scene> scene;
    TextPairs keys;
};

/// What of a job is meant.
struct JobChoice {
    std::string case_name; ///< empty: none is laid over the job
    std::string light;     ///< empty: all of them
};

/// A job, and what it is for each of its lights.
struct ReadJob {
    scene::JobSource source;
    std::vector<scene::LightJob> lights;
};

/// What advice and searches go over.
struct AdviceRequest {
    api::ViewOptions views;
    std::vector<std::string> methods; ///< empty: the job's own alone
    std::optional<std::uint64_t> max_bytes;
};

/// Empty: no search over methods.
/// @throws scene::InputError  as `api::method_request`, and for `max_bytes` without methods.
[[nodiscard]] std::optional<analysis::MethodRequest> methods_of(const AdviceRequest& request);

/// What a job says, its keys laid over that.
/// @throws scene::InputError  as `scene::read_job_source` does.
[[nodiscard]] scene::JobSource source_of(const JobPlace& place, const TextPairs& keys);

/// @throws scene::InputError  as `source_of`, and for a light that the job lacks.
[[nodiscard]] ReadJob read_job(const JobPlace& place, const TextPairs& keys,
                               const JobChoice& choice);

} // namespace gnomon::python
