#include "store/run/error_buckets_json.hpp"

#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

namespace gnomon::store {

namespace {

using analysis::Cause;
using analysis::ErrorBucket;
using analysis::KindOfError;
using analysis::Label;
using analysis::LightDistanceBand;

/// A double holds every integer up to here exactly.
constexpr std::uint64_t most_pixels = std::uint64_t{1} << 53U;

/// "false_shadow.resolution.edge" for a count, "shadow_amount.resolution.edge" for an amount.
std::string kind_text(const KindOfError& kind, bool is_amount)
{
    const std::string_view lit = is_amount ? "shadow_amount" : "false_shadow";
    const std::string_view blocked = is_amount ? "light_amount" : "false_lit";
    return fmt::format("{}.{}.{}", kind.is_false_lit ? blocked : lit,
                       analysis::cause_names[static_cast<std::size_t>(kind.cause)],
                       analysis::label_names[static_cast<std::size_t>(kind.label)]);
}

struct NamedKind {
    KindOfError kind;
    std::size_t order = 0;  ///< by side, cause and label
    bool is_amount = false; ///< the name is that of the amount, not of the count
};

const std::map<std::string, NamedKind, std::less<>>& kinds_by_name()
{
    static const auto by_name = [] {
        std::map<std::string, NamedKind, std::less<>> all;
        for (const bool is_false_lit : {false, true}) {
            for (std::size_t cause = 1; cause < analysis::cause_names.size(); ++cause) {
                for (std::size_t label = 1; label < analysis::label_names.size(); ++label) {
                    const KindOfError kind{is_false_lit, static_cast<Cause>(cause),
                                           static_cast<Label>(label)};
                    const std::size_t order = all.size();
                    for (const bool is_amount : {false, true}) {
                        all.emplace(kind_text(kind, is_amount), NamedKind{kind, order, is_amount});
                    }
                }
            }
        }
        return all;
    }();
    return by_name;
}

[[noreturn]] void refuse_bucket(const std::string& place, std::string_view problem)
{
    throw scene::InputError(fmt::format("{}: {}", scene::one_line(place.substr(0, 200)), problem));
}

std::uint64_t pixel_count(const Json& json, const std::string& place)
{
    if (!json.is_number_unsigned() || json.get<std::uint64_t>() > most_pixels) {
        refuse_bucket(place, "must be a pixel count");
    }
    return json.get<std::uint64_t>();
}

double pixel_amount(const Json& json, const std::string& place)
{
    if (!json.is_number() || !(json.get<double>() >= 0) ||
        json.get<double>() > static_cast<double>(most_pixels)) {
        refuse_bucket(place, "must be an amount of pixels, at least 0");
    }
    return json.get<double>();
}

/// The errors of a bucket. Where no amount is given, it equals the count.
std::vector<KindOfError> errors_from_json(const Json& json, const std::string& place)
{
    std::map<std::size_t, KindOfError> kinds; // by their order
    for (const bool are_amounts : {false, true}) {
        for (const auto& [name, value] : json.items()) {
            const std::string there = fmt::format("{}.{}", place, name);
            const auto named = kinds_by_name().find(name);
            const bool is_kind = named != kinds_by_name().end();
            if (!is_kind && name != "lit" && name != "blocked") {
                refuse_bucket(there, "is not a pixel kind");
            }
            if (!is_kind || named->second.is_amount != are_amounts) {
                continue;
            }
            KindOfError& kind =
                kinds.try_emplace(named->second.order, named->second.kind).first->second;
            if (!are_amounts) {
                kind.pixels = pixel_count(value, there);
            }
            kind.amount =
                are_amounts ? pixel_amount(value, there) : static_cast<double>(kind.pixels);
        }
    }
    std::vector<KindOfError> errors;
    for (const auto& [order, kind] : kinds) {
        errors.push_back(kind);
    }
    return errors;
}

ErrorBucket bucket_from_json(const Json& json, const std::string& place)
{
    if (!json.is_object() || !json.contains("lit") || !json.contains("blocked")) {
        refuse_bucket(place, "must be an object with \"lit\" and \"blocked\"");
    }
    ErrorBucket bucket;
    bucket.lit = pixel_count(json.at("lit"), place + ".lit");
    bucket.blocked = pixel_count(json.at("blocked"), place + ".blocked");
    bucket.errors = errors_from_json(json, place);
    return bucket;
}

} // namespace

std::string band_text(LightDistanceBand band)
{
    return fmt::format("[{}, {})", band.lower_m(), band.upper_m());
}

std::optional<LightDistanceBand> band_from_text(std::string_view text)
{
    static const auto bands = [] {
        std::map<std::string, LightDistanceBand, std::less<>> all;
        for (int index = LightDistanceBand::lowest; index <= LightDistanceBand::highest; ++index) {
            all.emplace(band_text({index}), LightDistanceBand{index});
        }
        return all;
    }();
    const auto found = bands.find(text);
    return found == bands.end() ? std::nullopt : std::optional{found->second};
}

Json error_buckets_json(const std::vector<ErrorBucket>& buckets)
{
    Json json = Json::object();
    for (const ErrorBucket& bucket : buckets) {
        Json counts{{"blocked", bucket.blocked}, {"lit", bucket.lit}};
        for (const KindOfError& kind : bucket.errors) {
            if (kind.pixels > 0) {
                counts[kind_text(kind, false)] = kind.pixels;
            }
            if (kind.amount != static_cast<double>(kind.pixels)) {
                counts[kind_text(kind, true)] = kind.amount;
            }
        }
        json[bucket.object][band_text(bucket.band)] = std::move(counts);
    }
    return json;
}

std::vector<ErrorBucket> error_buckets_from_json(const Json& json, const std::string& place)
{
    if (!json.is_object()) {
        refuse_bucket(place, "must be an object");
    }
    std::vector<ErrorBucket> buckets;
    for (const auto& [object, bands] : json.items()) {
        const std::string of_object = fmt::format("{}.{}", place, object);
        if (!bands.is_object() || bands.empty()) {
            refuse_bucket(of_object, "must be an object with bands of light distance");
        }
        for (const auto& [name, counts] : bands.items()) {
            const std::string there = fmt::format("{}.{}", of_object, name);
            const auto band = band_from_text(name);
            if (!band) {
                refuse_bucket(there, "is not a band of light distance");
            }
            buckets.push_back(bucket_from_json(counts, there));
            buckets.back().object = object;
            buckets.back().band = *band;
        }
    }
    std::sort(buckets.begin(), buckets.end(), [](const ErrorBucket& a, const ErrorBucket& b) {
        return std::tie(a.object, a.band) < std::tie(b.object, b.band);
    });
    return buckets;
}

} // namespace gnomon::store
