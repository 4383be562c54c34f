#pragma once

#include "cli/renderer/protocol/renderer_answers.hpp"
#include "cli/renderer/protocol/renderer_command.hpp"
#include "cli/renderer/protocol/renderer_requests.hpp"
#include "cli/system/guarded_process.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/case/file.hpp"
#include "scene/error.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::cli {

/// A renderer died, hung, or broke a rule of docs/renderer_protocol.md; `what()` names the
/// renderer, the request and the answer, and ends with the end of its stderr.
class RendererFailure : public scene::EnvironmentError {
public:
    using EnvironmentError::EnvironmentError;
};

/// A renderer answered that it cannot do what a key asks for. It goes on running.
class RendererRefusal : public scene::InputError {
public:
    using InputError::InputError;
};

/// A frame that a renderer drew, as a case for `analysis::evaluate`.
struct RendererFrame {
    scene::CaseFile file;
    scene::CaseLayers layers;
    double seconds = 0; ///< as the renderer says
};

/// A running renderer that speaks docs/renderer_protocol.md. If it breaks a rule, it is killed and
/// `RendererFailure` is thrown; if it answers with an error, `RendererRefusal`.
class RendererClient {
public:
    using Seconds = GuardedProcess::Seconds;

    /// Starts it, and sends `hello`.
    /// @param parent   holds a temporary folder for its files, until the destructor removes it.
    /// @param longest  the longest time for each answer.
    /// @throws RendererFailure, scene::EnvironmentError
    RendererClient(RendererCommand command, const std::filesystem::path& parent, Seconds longest);

    [[nodiscard]] const RendererHello& hello() const { return hello_; }

    /// @param scene  its triangles must live until the next `open`.
    void open(const RendererScene& scene);
    /// The axes and units of the renderer's numbers, for the open scene.
    [[nodiscard]] const scene::CaseSpace& space() const { return space_; }

    /// Draws the open scene, reads the frame and removes its files.
    [[nodiscard]] RendererFrame draw(const RendererDraw& draw);

    /// The members of a `draw` request, with the path for the frame.
    [[nodiscard]] AnswerJson draw_members(AnswerJson request) const;
    /// Sends a request and waits for its answer.
    [[nodiscard]] AnswerJson ask(std::string_view request, AnswerJson members);

    /// Asks it to end, and waits for that.
    void close();

    /// Files that it wrote outside its working folder and the frames' folder.
    [[nodiscard]] std::vector<std::string> strays() const;

    /// Kills the renderer.
    /// @throws RendererFailure  always.
    [[noreturn]] void fail(std::string_view request, std::string_view what);

private:
    /// "renderer NAME", for messages.
    [[nodiscard]] std::string who() const;
    /// The end of its stderr, for messages.
    [[nodiscard]] std::string last_words();
    void require_running(std::string_view request);
    [[nodiscard]] AnswerJson await(std::string_view request, std::int64_t id);
    [[noreturn]] void fail_without_answer(std::string_view request, const AwaitedLine& line);
    /// Empties the frames' folder and notes the time: older files are not part of the next frame.
    void empty_frames();
    /// Runs the work; errors in the renderer's answer or files fail the request.
    template <typename Work>
    auto in_request(std::string_view request, const Work& work);
    [[nodiscard]] scene::CaseFile read_frame_file(const RendererDraw& draw,
                                                  const DrawnAnswer& drawn);
    void require_plain_files(const DrawnAnswer& drawn, bool has_frame) const;

    RendererCommand command_;
    Seconds longest_;
    std::filesystem::path folder_;
    std::filesystem::file_time_type asked_at_; ///< when the frames' folder was emptied
    std::optional<GuardedProcess> process_;    ///< empty once it failed or was closed
    std::int64_t last_id_ = 0;
    RendererHello hello_;
    std::optional<RendererScene> scene_;
    AnswerJson conventions_;
    scene::CaseSpace space_;
};

} // namespace gnomon::cli
