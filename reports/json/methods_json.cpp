#include "reports/json/methods_json.hpp"

#include "methods/refusal.hpp"
#include "scene/job/stage_names.hpp"
#include "store/json_values.hpp"

namespace gnomon::reports {

namespace {

store::Json source_array(std::span<const methods::Source> sources)
{
    store::Json json = store::Json::array();
    for (const methods::Source& source : sources) {
        json.push_back({{"authors", source.authors},
                        {"year", source.year},
                        {"title", source.title},
                        {"about", source.about}});
    }
    return json;
}

store::Json key_array(const methods::Method& method)
{
    store::Json json = store::Json::array();
    for (const scene::Key& key : methods::keys_of(method)) {
        // A default stands in TOML's syntax, which for numbers, booleans and words is JSON's, too.
        json.push_back(
            {{"name", key.name},
             {"description", key.description},
             {"unit", key.unit},
             {"default", key.default_text.empty() ? store::Json(nullptr)
                                                  : store::Json::parse(key.default_text)},
             {"allowed", key.range_text},
             {"stages", scene::stage_names(key.stages)}});
    }
    return json;
}

store::Json lookup_traits_object(const methods::LookupTraits& traits)
{
    const bool falls = traits.monotonicity.how == methods::Monotone::up_to_rounding;
    return {{"verdict", methods::name(traits.verdict)},
            {"compares", methods::name(traits.compares)},
            {"rises", methods::name(traits.monotonicity.how)},
            {"largest_fall", falls ? store::Json(traits.monotonicity.largest_fall) : nullptr},
            {"curve", methods::name(traits.curve)},
            {"footprint_texels", traits.width_texels},
            {"reads", methods::name(traits.reads)},
            {"samples", traits.samples},
            {"map_bytes", traits.map_bytes},
            {"has_map", traits.has_map}};
}

store::Json filter_array(const methods::Method& method)
{
    store::Json json = store::Json::array();
    for (const methods::FilterChoice& filter : method.filters) {
        const methods::LookupTraits traits = methods::traits_with(method, filter.filter);
        json.push_back({{"name", scene::filter_name(filter.filter)},
                        {"sentence", filter.sentence},
                        {"width_texels", traits.width_texels},
                        {"lookup_traits", lookup_traits_object(traits)},
                        {"promises", lookup_traits_object(traits)}}); // the older name
    }
    return json;
}

store::Json bias_term_array(const methods::Method& method)
{
    store::Json json = store::Json::array();
    for (const methods::BiasTerm& term : method.bias_terms) {
        store::Json keys = store::Json::array();
        for (const scene::Key& key : methods::keys_of(term)) {
            keys.push_back({{"name", key.name}, {"unit", key.unit}});
        }
        json.push_back({{"name", term.name},
                        {"sentence", term.sentence},
                        {"acts", methods::name(term.place)},
                        {"refused", methods::refuses(method, term)},
                        {"stages", scene::stage_names(methods::stages_of(term))},
                        {"keys", std::move(keys)}});
    }
    return json;
}

} // namespace

std::string methods_json(std::span<const methods::Method> methods)
{
    store::Json json = store::Json::array();
    for (const methods::Method& method : methods) {
        const methods::LookupTraits traits = method.traits(scene::Job{});
        json.push_back({{"name", method.name},
                        {"sentence", method.sentence},
                        {"sources", source_array(method.sources)},
                        {"page", method.page},
                        {"lookup_traits", lookup_traits_object(traits)},
                        {"promises", lookup_traits_object(traits)}, // the older name
                        {"filters", filter_array(method)},
                        {"bias_terms", bias_term_array(method)},
                        {"keys", key_array(method)}});
    }
    return json.dump(2) + "\n";
}

} // namespace gnomon::reports
