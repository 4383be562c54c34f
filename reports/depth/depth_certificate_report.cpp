#include "reports/depth/depth_certificate_report.hpp"

#include "reports/depth/depth_parts.hpp"
#include "reports/text/text.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gnomon::reports {

namespace {

using analysis::DepthCertificate;
using analysis::TexelClass;

std::string share(const DepthCertificate& certificate, TexelClass texel_class)
{
    return percent(static_cast<double>(certificate.count(texel_class)) /
                   static_cast<double>(certificate.texels));
}

std::string line(const std::string& name, std::string_view triangles,
                 const DepthCertificate& certificate)
{
    return fmt::format(
        "{:<8}{:<10}{:>10}{:>11}{:>11}{:>11}{:>11}{:>12.3g}{:>9.3g}\n", name, triangles,
        grouped(certificate.texels), share(certificate, TexelClass::nearest_code),
        share(certificate, TexelClass::within_format), share(certificate, TexelClass::within_model),
        share(certificate, TexelClass::outside), certificate.largest_residual_codes,
        certificate.rms_residual_codes);
}

std::string units_text(const std::vector<scene::OffsetUnit>& units)
{
    const auto [least, most] = std::ranges::minmax(units, {}, &scene::OffsetUnit::r);
    constexpr double measured_to = 1.01;
    if (most.r <= measured_to * least.r) {
        return fmt::format("  2^{:.2f} at every depth", std::log2(most.r));
    }
    std::string text;
    for (const scene::OffsetUnit& unit : units) {
        text += fmt::format("  2^{:.2f} at {:.2f}", std::log2(unit.r), unit.depth);
    }
    return text;
}

std::string range_table(const CertifiedRange& certified)
{
    std::string text =
        fmt::format("\n{}\n{:<8}{:<10}{:>10}{:>11}{:>11}{:>11}{:>11}{:>12}{:>9}  {}\n",
                    range_text(certified.range), "format", "triangles", "texels", "nearest",
                    "format", "model", "outside", "largest", "rms", "[codes]");
    for (const CertifiedFormat& format : certified.formats) {
        text += line(format.name, "large", format.large) + line(format.name, "small", format.small);
    }
    return text;
}

} // namespace

std::string certificate_text(const DriverCertificate& certificate)
{
    std::string text = "\ndepth certificate: stored codes against the exact planes of triangles\n";
    for (const CertifiedRange& range : certificate.ranges) {
        text += range_table(range);
    }
    text += "\npolygon offset: one unit r in window depth, and at which depth\n";
    for (const FormatOffsetUnits& format : certificate.offset_units) {
        text += fmt::format("{:<8}{}\n", format.name, units_text(format.units));
    }
    return text;
}

store::Json driver_certificate_json(const DriverCertificate& certificate)
{
    store::Json json{{"ranges", store::Json::array()}, {"offset_units", store::Json::object()}};
    for (const CertifiedRange& certified : certificate.ranges) {
        store::Json range{{"frustum", frustum_json(certified.range)},
                          {"formats", store::Json::object()}};
        for (const CertifiedFormat& format : certified.formats) {
            range["formats"][format.name] = {{"large", certificate_json(format.large)},
                                             {"small", certificate_json(format.small)}};
        }
        json["ranges"].push_back(range);
    }
    for (const FormatOffsetUnits& format : certificate.offset_units) {
        store::Json& units = json["offset_units"][format.name] = store::Json::array();
        for (const auto& [depth, r] : format.units) {
            units.push_back({{"depth", depth}, {"r", r}});
        }
    }
    return json;
}

} // namespace gnomon::reports
