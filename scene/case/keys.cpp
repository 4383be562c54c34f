#include "scene/case/keys.hpp"

#include "scene/job/keys/key_table.hpp"
#include "scene/job/setting_layers.hpp"

#include <algorithm>
#include <utility>

namespace gnomon::scene {

namespace {

using Names = std::vector<std::string>;

/// An exporter's channels and coordinate system.
struct Exporter {
    std::string name;
    Names axes;
    double metres_per_unit = 1;
    ChannelNames channels; ///< in addition to the standard names
    std::optional<Vec3d> background{};
};

const std::vector<Exporter>& exporters()
{
    static const std::vector<Exporter> all{
        {"blender",
         {"x", "-z", "y"},
         1,
         {{"ViewLayer.Shadow.R", "ViewLayer.Shadow.X", "ViewLayer.Shadow Catcher.R"},
          {},
          {"ViewLayer.Position"},
          {"ViewLayer.Normal"},
          {"ViewLayer.IndexOB.X"},
          {},
          {}},
         Vec3d{0.0}},
        {"falcor", {"x", "y", "z"}, 1, {{"shadow.R"}, {}, {"posW"}, {"faceNormalW"}, {}, {}, {}}},
        {"mitsuba",
         {"x", "y", "z"},
         1,
         {{"shadow.R"}, {}, {"position"}, {"geo_normal"}, {"shape_index.I"}, {}, {}},
         Vec3d{0.0}},
        {"unreal",
         {"x", "z", "y"},
         0.01,
         {{"ShadowMask.R"}, {}, {"WorldPosition"}, {"WorldNormal"}, {}, {}, {}}},
    };
    return all;
}

void append(Names& names, const Names& more)
{
    names.insert(names.end(), more.begin(), more.end());
}

template <typename Value, typename Access>
CaseKey plain_key(std::string name, Domain domain, Access access)
{
    return {std::move(name), std::move(domain), [access](CaseDraft& draft, const JobValue& value) {
                access(draft) = std::get<Value>(value);
            }};
}

/// A key that names a channel, in place of all other names.
CaseKey channel_key(const std::string& leaf, Names ChannelNames::*names)
{
    return {"channels." + leaf, TextDomain{}, [names](CaseDraft& draft, const JobValue& value) {
                draft.file.conventions.channels.*names = {std::get<std::string>(value)};
            }};
}

/// A key that sets a job's key under another name. Every key table has that key.
CaseKey renamed_key(std::string name, std::string_view job_key)
{
    const Domain& domain = own_keys()->find(job_key)->domain;
    return {std::move(name), domain, [job_key](CaseDraft& draft, const JobValue& value) {
                JobSource& source = draft.file.source;
                source.file.push_back({source.keys->find(job_key), value, std::string{job_key}});
            }};
}

/// A key that names a file of the case's image.
CaseKey image_key(const std::string& name, const Names& channels, std::size_t least)
{
    const bool is_raw_alone = name != "image";
    return {name, TextDomain{}, [=](CaseDraft& draft, const JobValue& value) {
                draft.file.images.push_back(
                    {name, std::get<std::string>(value), channels, least, is_raw_alone});
            }};
}

/// Keys of raw files; each file holds one channel or vector.
std::vector<CaseKey> raw_file_keys()
{
    static const std::vector<std::pair<std::string, Names>> files{
        {"position", {"P.X", "P.Y", "P.Z"}},
        {"shadow", {"shadow.V"}},
        {"valid", {"valid"}},
        {"normal", {"Ng.X", "Ng.Y", "Ng.Z"}},
        {"object", {"id.geom"}},
        {"z_light", {"z.light"}},
        {"z_map", {"z.map"}},
        {"texel", {"texel.X", "texel.Y"}},
        {"kernel_axis", {"kernel_axis.X", "kernel_axis.Y"}},
        {"map_index", {"map_index"}},
        {"tan_theta", {"tan_theta"}},
        {"unmoved_shadow", {"unmoved.V"}},
        {"unmoved_z_light", {"unmoved.z.light"}},
        {"unmoved_z_map", {"unmoved.z.map"}},
        {"unmoved_texel", {"unmoved.texel.X", "unmoved.texel.Y"}},
        {"unmoved_kernel_axis", {"unmoved.kernel_axis.X", "unmoved.kernel_axis.Y"}},
        {"unmoved_map_index", {"unmoved.map_index"}}};
    std::vector<CaseKey> keys;
    for (const auto& [leaf, channels] : files) {
        keys.push_back(image_key("files." + leaf, channels, channels.size()));
    }
    return keys;
}

std::vector<CaseKey> file_keys()
{
    constexpr RealDomain unit_m{.lower = 1e-9, .upper = 1e9};
    using Text = std::string;
    return {
        {"schema", IntegerDomain{1, 1},
         [](CaseDraft& draft, const JobValue&) { draft.has_schema = true; }},
        plain_key<Text>(
            "name", TextDomain{}, [](CaseDraft & draft) -> auto& { return draft.file.name; }),
        plain_key<Text>(
            "renderer", TextDomain{},
            [](CaseDraft & draft) -> auto& { return draft.file.renderer; }),
        // A raw file may lack the mask, which is then a separate file.
        image_key("image", {"P.X", "P.Y", "P.Z", "shadow.V"}, 3),
        {"map.file", TextDomain{},
         [](CaseDraft& draft, const JobValue& value) {
             draft.file.map = {"map.file", std::get<Text>(value), {"map.d"}, 1};
         }},
        renamed_key("mesh.file", "scene.file"),
        renamed_key("mesh.no_cast", "scene.no_cast"),
        renamed_key("mesh.no_receive", "scene.no_receive"),
        {"conventions.from", WordDomain{exporter_names()}, [](CaseDraft&, const JobValue&) {}},
        plain_key<Text>(
            "conventions.up", WordDomain{{"y", "z"}},
            [](CaseDraft & draft) -> auto& { return draft.up; }),
        plain_key<Text>(
            "conventions.handedness", WordDomain{{"right", "left"}},
            [](CaseDraft & draft) -> auto& { return draft.handedness; }),
        {"conventions.axes", TextListDomain{},
         [](CaseDraft& draft, const JobValue& value) {
             draft.axes = std::get<Names>(value);
             draft.has_own_axes = true;
         }},
        plain_key<double>(
            "conventions.metres_per_unit", unit_m,
            [](CaseDraft & draft) -> auto& { return draft.file.space.metres_per_unit; }),
        plain_key<double>(
            "conventions.mesh_metres_per_unit", unit_m,
            [](CaseDraft & draft) -> auto& { return draft.mesh_metres_per_unit; }),
        {"conventions.rows", WordDomain{{"top_down", "bottom_up"}},
         [](CaseDraft& draft, const JobValue& value) {
             draft.file.conventions.is_bottom_up = std::get<Text>(value) == "bottom_up";
         }},
        plain_key<Vec3d>(
            "conventions.background", VectorDomain{},
            [](CaseDraft & draft) -> auto& { return draft.file.conventions.background; }),
    };
}

std::vector<CaseKey> channel_keys()
{
    return {
        channel_key("shadow", &ChannelNames::shadow),
        channel_key("valid", &ChannelNames::valid),
        channel_key("position", &ChannelNames::position),
        channel_key("normal", &ChannelNames::normal),
        channel_key("object", &ChannelNames::object),
        channel_key("z_light", &ChannelNames::z_light),
        channel_key("z_map", &ChannelNames::z_map),
        plain_key<double>(
            "channels.lit_above", RealDomain{.lower = -1e30, .upper = 1e30},
            [](CaseDraft & draft) -> auto& { return draft.file.conventions.lit_above; }),
        {"channels.mask_range", VectorDomain{.zero_allowed = true, .size = 2},
         [](CaseDraft& draft, const JobValue& value) {
             const Vec3d range = std::get<Vec3d>(value);
             draft.file.conventions.mask_range = {range.x, range.y};
         }},
        plain_key<bool>(
            "channels.fractions", FlagDomain{},
            [](CaseDraft & draft) -> auto& { return draft.file.conventions.has_fractions; }),
    };
}

} // namespace

const std::vector<CaseKey>& case_keys()
{
    static const std::vector<CaseKey> keys = [] {
        std::vector<CaseKey> all = file_keys();
        for (auto* const more : {&raw_file_keys, &channel_keys}) {
            for (CaseKey& key : more()) {
                all.push_back(std::move(key));
            }
        }
        return all;
    }();
    return keys;
}

const std::vector<std::string>& exporter_names()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const Exporter& exporter : exporters()) {
            all.push_back(exporter.name);
        }
        return all;
    }();
    return names;
}

void apply_exporter(CaseDraft& draft, std::string_view exporter)
{
    const auto found = std::ranges::find(exporters(), exporter, &Exporter::name);
    draft.axes = found->axes;
    draft.file.space.metres_per_unit = found->metres_per_unit;
    draft.file.conventions.background = found->background;
    ChannelNames& channels = draft.file.conventions.channels;
    for (const auto names : {&ChannelNames::shadow, &ChannelNames::valid, &ChannelNames::position,
                             &ChannelNames::normal, &ChannelNames::object, &ChannelNames::z_light,
                             &ChannelNames::z_map}) {
        append(channels.*names, found->channels.*names);
    }
}

std::optional<std::array<CaseSpace::Axis, 3>> axes_from_words(const std::vector<std::string>& words)
{
    std::array<CaseSpace::Axis, 3> axes{};
    std::array<bool, 3> is_taken{};
    if (words.size() != axes.size()) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < axes.size(); ++i) {
        std::string_view word = words[i];
        const bool is_opposite = word.starts_with('-');
        word.remove_prefix(is_opposite ? 1 : 0);
        if (word.size() != 1 || word[0] < 'x' || word[0] > 'z' ||
            is_taken[static_cast<std::size_t>(word[0] - 'x')]) {
            return std::nullopt;
        }
        is_taken[static_cast<std::size_t>(word[0] - 'x')] = true;
        axes[i] = {word[0] - 'x', is_opposite ? -1.0 : 1.0};
    }
    return axes;
}

std::vector<std::string> axes_of(std::string_view up, std::string_view handedness)
{
    const bool is_left = handedness == "left";
    if (up == "z") {
        return is_left ? Names{"x", "z", "y"} : Names{"x", "-z", "y"};
    }
    return {"x", "y", is_left ? "-z" : "z"};
}

} // namespace gnomon::scene
