#include "cli/renderer/protocol/renderer_client.hpp"

#include "api/memory.hpp"
#include "cli/renderer/protocol/answer_object.hpp"
#include "cli/renderer/protocol/renderer_frame.hpp"
#include "cli/system/process.hpp"
#include "scene/case/file.hpp"
#include "store/case/case_files.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <system_error>
#include <utility>

namespace gnomon::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* mesh_file = "mesh.glb";
constexpr const char* mesh_from_frames = "../mesh.glb";
/// How long the process may take to end after it was asked to, or after its streams ended.
constexpr RendererClient::Seconds ending_time{5.0};
constexpr std::size_t longest_file_name = 255; ///< [bytes]

fs::path new_folder(const fs::path& parent)
{
    fs::path folder = make_temporary_folder(parent, "gnomon-renderer");
    std::error_code error;
    fs::create_directory(folder / "frames", error);
    require_call(error.value(), "mkdir");
    return folder;
}

bool is_plain_name(const std::string& name)
{
    return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos;
}

/// Removes from a message the temporary folder, and the line in the case.toml that Gnomon wrote.
std::string without_temporary_paths(std::string what, const fs::path& frames)
{
    const std::string place = frames.string() + "/";
    for (std::size_t at = what.find(place); at != std::string::npos; at = what.find(place)) {
        what.erase(at, place.size());
    }
    if (what.starts_with(frame_case_file)) {
        what.erase(0, what.find(": ") + 2);
    }
    return what;
}

std::string ending_text(int status)
{
    constexpr int signals_from = 128;
    return status > signals_from ? fmt::format("signal {} ended it", status - signals_from)
                                 : fmt::format("it ended with exit status {}", status);
}

} // namespace

template <typename Work>
auto RendererClient::in_request(std::string_view request, const Work& work)
{
    try {
        return work();
    } catch (const BadAnswer& error) {
        fail(request, error.what());
    } catch (const scene::InputError& error) {
        fail(request, without_temporary_paths(error.what(), folder_ / "frames"));
    }
}

RendererClient::RendererClient(RendererCommand command, const fs::path& parent, Seconds longest)
    : command_{std::move(command)},
      longest_{longest},
      folder_{new_folder(parent)}
{
    try {
        process_.emplace(command_.words, folder_);
    } catch (...) {
        std::error_code error;
        fs::remove_all(folder_, error);
        throw;
    }
    const AnswerJson answer = ask("hello", {{"hello", protocol_version}});
    hello_ = in_request("hello", [&] { return read_hello(answer); });
}

std::string RendererClient::who() const
{
    return fmt::format("renderer {}", hello_.name.empty() ? command_.name : hello_.name);
}

std::string RendererClient::last_words()
{
    const std::string words = process_ ? last_lines(process_->last_errors()) : std::string{};
    return words.empty() ? std::string{} : fmt::format("; its last words: {}", words);
}

void RendererClient::fail(std::string_view request, std::string_view what)
{
    const std::string message = fmt::format("{}: {}: {}{}", who(), request, what, last_words());
    process_.reset();
    throw RendererFailure(message);
}

void RendererClient::require_running(std::string_view request)
{
    if (!process_) {
        throw RendererFailure(fmt::format("{}: {}: it is no longer running", who(), request));
    }
}

void RendererClient::fail_without_answer(std::string_view request, const AwaitedLine& line)
{
    switch (line.end) {
    case AwaitedLine::End::too_long:
        fail(request, fmt::format("more than {} bytes without an end of line: \"{}\"",
                                  GuardedProcess::longest_line, said_excerpt(line.text)));
    case AwaitedLine::End::ended: {
        const auto status = process_->wait(ending_time);
        fail(request, fmt::format("no answer: {}{}",
                                  status ? ending_text(*status) : "it closed its standard output",
                                  hello_.name.empty() ? start_problems(command_) : std::string{}));
    }
    case AwaitedLine::End::timeout:
    case AwaitedLine::End::line:
        break;
    }
    fail(request, fmt::format("no answer within {:g} s (--renderer-timeout-s)", longest_.count()));
}

AnswerJson RendererClient::await(std::string_view request, std::int64_t id)
{
    const AwaitedLine line = process_->read_line(longest_);
    if (line.end != AwaitedLine::End::line) {
        fail_without_answer(request, line);
    }
    AnswerJson answer = in_request(request, [&] { return parse_answer(line.text); });
    const auto found = answer.find("id");
    if (found == answer.end() || *found != id) {
        fail(request, fmt::format("the answer's id is {}; it was asked {}",
                                  found == answer.end() ? "missing" : answer_excerpt(*found), id));
    }
    return answer;
}

AnswerJson RendererClient::draw_members(AnswerJson request) const
{
    return {{"draw", std::move(request)}, {"frame", (folder_ / "frames" / frame_file).string()}};
}

AnswerJson RendererClient::ask(std::string_view request, AnswerJson members)
{
    require_running(request);
    if (process_->has_more()) {
        const AwaitedLine line = process_->read_line(Seconds{0});
        fail(request, fmt::format("it had said more than it was asked for: \"{}\"",
                                  said_excerpt(line.text)));
    }
    const std::int64_t id = ++last_id_;
    AnswerJson message{{"id", id}};
    message.update(members);
    const std::string text = message.dump(-1, ' ', false, AnswerJson::error_handler_t::replace);
    if (!process_->write_line(text, longest_)) {
        fail(request, fmt::format("it does not read its standard input: the request was not taken "
                                  "within {:g} s (--renderer-timeout-s)",
                                  longest_.count()));
    }
    AnswerJson answer = await(request, id);
    const auto errors = in_request(request, [&] { return read_errors(answer); });
    if (!errors.empty()) {
        std::vector<std::string> texts;
        for (const auto& [key, sentence] : errors) {
            texts.push_back(key.empty() ? sentence : fmt::format("{}: {}", key, sentence));
        }
        throw RendererRefusal(
            fmt::format("{}: {}: cannot do it: {}", who(), request, fmt::join(texts, "; ")));
    }
    return answer;
}

void RendererClient::open(const RendererScene& scene)
{
    require_running("open");
    const fs::path mesh = folder_ / mesh_file;
    store::write_file(mesh, store::encode_glb(scene.triangles));
    const AnswerJson answer = ask("open", {{"open", open_request(scene, mesh)}});
    in_request("open", [&] {
        conventions_ = read_opened(answer);
        // A minimal case, so that its conventions are read as any case's.
        const fs::path path = folder_ / "frames" / frame_case_file;
        store::write_file(path, fmt::format("schema = 1\nrenderer = \"?\"\n{}{}",
                                            toml_table("mesh", {{"file", mesh_from_frames}}),
                                            toml_table("light", {{"direction", {0, -1, 0}}})) +
                                    toml_table("conventions", conventions_));
        space_ = scene::read_case_file(path).space;
    });
    empty_frames();
    scene_.emplace(scene);
}

void RendererClient::empty_frames()
{
    std::error_code error;
    fs::remove_all(folder_ / "frames", error);
    fs::create_directory(folder_ / "frames", error);
    require_call(error.value(), "emptying the renderer's frames");
    asked_at_ = fs::last_write_time(folder_ / "frames", error); // by the file system's clock
    require_call(error.value(), "stat of the renderer's frames");
}

void RendererClient::require_plain_files(const DrawnAnswer& drawn, bool has_frame) const
{
    std::vector<std::pair<std::string, std::string>> named;
    for (const auto& [key, file] : drawn.files) {
        named.emplace_back("files." + key, file);
    }
    if (const auto map = drawn.tables.find("map"); map != drawn.tables.end()) {
        named.emplace_back("case.map.file",
                           AnswerObject{*map, "case.map"}.text("file", longest_file_name));
    }
    if (has_frame) {
        named.emplace_back("the frame", frame_file);
    }
    if (!has_frame && drawn.files.empty()) {
        throw BadAnswer(fmt::format("it says ok, but there is no frame: {} was not written, and "
                                    "`files` names none",
                                    frame_file));
    }
    for (const auto& [key, file] : named) {
        if (!is_plain_name(file)) {
            throw BadAnswer(fmt::format("{} is \"{}\"; files are named without a folder, and are "
                                        "beside the frame",
                                        key, said_excerpt(file)));
        }
        std::error_code error;
        const fs::path path = folder_ / "frames" / file;
        const auto type = fs::symlink_status(path, error).type();
        if (type != fs::file_type::regular) {
            throw BadAnswer(fmt::format("{} is \"{}\"; {}", key, said_excerpt(file),
                                        type == fs::file_type::not_found
                                            ? "there is no such file beside the frame"
                                            : "that is no plain file"));
        }
        if (const Seconds age = asked_at_ - fs::last_write_time(path, error); age.count() > 0) {
            throw BadAnswer(fmt::format("{}: an old frame: \"{}\" was written {:.3g} s before it "
                                        "was asked for",
                                        key, said_excerpt(file), age.count()));
        }
    }
}

scene::CaseFile RendererClient::read_frame_file(const RendererDraw& draw, const DrawnAnswer& drawn)
{
    const fs::path frames = folder_ / "frames";
    std::error_code error;
    const auto frame = fs::symlink_status(frames / frame_file, error);
    const bool has_frame = frame.type() != fs::file_type::not_found;
    require_plain_files(drawn, has_frame);
    const fs::path path = frames / frame_case_file;
    store::write_file(path, frame_case(hello_, *scene_, draw, drawn, conventions_, space_,
                                       mesh_from_frames, has_frame));
    return scene::read_case_file(path, {}, scene::key_table_of(draw.job));
}

RendererFrame RendererClient::draw(const RendererDraw& draw)
{
    require_running("draw");
    empty_frames();
    const AnswerJson answer = ask("draw", draw_members(draw_request(draw)));
    RendererFrame result = in_request("draw", [&] {
        const DrawnAnswer drawn = read_drawn(answer);
        scene::CaseFile file = read_frame_file(draw, drawn);
        scene::CaseLayers layers = store::read_case_layers(file, api::available_memory_bytes());
        if (layers.size() != scene_->image) {
            throw BadAnswer(fmt::format("the frame has {}x{} pixels; {}x{} were asked for",
                                        layers.size().width_px, layers.size().height_px,
                                        scene_->image.width_px, scene_->image.height_px));
        }
        return RendererFrame{std::move(file), std::move(layers), drawn.seconds};
    });
    empty_frames();
    return result;
}

void RendererClient::close()
{
    require_running("close");
    AnswerJson message{{"id", ++last_id_}, {"close", true}};
    (void)process_->write_line(message.dump(), longest_);
    process_->close_input();
    const auto status = process_->wait(ending_time);
    if (!status) {
        fail("close", fmt::format("it did not end within {:g} s", ending_time.count()));
    }
    if (*status != 0) {
        fail("close", fmt::format("{}; it must be 0", ending_text(*status)));
    }
    if (process_->has_more()) {
        const AwaitedLine line = process_->read_line(Seconds{0});
        fail("close",
             fmt::format("it said more than it was asked for: \"{}\"", said_excerpt(line.text)));
    }
    process_.reset();
}

std::vector<std::string> RendererClient::strays() const
{
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator entry{folder_, error}; !error && entry != fs::directory_iterator{};
         entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name != "work" && name != "frames" && name != mesh_file) {
            names.push_back(name);
        }
    }
    return names;
}

} // namespace gnomon::cli
