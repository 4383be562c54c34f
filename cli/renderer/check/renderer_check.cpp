#include "cli/renderer/check/renderer_check.hpp"

#include "cli/renderer/protocol/renderer_frame.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <variant>

namespace gnomon::cli {
namespace {

/// A rule is broken; `what()` says how.
class BrokenRule : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The ends of a key's range, or every word of a choice.
std::vector<scene::JobValue> extremes(const scene::Domain& domain)
{
    if (const auto* const real = std::get_if<scene::RealDomain>(&domain)) {
        return {real->lower, real->upper};
    }
    if (const auto* const integer = std::get_if<scene::IntegerDomain>(&domain)) {
        return {integer->lower, integer->upper};
    }
    if (const auto* const words = std::get_if<scene::WordDomain>(&domain)) {
        return {words->words.begin(), words->words.end()};
    }
    return {false, true};
}

class RendererCheck {
public:
    RendererCheck(const RendererCommand& command, std::filesystem::path parent,
                  RendererClient::Seconds longest)
        : command_{command},
          parent_{std::move(parent)},
          longest_{longest},
          scenes_{check_scenes()}
    {
    }

    std::vector<RuleFinding> run()
    {
        if (check("hello", [this] { return start(); })) {
            check_lights();
        }
        if (drawable_ != nullptr) {
            check_frames();
        }
        return std::move(findings_);
    }

private:
    /// Checks a rule; false if it is broken.
    /// @param work  returns the evidence, or throws the fault.
    bool check(std::string_view rule, const std::function<std::string()>& work)
    {
        try {
            findings_.push_back({std::string{rule}, true, work()});
            return true;
        } catch (const BrokenRule& error) {
            add_broken(rule, error.what());
        } catch (const RendererRefusal& error) {
            add_broken(rule, error.what());
        } catch (const RendererFailure& error) {
            add_broken(rule, error.what());
            client_.reset(); // it was killed
        }
        return false;
    }

    void add_broken(std::string_view rule, const char* sentence)
    {
        findings_.push_back({std::string{rule}, false, sentence});
    }

    std::string start()
    {
        client_.reset();
        client_.emplace(command_, parent_, longest_);
        const std::size_t keys = client_->hello().keys.size();
        return fmt::format("{}; {} key{} of its own", client_->hello().title(), keys,
                           keys == 1 ? "" : "s");
    }

    /// The renderer; starts it again if it ended.
    RendererClient& running()
    {
        if (!client_) {
            (void)start();
        }
        return *client_;
    }

    /// The renderer, after it opened the scene.
    RendererClient& opened(const CheckScene& scene)
    {
        RendererClient& client = running();
        client.open(scene.scene());
        return client;
    }

    EngineValues defaults()
    {
        EngineValues values;
        for (const EngineKey& key : running().hello().keys) {
            values[key.name] = key.default_value;
        }
        return values;
    }

    RendererFrame draw(const CheckScene& scene) { return running().draw(scene.draw(defaults())); }

    /// Opens and draws each scene. A renderer may refuse lights, but not all of them.
    void check_lights()
    {
        std::optional<RuleFinding> refused;
        for (const CheckScene& scene : scenes_) {
            const std::string light{scene::light_type_name(scene.scene().light.type)};
            try {
                (void)opened(scene);
            } catch (const RendererRefusal& error) {
                refused = {"open", true, fmt::format("a {} light: {}", light, error.what())};
                findings_.push_back(*refused);
                continue;
            } catch (const RendererFailure& error) {
                findings_.push_back({"open", false, error.what()});
                client_.reset();
                return;
            }
            if (!check(fmt::format("draw, {} light", light), [&] { return check_frame(scene); })) {
                return;
            }
            drawable_ = drawable_ != nullptr ? drawable_ : &scene;
        }
        if (drawable_ == nullptr && refused) {
            findings_.push_back({"open", false, "it opens no scene, whatever the light"});
        }
    }

    /// Draws the open scene and compares the frame with the truth.
    std::string check_frame(const CheckScene& scene)
    {
        RendererFrame frame = draw(scene);
        require_new(frame.layers);
        if (std::string complaint = scene.complaint(frame, client_->space()); !complaint.empty()) {
            throw BrokenRule{
                fmt::format("renderer {}: draw: {}", client_->hello().name, complaint)};
        }
        std::string seen = fmt::format("{}x{} pixels in {:.3g} s", frame.layers.size().width_px,
                                       frame.layers.size().height_px, frame.seconds);
        if (drawable_ == nullptr) {
            first_ = std::move(frame.layers);
        }
        return seen;
    }

    void require_new(const scene::CaseLayers& layers) const
    {
        if (drawable_ != nullptr && frame_difference(first_, layers).empty()) {
            throw BrokenRule{fmt::format("renderer {}: draw: an old frame: another scene got the "
                                         "first one's frame",
                                         client_->hello().name)};
        }
    }

    void check_frames()
    {
        check("same frame", [this] { return draws_the_same_twice(); });
        for (const EngineKey& key : hello_keys()) {
            check(fmt::format("engine.{}", key.name), [&] { return draws_with(key); });
        }
        check("keys of the job", [this] { return does_or_refuses_keys(); });
        check("unknown key", [this] { return refuses_unknown_key(); });
        check("no memory", [this] { return forgets(); });
        check("files", [this] { return leaves_no_files(); });
        check("close", [this] {
            running().close();
            return std::string{"ended with status 0"};
        });
    }

    std::vector<EngineKey> hello_keys() { return running().hello().keys; }

    void require_first_frame(const scene::CaseLayers& layers, std::string_view words)
    {
        if (const std::string difference = frame_difference(first_, layers); !difference.empty()) {
            throw BrokenRule{fmt::format("renderer {}: draw: {}: {}", running().hello().name, words,
                                         difference)};
        }
    }

    std::string draws_the_same_twice()
    {
        (void)opened(*drawable_);
        require_first_frame(draw(*drawable_).layers,
                            "two equal requests gave frames that are not equal");
        return "equal requests give equal frames";
    }

    /// Draws with the ends of the key's range; a refusal must name the key.
    std::string draws_with(const EngineKey& key)
    {
        (void)opened(*drawable_);
        std::vector<std::string> refused;
        for (const scene::JobValue& value : extremes(key.domain)) {
            EngineValues values = defaults();
            values[key.name] = value;
            try {
                (void)running().draw(drawable_->draw(values));
            } catch (const RendererRefusal& error) {
                require_named(error.what(), fmt::format("engine.{}", key.name));
                refused.push_back(scene::to_toml(value));
            }
        }
        return refused.empty() ? "drawn at both ends of its range, or with each of its values"
                               : fmt::format("refuses {}", fmt::join(refused, ", "));
    }

    void require_named(const std::string& refusal, const std::string& key)
    {
        if (refusal.find(key) == std::string::npos) {
            throw BrokenRule{fmt::format("{}: the error does not name {}", refusal, key)};
        }
    }

    std::string does_or_refuses_keys()
    {
        (void)opened(*drawable_);
        std::vector<std::string> done;
        std::vector<std::string> refused;
        for (const auto& [key, value] : {std::pair{"shadow_map.resolution", "64"},
                                         {"shadow_map.depth_format", "\"u8\""},
                                         {"shadow_map.cull", "\"front\""},
                                         {"lookup.filter", "\"pcf5\""},
                                         {"lookup.outside", "\"shadowed\""},
                                         {"bias.constant", "0.001"},
                                         {"bias.slope", "0.001"},
                                         {"bias.normal_texels", "1"}}) {
            const CheckScene scene = drawable_->with({{key, value}});
            try {
                (void)draw(scene);
                done.emplace_back(key);
            } catch (const RendererRefusal& error) {
                require_named(error.what(), key);
                refused.emplace_back(key);
            }
        }
        return fmt::format("does {}; refuses {}", fmt::join(done, ", "),
                           refused.empty() ? "none" : fmt::format("{}", fmt::join(refused, ", ")));
    }

    std::string refuses_unknown_key()
    {
        RendererClient& client = opened(*drawable_);
        AnswerJson request = draw_request(drawable_->draw(defaults()));
        request["lookup"]["no_such_key"] = 1;
        try {
            (void)client.ask("draw", client.draw_members(std::move(request)));
        } catch (const RendererRefusal& error) {
            require_named(error.what(), "lookup.no_such_key");
            return "refused by its name";
        }
        throw BrokenRule{
            fmt::format("renderer {}: draw: it says ok to lookup.no_such_key, which it "
                        "cannot know; it must answer with an error by key",
                        client.hello().name)};
    }

    /// Repeats the first frame, after all requests since.
    std::string forgets()
    {
        (void)opened(*drawable_);
        require_first_frame(draw(*drawable_).layers,
                            "after other requests the first one gives another frame than before");
        return "the first frame again after other requests";
    }

    std::string leaves_no_files()
    {
        const auto strays = running().strays();
        if (!strays.empty()) {
            throw BrokenRule{fmt::format(
                "renderer {}: it wrote {} beside its folder: temporary files belong in its "
                "working directory, which is its TMPDIR, and frames where the request says",
                client_->hello().name, said_excerpt(fmt::format("{}", fmt::join(strays, ", "))))};
        }
        return "none beside its own folder and the frames'";
    }

    const RendererCommand& command_;
    std::filesystem::path parent_;
    RendererClient::Seconds longest_;
    std::vector<CheckScene> scenes_;
    std::optional<RendererClient> client_; ///< empty if it ended
    const CheckScene* drawable_ = nullptr; ///< the first scene that was drawn correctly
    scene::CaseLayers first_;              ///< its first frame
    std::vector<RuleFinding> findings_;
};

} // namespace

std::vector<RuleFinding> check_renderer(const RendererCommand& command,
                                        const std::filesystem::path& parent,
                                        RendererClient::Seconds longest)
{
    return RendererCheck{command, parent, longest}.run();
}

} // namespace gnomon::cli
