#pragma once

#include "api/advice.hpp"
#include "api/compare.hpp"
#include "api/scene.hpp"
#include "raster_gl/context.hpp"
#include "scene/job/file.hpp"
#include "scene/job/setting_layers.hpp"
#include "scene/job/source.hpp"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::python {

/// Dotted keys with values as TOML text.
using TextPairs = std::vector<std::pair<std::string, std::string>>;

[[nodiscard]] std::vector<scene::Override> overrides_of(const TextPairs& keys);

/// The source of a job: a file, a built-in scene, or a scene in memory, with the keys that belong
/// to it.
struct JobPlace {
    std::string path;
    std::string builtin;
    std::shared_ptr<const api::Scene> scene;
    TextPairs keys;
};

/// The selected part of a job.
struct JobChoice {
    std::string case_name; ///< empty for no case
    std::string light;     ///< empty for all lights
};

/// A job's source, and its job for each light.
struct ReadJob {
    scene::JobSource source;
    std::vector<scene::LightJob> lights;
};

/// The search space of advice and tuning.
struct AdviceRequest {
    api::ViewOptions views;
    std::vector<std::string> methods; ///< empty for the job's method only
    std::optional<std::uint64_t> max_bytes;
};

/// The methods to search; empty for no search over methods.
/// @throws scene::InputError  as `api::method_request`, and for `max_bytes` without methods.
[[nodiscard]] std::optional<analysis::MethodRequest> methods_of(const AdviceRequest& request);

/// Reads a job and applies the caller's keys.
/// @throws scene::InputError  as `scene::read_job_source`.
[[nodiscard]] scene::JobSource source_of(const JobPlace& place, const TextPairs& keys);

/// @throws scene::InputError  as `source_of`, and for a light that the job lacks.
[[nodiscard]] ReadJob read_job(const JobPlace& place, const TextPairs& keys,
                               const JobChoice& choice);

/// A thread's exclusive turn to use GL. Restores the thread's previous context, which may be
/// another library's.
class GlTurn {
public:
    /// @throws scene::EnvironmentError  as `raster_gl::Context`, and in a process forked after GL
    ///                                  was used.
    explicit GlTurn(std::optional<int> device);
    GlTurn(const GlTurn&) = delete;
    GlTurn& operator=(const GlTurn&) = delete;

    /// The options of a session in this turn.
    [[nodiscard]] api::SessionOptions options(int threads) const;
    /// Opens a session with the scene of the job's lights. Ctrl-C ends its work.
    [[nodiscard]] std::unique_ptr<const api::ComparisonSession>
    open(const JobPlace& place, const ReadJob& job, int threads) const;

private:
    std::lock_guard<std::mutex> alone_;
    raster_gl::PreviousContext previous_;
};

} // namespace gnomon::python
