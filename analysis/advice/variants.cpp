#include "analysis/advice/variants.hpp"

#include "analysis/advice/map_fit.hpp"
#include "methods/job_method.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

namespace gnomon::analysis {

using scene::Job;

namespace {

constexpr int largest_resolution_texels = 16384;

class Variants {
public:
    explicit Variants(const Comparison& comparison)
        : job_{comparison.job},
          causes_{comparison.diagnosis->causes},
          tried_{{job_, {}, false}}
    {
    }

    [[nodiscard]] bool has(Cause cause) const
    {
        return causes_.counts.of(cause) > 0 || causes_.amounts.of(cause) > 0;
    }
    [[nodiscard]] bool has(Label label) const
    {
        return causes_.counts.of(label) > 0 || causes_.amounts.of(label) > 0;
    }

    /// @param keys          "KEY = VALUE"; does nothing if the job's method lacks one.
    /// @param mends_a_bias  As in `Variant`.
    template <typename Change>
    void add(std::vector<std::string> keys, const Change& change, bool mends_a_bias = false)
    {
        const auto has = [&](std::string_view key) {
            return scene::has_key(job_, key.substr(0, key.find(' ')));
        };
        if (!std::ranges::all_of(keys, has)) {
            return;
        }
        tried_.push_back({job_, std::move(keys), mends_a_bias});
        change(tried_.back().job);
    }

    [[nodiscard]] const Job& job() const { return job_; }
    [[nodiscard]] std::vector<Variant> take() { return std::move(tried_); }

private:
    const Job& job_;
    const CauseLayers& causes_;
    std::vector<Variant> tried_;
};

/// The numbers that the job sets for a bias term, scaled, as keys and values.
std::vector<std::pair<std::string_view, double>>
changed_numbers(const Job& job, const methods::BiasTerm& term, double factor)
{
    std::vector<std::pair<std::string_view, double>> changed;
    for (const std::string_view key : term.keys) {
        const scene::Key* const spec = scene::keys_of(job).find(key);
        const auto value = spec != nullptr ? spec->get(job) : std::nullopt;
        const double* const number = value ? std::get_if<double>(&*value) : nullptr;
        if (number != nullptr && *number != 0) {
            changed.emplace_back(key, factor == 0 ? 0.0 : factor * *number);
        }
    }
    return changed;
}

/// Scales the numbers of a bias term: 0 removes it, 0.5 halves it, −1 reverses it.
void add_scaled_term(Variants& variants, const methods::BiasTerm& term, double factor)
{
    const auto numbers = changed_numbers(variants.job(), term, factor);
    if (numbers.empty()) {
        return;
    }
    std::vector<std::string> keys;
    for (const auto& [key, value] : numbers) {
        keys.push_back(fmt::format("{} = {}", key, value));
    }
    variants.add(
        std::move(keys),
        [&](Job& job) {
            for (const auto& [key, value] : numbers) {
                scene::keys_of(job).find(key)->set(job, value);
            }
        },
        true);
}

/// Removes the words that switch a bias term on.
void add_without_words(Variants& variants, const methods::BiasTerm& term)
{
    for (const std::string_view key : term.keys) {
        const scene::Key* row = scene::keys_of(variants.job()).find(key);
        if (row == nullptr) {
            continue;
        }
        const auto neutral = scene::default_of(*row, variants.job());
        if (neutral && std::holds_alternative<std::string>(*neutral) &&
            scene::value_in(*row, variants.job()) != neutral) {
            variants.add(
                {fmt::format("{} = {}", key, row->default_text)},
                [&](Job& job) { row->set(job, *neutral); }, true);
        }
    }
}

/// Changes the biases that the job sets besides the constant one, since they may be at fault:
/// removes each, halves it, and reverses it if drawn into the map.
void add_mended_biases(Variants& variants)
{
    const bool may_be_at_fault =
        variants.has(Cause::bias) || variants.has(Label::acne) || variants.has(Label::overshadow);
    if (!may_be_at_fault) {
        return;
    }
    constexpr std::size_t first = 1; // index 0 is the constant, which the bias curve covers
    const auto terms = methods::method_of(variants.job()).bias_terms;
    for (const methods::BiasTerm& term : terms.subspan(std::min(first, terms.size()))) {
        add_scaled_term(variants, term, 0);
        add_without_words(variants, term);
        add_scaled_term(variants, term, 0.5);
        if (term.place == methods::BiasPlace::map_drawn) {
            add_scaled_term(variants, term, -1);
        }
    }
}

/// Biases that spare the surfaces that need none.
void add_biases(Variants& variants, const std::optional<BiasAnswers>& answers)
{
    if (variants.has(Label::acne) && answers) {
        const float slope = answers->slopes[answers->best_slope].slope;
        if (slope > 0) {
            variants.add({fmt::format("bias.slope = {}", slope)},
                         [slope](Job& job) { job.bias.slope = double{slope}; });
        }
    }
    if (variants.has(Label::acne) && variants.job().bias.normal_texels == 0) {
        variants.add({"bias.normal_texels = 1"}, [](Job& job) { job.bias.normal_texels = 1; });
    }
}

/// Maps with a higher resolution.
void add_finer_maps(Variants& variants)
{
    const int resolution = 2 * variants.job().shadow_map.resolution_texels;
    const bool is_coarse = variants.has(Cause::resolution) || variants.has(Cause::filter);
    if (is_coarse && resolution <= largest_resolution_texels) {
        variants.add({fmt::format("shadow_map.resolution = {}", resolution)},
                     [resolution](Job& job) { job.shadow_map.resolution_texels = resolution; });
    }
    const bool can_fit = scene::map_layout(variants.job()) == scene::MapLayout::single;
    if (is_coarse && can_fit && variants.job().shadow_map.frustum.fit == scene::Fit::scene) {
        variants.add({"shadow_map." + fit_setting(scene::Fit::scene, scene::Fit::camera)},
                     [](Job& job) { job.shadow_map.frustum.fit = scene::Fit::camera; });
    }
    if (variants.has(Label::edge) && methods::traits(variants.job()).has_one_tap()) {
        variants.add({"lookup.filter = \"pcf3\""},
                     [](Job& job) { job.lookup.filter = scene::Filter::pcf3; });
    }
}

/// Also empty if the outside of the map would be in shadow, or if a fixed map has another middle.
std::optional<double> half_extent_of_shadows_m(const Comparison& comparison)
{
    if (comparison.job.lookup.outside == scene::Outside::shadowed ||
        comparison.job.shadow_map.frustum.fit == scene::Fit::camera) {
        return std::nullopt;
    }
    return half_extent_m(reach_of_shadows_m(*comparison.triangles, comparison.view,
                                            comparison.receivers.triangle,
                                            comparison.truth.pixel_class),
                         comparison.view.first_map());
}

/// Adds cascades for a directional light, and a map around the shadows: finer where it matters, at
/// equal size.
void add_maps_of_as_many_bytes(Variants& variants, const Comparison& comparison)
{
    const Job& own = variants.job();
    const bool is_coarse =
        variants.has(Cause::resolution) || variants.has(Cause::filter) || variants.has(Label::acne);
    if (!is_coarse || comparison.view.light.has_position() ||
        scene::map_layout(own) != scene::MapLayout::single) {
        return;
    }
    constexpr int cascades = 4; // of half the width and height, hence equally many texels
    const int resolution = own.shadow_map.resolution_texels / 2;
    if (resolution > 0) {
        const std::vector<std::string> keys{"shadow_map.layout = \"cascades\"",
                                            fmt::format("shadow_map.cascades = {}", cascades),
                                            fmt::format("shadow_map.resolution = {}", resolution)};
        const auto cascaded = [&](Job& job) {
            job.shadow_map.layout = scene::MapLayout::cascades;
            job.shadow_map.cascades.count = cascades;
            job.shadow_map.resolution_texels = resolution;
        };
        variants.add(keys, cascaded);
        // If the camera's far plane lies behind the whole subject, a single cascade covers the
        // subject unless splits are nearly logarithmic.
        std::vector<std::string> split = keys;
        split.emplace_back("shadow_map.split = \"logarithmic\"");
        variants.add(std::move(split), [&](Job& job) {
            cascaded(job);
            job.shadow_map.cascades.split = scene::CascadeSplit::logarithmic;
        });
    }
    if (const auto half_m = half_extent_of_shadows_m(comparison)) {
        std::vector<std::string> keys{fmt::format("shadow_map.half_extent = {}", *half_m)};
        if (own.shadow_map.frustum.fit != scene::Fit::fixed) {
            keys.insert(keys.begin(), "shadow_map.fit = \"fixed\"");
        }
        variants.add(std::move(keys), [&](Job& job) {
            job.shadow_map.frustum.fit = scene::Fit::fixed;
            job.shadow_map.frustum.half_extent_m = *half_m;
        });
    }
}

/// Adds cascades with a higher resolution: more of them, a split that favours near distances, and
/// boxes instead of spheres.
void add_finer_cascades(Variants& variants)
{
    const bool is_coarse = variants.has(Cause::resolution) || variants.has(Cause::filter);
    if (!is_coarse || scene::map_layout(variants.job()) != scene::MapLayout::cascades) {
        return;
    }
    const scene::CascadeSettings& own = variants.job().shadow_map.cascades;
    if (own.count < scene::most_cascades) {
        const int count = std::min(2 * own.count, scene::most_cascades);
        variants.add({fmt::format("shadow_map.cascades = {}", count)},
                     [count](Job& job) { job.shadow_map.cascades.count = count; });
    }
    for (const double lambda : {0.5, 0.9}) {
        if (own.split == scene::CascadeSplit::practical && own.split_lambda == lambda) {
            continue;
        }
        variants.add({"shadow_map.split = \"practical\"",
                      fmt::format("shadow_map.split_lambda = {}", lambda)},
                     [lambda](Job& job) {
                         job.shadow_map.cascades.split = scene::CascadeSplit::practical;
                         job.shadow_map.cascades.split_lambda = lambda;
                     });
    }
    if (own.fit == scene::CascadeFit::stabilised) {
        variants.add({"shadow_map.cascade_fit = \"tight\""},
                     [](Job& job) { job.shadow_map.cascades.fit = scene::CascadeFit::tight; });
    }
}

/// Maps that store depths more precisely.
void add_finer_depths(Variants& variants)
{
    const scene::ShadowMapSettings& map = variants.job().shadow_map;
    const bool has_float32 = traits_of(map.depth_format).significant_bits ==
                             traits_of(scene::float_depth_format).significant_bits;
    if (variants.has(Cause::precision) && !has_float32) {
        variants.add({"shadow_map.depth_format = \"d32f\""},
                     [](Job& job) { job.shadow_map.depth_format = scene::float_depth_format; });
    }
    const bool is_fitted = !map.frustum.near_m && !map.frustum.far_m;
    if (!is_fitted) {
        variants.add({"shadow_map.near = \"auto\"", "shadow_map.far = \"auto\""}, [](Job& job) {
            job.shadow_map.frustum.near_m.reset();
            job.shadow_map.frustum.far_m.reset();
        });
    }
}

/// Cascades from the nearest receiver to the farthest.
void add_fitted_cascades(Variants& variants)
{
    const scene::CascadeSettings& cascades = variants.job().shadow_map.cascades;
    if (scene::map_layout(variants.job()) != scene::MapLayout::cascades ||
        (!cascades.near_m && !cascades.far_m)) {
        return;
    }
    std::vector<std::string> keys{"shadow_map.cascade_near = \"auto\"",
                                  "shadow_map.cascade_far = \"auto\""};
    if (cascades.fit == scene::CascadeFit::stabilised) { // not allowed with auto
        keys.emplace_back("shadow_map.cascade_fit = \"tight\"");
    }
    variants.add(std::move(keys), [](Job& job) {
        job.shadow_map.cascades.near_m.reset();
        job.shadow_map.cascades.far_m.reset();
        job.shadow_map.cascades.fit = scene::CascadeFit::tight;
    });
}

/// Whether no scored pixel reads some map, so that its resolution is wasted.
bool has_unread_map(const Comparison& comparison)
{
    return std::ranges::any_of(comparison.diagnosis->by_map, [](const MapErrors& map) {
        return map.counts.lit + map.counts.blocked == 0;
    });
}

/// Maps that cover more.
void add_wider_maps(Variants& variants)
{
    if (variants.job().shadow_map.cull != scene::Cull::none) {
        variants.add({"shadow_map.cull = \"none\""},
                     [](Job& job) { job.shadow_map.cull = scene::Cull::none; });
    }
    add_fitted_cascades(variants);
    const scene::FrustumSettings& frustum = variants.job().shadow_map.frustum;
    if (frustum.fit != scene::Fit::scene) {
        variants.add({"shadow_map." + fit_setting(frustum.fit, scene::Fit::scene),
                      "shadow_map.near = \"auto\"", "shadow_map.far = \"auto\""},
                     [](Job& job) {
                         scene::FrustumSettings& wider = job.shadow_map.frustum;
                         wider.fit = scene::Fit::scene;
                         wider.near_m.reset();
                         wider.far_m.reset();
                     });
    }
}

} // namespace

std::vector<Variant> variants_for(const Comparison& comparison)
{
    Variants variants{comparison};
    add_mended_biases(variants);
    add_biases(variants, comparison.diagnosis->biases);
    add_finer_maps(variants);
    add_maps_of_as_many_bytes(variants, comparison);
    add_finer_cascades(variants);
    add_finer_depths(variants);
    if (variants.has(Cause::coverage)) {
        add_wider_maps(variants);
    } else if (has_unread_map(comparison)) {
        add_fitted_cascades(variants);
    }
    return variants.take();
}

} // namespace gnomon::analysis
