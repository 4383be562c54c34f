#pragma once

#include "cli/renderer/protocol/renderer_answers.hpp"
#include "cli/renderer/protocol/renderer_error.hpp"
#include "cli/renderer/protocol/renderer_requests.hpp"
#include "cli/renderer/protocol/renderer_start.hpp"
#include "cli/system/guarded_process.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/case/file.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::cli {

/// A frame that a renderer drew, as a case for `analysis::evaluate`.
struct RendererFrame {
    scene::CaseFile file;
    scene::CaseLayers layers;
    double seconds = 0; ///< as the renderer says
};

/// A renderer that was started, by docs/renderer_protocol.md. What breaks a rule of it ends the
/// renderer and is thrown as `RendererFailure`; what the renderer says that it cannot do, as
/// `RendererRefusal`.
class RendererClient {
public:
    using Seconds = GuardedProcess::Seconds;

    /// Starts it, and asks who it is.
    /// @param parent   its files are in a folder there, which is removed when this ends.
    /// @param longest  for each answer.
    /// @throws RendererFailure, scene::EnvironmentError
    RendererClient(RendererCommand command, const std::filesystem::path& parent, Seconds longest);

    [[nodiscard]] const RendererHello& hello() const { return hello_; }

    /// Tells it what to look at.
    /// @param scene  its triangles must outlive what is drawn of it.
    void open(const RendererScene& scene);
    /// The axes and units of the numbers that it gives of what it opened.
    [[nodiscard]] const scene::CaseSpace& space() const { return space_; }

    /// Has it draw what was opened; of its frame nothing stays on the disk.
    [[nodiscard]] RendererFrame draw(const RendererDraw& draw);

    /// What `ask("draw", …)` sends of a request, with the frame's place.
    [[nodiscard]] AnswerJson draw_members(AnswerJson request) const;
    /// Sends a request, and returns the answer to it.
    [[nodiscard]] AnswerJson ask(std::string_view request, AnswerJson members);

    /// Asks it to end, and waits until it has.
    void close();

    /// Files that it left in the run's folder beside its own folder for temporary ones.
    [[nodiscard]] std::vector<std::string> strays() const;

    /// Ends the renderer at once.
    /// @throws RendererFailure  always: who, request and what, and the last words.
    [[noreturn]] void fail(std::string_view request, std::string_view what);

private:
    /// Who is spoken of.
    [[nodiscard]] std::string who() const;
    [[nodiscard]] std::string last_words();
    void require_running(std::string_view request);
    [[nodiscard]] AnswerJson await(std::string_view request, std::int64_t id);
    [[noreturn]] void fail_without_answer(std::string_view request, const AwaitedLine& line);
    /// Before a frame is asked for: files that are older than that are no new ones.
    void empty_frames();
    /// Does the work; what it refuses about the renderer's answer or files fails the request.
    template <typename Work>
    auto in_request(std::string_view request, const Work& work);
    [[nodiscard]] scene::CaseFile read_frame_file(const RendererDraw& draw,
                                                  const DrawnAnswer& drawn);
    void require_plain_files(const DrawnAnswer& drawn, bool has_frame) const;

    RendererCommand command_;
    Seconds longest_;
    std::filesystem::path folder_;
    std::filesystem::file_time_type asked_at_; ///< when its frames were emptied last
    std::optional<GuardedProcess> process_;    ///< empty once it failed or was closed
    std::int64_t last_id_ = 0;
    RendererHello hello_;
    std::optional<RendererScene> scene_;
    AnswerJson conventions_;
    scene::CaseSpace space_;
};

} // namespace gnomon::cli
