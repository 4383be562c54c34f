#include "analysis/advice/variants.hpp"

#include "analysis/advice/fit_setting.hpp"
#include "methods/list.hpp"
#include "scene/job/handed_key.hpp"
#include "scene/job/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace gnomon::analysis {

using scene::Job;

namespace {

constexpr int largest_resolution_texels = 16384;

class Variants {
public:
    explicit Variants(const Comparison& comparison)
        : job_{comparison.job},
          causes_{comparison.diagnosis->causes},
          tried_{{job_, {}}}
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

    /// @param keys  "KEY = VALUE"; nothing is tried where the job's method lacks one.
    template <typename Change>
    void add(std::vector<std::string> keys, const Change& change)
    {
        const auto has = [&](std::string_view key) {
            return scene::has_key(job_.method.name, key.substr(0, key.find(' ')));
        };
        if (!std::ranges::all_of(keys, has)) {
            return;
        }
        tried_.push_back({job_, std::move(keys)});
        change(tried_.back().job);
    }

    [[nodiscard]] const Job& job() const { return job_; }
    [[nodiscard]] std::vector<Variant> take() { return std::move(tried_); }

private:
    const Job& job_;
    const CauseLayers& causes_;
    std::vector<Variant> tried_;
};

/// Without each bias that moves the lookup.
void add_lookups_at_the_receiver(Variants& variants)
{
    for (const std::string_view key : methods::moving_bias_keys(variants.job())) {
        const scene::KeySpec& spec = *scene::find_key(key);
        const scene::HandedKey* handed = scene::find_handed_key(key);
        const auto neutral = handed != nullptr ? std::optional{handed->default_value}
                                               : scene::default_of(spec, variants.job());
        const auto own = handed != nullptr ? std::optional{handed->value_of(variants.job())}
                                           : spec.get(variants.job());
        if (neutral && own != neutral) {
            variants.add({fmt::format("{} = {}", key, spec.key.default_text)},
                         [&](Job& job) { spec.set(job, *neutral); });
        }
    }
}

/// Biases that no constant one makes up for; and those that spare the surfaces that need none.
void add_biases(Variants& variants, const std::optional<BiasAnswers>& answers)
{
    if (variants.has(Cause::bias) && variants.job().bias.slope != 0) {
        variants.add({"bias.slope = 0"}, [](Job& job) { job.bias.slope = 0; });
    }
    if (variants.has(Cause::bias)) {
        add_lookups_at_the_receiver(variants);
    }
    if (variants.has(Label::acne) && answers) {
        const double slope =
            std::stod(fmt::format("{:.3g}", answers->slopes[answers->best_slope].slope));
        if (slope > 0) {
            variants.add({fmt::format("bias.slope = {}", slope)},
                         [slope](Job& job) { job.bias.slope = slope; });
        }
    }
    if (variants.has(Label::acne) && variants.job().bias.normal_texels == 0) {
        variants.add({"bias.normal_texels = 1"}, [](Job& job) { job.bias.normal_texels = 1; });
    }
}

/// Maps that resolve more.
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
    if (variants.has(Label::edge) && methods::promises(variants.job()).has_one_tap()) {
        variants.add({"lookup.filter = \"pcf3\""},
                     [](Job& job) { job.lookup.filter = scene::Filter::pcf3; });
    }
}

/// Cascades that resolve more: more of them, a split that spares more for what is near, and boxes
/// in place of spheres.
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

/// Maps that store depths more finely.
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

/// Maps that miss less.
void add_wider_maps(Variants& variants)
{
    if (!variants.has(Cause::coverage)) {
        return;
    }
    if (variants.job().shadow_map.cull != scene::Cull::none) {
        variants.add({"shadow_map.cull = \"none\""},
                     [](Job& job) { job.shadow_map.cull = scene::Cull::none; });
    }
    const scene::CascadeSettings& cascades = variants.job().shadow_map.cascades;
    if (scene::map_layout(variants.job()) == scene::MapLayout::cascades &&
        (cascades.near_m || cascades.far_m)) {
        std::vector<std::string> keys{"shadow_map.cascade_near = \"auto\"",
                                      "shadow_map.cascade_far = \"auto\""};
        if (cascades.fit == scene::CascadeFit::stabilised) { // that cannot be with auto
            keys.emplace_back("shadow_map.cascade_fit = \"tight\"");
        }
        variants.add(std::move(keys), [](Job& job) {
            job.shadow_map.cascades.near_m.reset();
            job.shadow_map.cascades.far_m.reset();
            job.shadow_map.cascades.fit = scene::CascadeFit::tight;
        });
    }
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
    add_biases(variants, comparison.diagnosis->biases);
    add_finer_maps(variants);
    add_finer_cascades(variants);
    add_finer_depths(variants);
    add_wider_maps(variants);
    return variants.take();
}

} // namespace gnomon::analysis
