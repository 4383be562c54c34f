#include "reports/case/case_read.hpp"

#include "reports/layer_file.hpp"
#include "scene/error.hpp"
#include "scene/job_file.hpp"
#include "scene/job_toml.hpp"
#include "scene/triangles.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::reports {

namespace {

using scene::CaseLayers;
using scene::ImageSize;
using scene::InputError;
using scene::Vec3f;

constexpr const char* case_advice = "write it as docs/evaluate.md says";
constexpr float no_position = std::numeric_limits<float>::quiet_NaN();
/// As of a job's image.
constexpr std::uint64_t most_pixels = 134'217'728;

/// A case's EXR file and how messages speak of it.
class CaseImageFile {
public:
    CaseImageFile(const std::filesystem::path& path, std::uint64_t memory_bytes)
        : name_{scene::one_line(path.string())},
          file_{path, case_advice}
    {
        const ImageSize size = file_.size();
        if (size.pixel_count() > most_pixels) {
            refuse(fmt::format("{}x{} pixels; must be at most {}", size.width_px, size.height_px,
                               most_pixels));
        }
        // What is decoded, and about as much again for the layers and the truth.
        const std::uint64_t needed = file_.decoded_bytes() + 128 * size.pixel_count();
        if (memory_bytes != 0 && needed > memory_bytes) {
            constexpr double gibibyte = 1024.0 * 1024.0 * 1024.0;
            refuse(fmt::format("{}x{} pixels of {} channels need about {:.1f} GiB of memory and "
                               "{:.1f} GiB are available; leave channels out or make it smaller",
                               size.width_px, size.height_px, file_.names().size(),
                               static_cast<double>(needed) / gibibyte,
                               static_cast<double>(memory_bytes) / gibibyte));
        }
    }

    [[nodiscard]] ImageSize size() const { return file_.size(); }

    /// The first of the names that the file has, whole or as a vector; empty if it has none.
    [[nodiscard]] std::string find(const std::vector<std::string>& names,
                                   std::string_view suffix = "")
    {
        for (const std::string& name : names) {
            if (file_.has(fmt::format("{}{}", name, suffix))) {
                return name;
            }
        }
        return {};
    }

    /// A vector's first channel is named .X, .R or .x.
    [[nodiscard]] std::optional<std::array<std::string, 3>>
    find_vector(const std::vector<std::string>& names)
    {
        constexpr std::array<std::array<std::string_view, 3>, 3> endings{
            {{".X", ".Y", ".Z"}, {".R", ".G", ".B"}, {".x", ".y", ".z"}}};
        for (const auto& ending : endings) {
            if (const std::string name = find(names, ending[0]); !name.empty()) {
                return std::array{fmt::format("{}{}", name, ending[0]),
                                  fmt::format("{}{}", name, ending[1]),
                                  fmt::format("{}{}", name, ending[2])};
            }
        }
        return std::nullopt;
    }

    [[nodiscard]] LayerType type(const std::string& name) { return file_.type(name); }

    [[nodiscard]] scene::Image<float> numbers(const std::string& name)
    {
        require(name);
        return file_.numbers(name);
    }

    /// Depths and positions: half would round them away.
    [[nodiscard]] scene::Image<float> exact_numbers(const std::string& name,
                                                    std::string_view why_not_half)
    {
        require(name);
        if (file_.type(name) != LayerType::float32) {
            refuse(fmt::format("channel {} is not 32-bit float: {}", scene::one_line(name),
                               why_not_half));
        }
        return file_.floats(name);
    }

    [[nodiscard]] scene::Image<std::uint32_t> whole_numbers(const std::string& name)
    {
        if (file_.type(name) == LayerType::uint32) {
            return file_.integers(name);
        }
        const scene::Image<float> from = numbers(name);
        scene::Image<std::uint32_t> result{size()};
        for (std::size_t i = 0; i < from.pixel_count(); ++i) {
            constexpr float beyond_whole = 16777216; // 2^24: float32 skips whole numbers above
            const bool is_whole =
                from[i] >= 0 && from[i] <= beyond_whole && from[i] == std::floor(from[i]);
            result[i] = is_whole ? static_cast<std::uint32_t>(from[i])
                                 : std::numeric_limits<std::uint32_t>::max();
        }
        return result;
    }

    [[noreturn]] void refuse(const std::string& what) const
    {
        throw InputError(fmt::format("{}: {}", name_, what));
    }
    [[noreturn]] void refuse_pixel(std::string_view what, std::size_t pixel,
                                   std::string_view remedy) const
    {
        const auto width = static_cast<std::size_t>(size().width_px);
        refuse(fmt::format("{} at pixel ({}, {}): {}", what, pixel % width, pixel / width, remedy));
    }

    /// "channels: R, G, B", cut after some.
    [[nodiscard]] std::string listing()
    {
        std::vector<std::string> names = file_.names();
        const bool is_long = names.size() > 12;
        names.resize(std::min<std::size_t>(names.size(), 12));
        return scene::one_line(
            fmt::format("it has {}{}", fmt::join(names, ", "), is_long ? ", …" : ""));
    }

private:
    void require(const std::string& name)
    {
        const LayerType type = file_.type(name);
        if (type == LayerType::missing) {
            refuse(fmt::format("no channel {}: {}", scene::one_line(name), listing()));
        }
        if (type == LayerType::other) {
            refuse(fmt::format("channel {} is neither half, float nor uint: write it as one",
                               scene::one_line(name)));
        }
    }

    std::string name_;
    LayerFile file_;
};

scene::Image<Vec3f> read_position(CaseImageFile& file, const scene::CaseFile& description)
{
    const auto& names = description.conventions.channels.position;
    const auto channels = file.find_vector(names);
    if (!channels) {
        file.refuse(
            fmt::format("no channel {}.X: the world position of each pixel is required; {}; "
                        "channels.position gives it another name",
                        scene::one_line(names.front()), file.listing()));
    }
    constexpr std::string_view why =
        "near 100 half's step is 0.0625, and no shadow can be judged from there; write full floats";
    const auto x = file.exact_numbers((*channels)[0], why);
    const auto y = file.exact_numbers((*channels)[1], why);
    const auto z = file.exact_numbers((*channels)[2], why);
    scene::Image<Vec3f> position{file.size()};
    for (std::size_t i = 0; i < position.pixel_count(); ++i) {
        position[i] = {x[i], y[i], z[i]};
    }
    return position;
}

bool is_finite(const Vec3f& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Leaves positions where something is to be judged alone.
void drop_positions(CaseImageFile& file, const scene::CaseFile& description,
                    scene::Image<Vec3f>& position)
{
    const std::string valid_name = file.find(description.conventions.channels.valid);
    const auto valid = valid_name.empty() ? scene::Image<float>{} : file.numbers(valid_name);
    const auto& background = description.conventions.background;
    std::size_t judged = 0;
    for (std::size_t i = 0; i < position.pixel_count(); ++i) {
        if (!valid.empty() && std::isnan(valid[i])) {
            file.refuse_pixel("valid is NaN", i, "write 1 or 0");
        }
        const bool is_void = background && Vec3f{*background} == position[i];
        if ((!valid.empty() && valid[i] == 0) || is_void ||
            (valid.empty() && !is_finite(position[i]))) {
            position[i] = Vec3f{no_position};
            continue;
        }
        if (!is_finite(position[i])) {
            file.refuse_pixel("P is not finite", i, "write valid = 0 where nothing is seen");
        }
        const Vec3f size = glm::abs(position[i]);
        if (std::max({size.x, size.y, size.z}) > static_cast<float>(scene::max_coordinate_m)) {
            file.refuse_pixel("P is beyond 1e15", i, "write valid = 0 where nothing is seen");
        }
        ++judged;
    }
    if (judged == 0) {
        file.refuse("no pixel is to be judged: valid is 0 or P not finite everywhere");
    }
}

scene::Image<float> read_mask(CaseImageFile& file, const scene::CaseFile& description,
                              const scene::Image<Vec3f>& position)
{
    const auto& names = description.conventions.channels.shadow;
    const std::string name = file.find(names);
    if (name.empty()) {
        file.refuse(fmt::format("no channel {}: the mask is required; {}; channels.shadow gives it "
                                "another name",
                                scene::one_line(names.front()), file.listing()));
    }
    scene::Image<float> mask = file.numbers(name);
    const auto& lit_above = description.conventions.lit_above;
    for (std::size_t i = 0; i < mask.pixel_count(); ++i) {
        if (!is_finite(position[i])) {
            mask[i] = 0;
        } else if (std::isnan(mask[i])) {
            file.refuse_pixel(fmt::format("{} is NaN", scene::one_line(name)), i,
                              "a mask is 1 where lit, 0 where shadowed; write valid = 0 where "
                              "there is none");
        } else if (lit_above) {
            mask[i] = static_cast<double>(mask[i]) > *lit_above ? 1.0F : 0.0F;
        } else if (!(mask[i] >= 0 && mask[i] <= 1)) {
            file.refuse_pixel(fmt::format("{} = {}", scene::one_line(name), mask[i]), i,
                              "a mask is from 0 to 1; if this is light, set channels.lit_above");
        }
    }
    return mask;
}

constexpr std::string_view why_depths = "half would round depths away; write full floats";

/// Where the lookup ended without a comparison there is no depth.
scene::Image<float> read_depth(CaseImageFile& file, const std::string& name)
{
    return name.empty() ? scene::Image<float>{} : file.exact_numbers(name, why_depths);
}

scene::Image<scene::Vec2f> read_texels(CaseImageFile& file, const std::string& name)
{
    if (file.find({name}, ".X").empty()) {
        return {};
    }
    const auto x = file.exact_numbers(name + ".X", why_depths);
    const auto y = file.exact_numbers(name + ".Y", why_depths);
    scene::Image<scene::Vec2f> texels{file.size()};
    for (std::size_t i = 0; i < texels.pixel_count(); ++i) {
        texels[i] = {x[i], y[i]};
    }
    return texels;
}

scene::LookupLayers read_unmoved(CaseImageFile& file, const scene::Image<float>& tan_theta)
{
    if (file.find({"unmoved.V"}).empty()) {
        return {};
    }
    const auto r = read_depth(file, "unmoved.z.light");
    const auto d = read_depth(file, "unmoved.z.map");
    const auto verdict = file.numbers("unmoved.V");
    scene::LookupLayers unmoved{scene::Image<scene::LookupSample>{file.size()},
                                read_texels(file, "unmoved.texel")};
    for (std::size_t i = 0; i < verdict.pixel_count(); ++i) {
        unmoved.samples[i] = {r[i], d[i], tan_theta.empty() ? 0.0F : tan_theta[i], verdict[i]};
    }
    return unmoved;
}

scene::Image<float> read_map(const std::filesystem::path& path, std::uint64_t memory_bytes)
{
    CaseImageFile file{path, memory_bytes};
    if (file.size().width_px != file.size().height_px) {
        file.refuse(fmt::format("the shadow map is {}x{} texels: it must be square",
                                file.size().width_px, file.size().height_px));
    }
    return file.exact_numbers("map.d", why_depths);
}

} // namespace

CaseLayers read_case_layers(const scene::CaseFile& description, std::uint64_t memory_bytes)
{
    CaseImageFile file{description.image, memory_bytes};
    const scene::ChannelNames& names = description.conventions.channels;
    CaseLayers layers;
    layers.position = read_position(file, description);
    drop_positions(file, description, layers.position);
    layers.mask = read_mask(file, description, layers.position);
    if (const auto normal = file.find_vector(names.normal)) {
        const auto x = file.numbers((*normal)[0]);
        const auto y = file.numbers((*normal)[1]);
        const auto z = file.numbers((*normal)[2]);
        layers.normal = scene::Image<Vec3f>{file.size()};
        for (std::size_t i = 0; i < x.pixel_count(); ++i) {
            layers.normal[i] = {x[i], y[i], z[i]};
        }
    }
    if (const std::string object = file.find(names.object); !object.empty()) {
        layers.object_number = file.whole_numbers(object);
    }
    layers.z_light = read_depth(file, file.find(names.z_light));
    layers.z_map = read_depth(file, file.find(names.z_map));
    layers.texels = read_texels(file, "texel");
    layers.tan_theta = read_depth(file, file.find({"tan_theta"}));
    layers.unmoved = read_unmoved(file, layers.tan_theta);
    if (!description.map.empty()) {
        layers.map_depths = read_map(description.map, memory_bytes);
    }
    return layers;
}

} // namespace gnomon::reports
