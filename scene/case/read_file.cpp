#include "scene/case/file.hpp"
#include "scene/case/keys.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/job/setting_layers.hpp"
#include "scene/job/toml.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace gnomon::scene {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 6> job_tables{"light",  "camera", "shadow_map",
                                                     "lookup", "bias",   "method"};

bool is_job_table(std::string_view name)
{
    return std::ranges::find(job_tables, name) != job_tables.end();
}

/// All names that a case.toml may use, to suggest the nearest one.
std::vector<std::string> known_names(const KeyTable& keys)
{
    std::vector<std::string> names{"objects"};
    for (const CaseKey& key : case_keys()) {
        names.push_back(key.name);
        names.push_back(key.name.substr(0, key.name.find('.')));
    }
    for (const Key& spec : keys.rows()) {
        const std::string table = spec.name.substr(0, spec.name.find('.'));
        if (is_job_table(table)) {
            names.push_back(table);
            names.push_back(spec.name);
        }
    }
    return names;
}

[[noreturn]] void refuse_unknown(const KeyTable& keys, const KeyPlace& place,
                                 const std::string& name)
{
    const std::vector<std::string> names = known_names(keys);
    const auto same_leaf = std::ranges::find_if(names, [&](const std::string& known) {
        return known.find('.') != std::string::npos && key_leaf(known) == key_leaf(name);
    });
    throw InputError(
        fmt::format("{}unknown key {}; the nearest is {}", place.text(), toml_excerpt({name}),
                    same_leaf != names.end() ? *same_leaf : nearest_word(name, names)));
}

/// Reads a case.toml, member by member.
class CaseReader {
public:
    CaseReader(CaseDraft& draft, std::string source) : draft_{draft}, source_{std::move(source)} {}

    void read(const TomlTable& table)
    {
        for (const TomlMember& member : table) {
            if (is_job_table(member.key)) {
                job_keys_.push_back(member);
            } else if (member.key == "objects") {
                read_objects(member);
            } else {
                read_own(member, member.key);
            }
        }
        read_job_keys();
    }

private:
    void read_own(const TomlMember& member, const std::string& name)
    {
        const KeyPlace place{source_, member.line};
        const auto& keys = case_keys();
        const auto key = std::ranges::find(keys, name, &CaseKey::name);
        if (key != keys.end()) {
            auto value = read_value(key->domain, member.node);
            const std::string label =
                fmt::format("{}{} = {}", place.text(), name, toml_excerpt(member.node));
            if (!value) {
                throw InputError(
                    fmt::format("{}: {}", label, refusal_text(key->domain, member.node)));
            }
            if (name == "name" || name == "renderer") {
                require_one_line(std::get<std::string>(*value), label);
            }
            Layer& layer = draft_.file.source.file;
            const std::size_t settings = layer.size();
            key->set(draft_, *value);
            if (layer.size() > settings) {
                layer.back().label = label;
            }
            return;
        }
        const auto* nested = std::get_if<TomlTable>(&member.node.value);
        const bool is_table = std::ranges::any_of(
            keys, [&](const CaseKey& known) { return known.name.starts_with(name + "."); });
        if (nested == nullptr || !is_table) {
            refuse_unknown(*draft_.file.source.keys, place, name);
        }
        for (const TomlMember& inner : *nested) {
            read_own(inner, fmt::format("{}.{}", name, inner.key));
        }
    }

    /// Tables, pictures and run files show these texts.
    static void require_one_line(const std::string& text, const std::string& label)
    {
        constexpr std::size_t longest_bytes = 200;
        if (text.size() > longest_bytes || one_line(text) != text) {
            throw InputError(fmt::format("{}: must be one line of at most {} bytes, without "
                                         "control characters",
                                         label, longest_bytes));
        }
    }

    void read_objects(const TomlMember& member)
    {
        const auto* table = std::get_if<TomlTable>(&member.node.value);
        if (table == nullptr) {
            throw InputError(KeyPlace{source_, member.line}.text() +
                             "objects: must be a table, [objects]");
        }
        const IntegerDomain domain{0, 0xFFFFFFFE};
        std::set<std::uint32_t> numbers;
        for (const TomlMember& object : *table) {
            const std::string label =
                fmt::format("{}objects.{} = {}", KeyPlace{source_, object.line}.text(),
                            toml_excerpt({object.key}), toml_excerpt(object.node));
            const auto value = read_value(domain, object.node);
            if (!value) {
                throw InputError(fmt::format("{}: {}", label, refusal_text(domain, object.node)));
            }
            const auto number = static_cast<std::uint32_t>(std::get<std::int64_t>(*value));
            if (!numbers.insert(number).second) {
                throw InputError(label + ": another object has this number; give each its own");
            }
            draft_.file.object_numbers[object.key] = number;
        }
    }

    /// Reads the keys of a job. The camera must be complete or absent.
    void read_job_keys()
    {
        Layer& own = draft_.file.source.file;
        Layer layer = layer_from_table(*draft_.file.source.keys, job_keys_, source_, "",
                                       {"mesh", "conventions", "channels"});
        require_whole_camera(layer);
        if (find(layer, "camera.target") == nullptr) {
            std::erase_if(layer, [](const Setting& setting) {
                return setting.spec->name.starts_with("camera.");
            });
        }
        own.insert(own.end(), layer.begin(), layer.end());
    }

    static const Setting* find(const Layer& layer, std::string_view key)
    {
        const auto found = std::ranges::find_if(
            layer, [&](const Setting& setting) { return setting.spec->name == key; });
        return found == layer.end() ? nullptr : &*found;
    }

    /// The eye alone is useful: it tells which side is visible.
    void require_whole_camera(const Layer& layer) const
    {
        const Setting* eye = find(layer, "camera.eye");
        const Setting* target = find(layer, "camera.target");
        for (const std::string_view key :
             {"camera.up", "camera.vertical_fov_deg", "camera.orthographic_height"}) {
            const Setting* other = find(layer, key);
            if (other != nullptr && target == nullptr) {
                throw InputError(other->label +
                                 ": needs camera.target; camera.eye may stand alone");
            }
        }
        if (target != nullptr && eye == nullptr) {
            throw InputError(target->label + ": needs camera.eye");
        }
        if (eye != nullptr && find(layer, "camera.orthographic_height") == nullptr) {
            draft_.file.eye = rounded_to_float32(std::get<Vec3d>(eye->value));
        }
    }

    CaseDraft& draft_;
    std::string source_;
    TomlTable job_keys_;
};

/// The exporter that the file names. Read first, because the other members override it.
std::string own_exporter(const TomlTable& table)
{
    const auto conventions = std::ranges::find(table, "conventions", &TomlMember::key);
    const auto* keys =
        conventions == table.end() ? nullptr : std::get_if<TomlTable>(&conventions->node.value);
    if (keys == nullptr) {
        return {};
    }
    const auto from = std::ranges::find(*keys, "from", &TomlMember::key);
    const auto* word = from == keys->end() ? nullptr : std::get_if<std::string>(&from->node.value);
    const bool is_known =
        word != nullptr && std::ranges::find(exporter_names(), *word) != exporter_names().end();
    return is_known ? *word : std::string{}; // unknown words are refused later
}

void settle_space(CaseDraft& draft)
{
    const std::string& source = draft.file.source.name;
    if (!draft.up.empty() || !draft.handedness.empty()) {
        if (draft.has_own_axes) {
            throw InputError(source + ": conventions.axes and conventions.up or handedness are "
                                      "mutually exclusive; keep one");
        }
        draft.axes = axes_of(draft.up, draft.handedness);
    }
    if (!draft.axes.empty()) {
        const auto axes = axes_from_words(draft.axes);
        if (!axes) {
            throw InputError(fmt::format("{}: conventions.axes = [{}]: must be x, y and z in any "
                                         "order, each with or without a minus",
                                         source,
                                         one_line(fmt::format("{}", fmt::join(draft.axes, ", ")))));
        }
        draft.file.space.axes = *axes;
    }
    draft.file.space.units_per_mesh_unit =
        draft.mesh_metres_per_unit / draft.file.space.metres_per_unit;
}

/// A complete camera without an up vector uses the mesh's up axis, y.
void settle_up(CaseFile& file)
{
    if (!file.says("camera.target") || file.says("camera.up") || file.space.is_of_mesh()) {
        return;
    }
    file.source.file.push_back(
        {file.source.keys->find("camera.up"), file.space.up_of_mesh(), file.source.name});
}

/// Refuses contradictory meanings of the mask's values.
void require_one_meaning(const CaseFile& file)
{
    const ImageConventions& conventions = file.conventions;
    const auto& range = conventions.mask_range;
    if (range && conventions.lit_above) {
        throw InputError(file.source.name +
                         ": channels.mask_range and channels.lit_above are mutually exclusive; "
                         "keep one");
    }
    if (range && range->front() == range->back()) {
        throw InputError(fmt::format("{}: channels.mask_range = [{}, {}]: the values for shadowed "
                                     "and lit must differ",
                                     file.source.name, range->front(), range->back()));
    }
}

bool shines_parallel(const Layer& layer)
{
    return std::ranges::none_of(layer, [](const Setting& setting) {
        return setting.spec->name == "light.type" &&
               is_positional(light_type_from_name(std::get<std::string>(setting.value)).value());
    });
}

void require_all(const CaseDraft& draft)
{
    const CaseFile& file = draft.file;
    const auto require = [&](bool is_there, std::string_view what) {
        if (!is_there) {
            throw InputError(fmt::format("{}: {}; `gnomon capture-kit` writes a template, "
                                         "`gnomon compare --export-case` an example",
                                         file.source.name, what));
        }
    };
    require(draft.has_schema, "schema = 1 is missing");
    require(!file.renderer.empty(), "renderer is missing: say what made the mask, and where");
    require(file.says("scene.file"), "mesh.file is missing");
    require(file.says_any("light"), "[light] is missing");
    require(!file.says("light.sun.time"),
            "light.sun stands in the axes of a job; give light.direction, in the renderer's axes");
    require(!shines_parallel(file.source.file) || file.says("light.direction") ||
                file.says("light.target"),
            "light.direction is missing");
}

fs::path case_path(const fs::path& path)
{
    std::error_code error;
    return fs::is_directory(path, error) ? path / "case.toml" : path;
}

/// The folder's name, with links and ".." resolved.
std::string folder_name(const fs::path& file)
{
    std::error_code error;
    const fs::path folder = fs::weakly_canonical(fs::absolute(file, error), error).parent_path();
    return one_line(folder.filename().string());
}

/// Resolves files relative to case.toml. `image` comes first and has a default unless other files
/// are given.
void settle_images(CaseFile& file)
{
    if (file.images.empty()) {
        file.images.push_back({"image", "aov.exr", {}, 0});
    }
    std::ranges::stable_partition(
        file.images, [](const CaseImageSource& image) { return image.key == "image"; });
    for (CaseImageSource& image : file.images) {
        image.path = file.source.folder / image.path;
    }
    if (file.map) {
        file.map->path = file.source.folder / file.map->path;
    }
}

} // namespace

CaseFile read_case_file(const fs::path& path, std::string_view from, Keys keys)
{
    CaseDraft draft;
    CaseFile& file = draft.file;
    file.source.keys = std::move(keys);
    file.path = case_path(path);
    file.source.name = one_line(file.path.string());
    file.source.folder = file.path.parent_path();
    file.text = read_text_file(file.path, file.source.name, "case.toml");
    const TomlTable table = parse_toml(file.text, file.source.name);
    const std::string exporter = from.empty() ? own_exporter(table) : std::string{from};
    if (!exporter.empty()) {
        apply_exporter(draft, exporter);
    }
    CaseReader{draft, file.source.name}.read(table);
    settle_space(draft);
    settle_up(file);
    require_all(draft);
    require_one_meaning(file);
    file.name = file.name.empty() ? folder_name(file.path) : file.name;
    settle_images(file);
    try {
        (void)make_job(file.source); // refuses incompatible keys
    } catch (const InputError& error) {
        throw InputError(case_message(file, error.what()));
    }
    return std::move(draft.file);
}

std::string case_message(const CaseFile& file, std::string_view message)
{
    constexpr std::string_view scene_table = "scene.";
    if (message.starts_with(scene_table)) {
        return fmt::format("{}: mesh.{}", file.source.name, message.substr(scene_table.size()));
    }
    const bool is_of_key = std::ranges::any_of(job_tables, [&](std::string_view table) {
        return message.starts_with(table) && message.substr(table.size()).starts_with('.');
    });
    return is_of_key ? fmt::format("{}: {}", file.source.name, message) : std::string{message};
}

} // namespace gnomon::scene
