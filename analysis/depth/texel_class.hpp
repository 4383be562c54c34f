#pragma once

#include "analysis/depth/depth_coding.hpp"
#include "scene/depth/sample.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon::analysis {

/// How near a stored code is to the exact depth of its plane; each class includes those before it.
enum class TexelClass : std::uint8_t {
    nearest_code,  ///< the code nearest to the exact depth
    within_format, ///< one of the two nearest, which GL allows a conversion
    within_model,  ///< converted from a depth within the driver's bound B of the exact one
    outside        ///< none of these
};
inline constexpr std::size_t texel_class_count = 4;
/// "nearest_code", "within_format", "within_model", "outside".
[[nodiscard]] std::string_view texel_class_name(TexelClass texel_class);

/// The first class that holds for the texel's stored code.
/// Source: docs/depth_precision.md#certificate.
[[nodiscard]] TexelClass classify_texel(const DepthCoding& coding, const scene::TexelDepth& texel);

/// Stored less exact depth in codes: units of q, or of the float's last place at the exact depth;
/// packed: of twice the half step there.
[[nodiscard]] double residual_codes(const DepthCoding& coding, const scene::TexelDepth& texel);

/// What a driver stored of many texels.
struct DepthCertificate {
    std::size_t texels = 0;
    std::array<std::size_t, texel_class_count> counts{}; ///< by class, each texel once
    double largest_residual_codes = 0;                   ///< magnitude
    double rms_residual_codes = 0;
    double largest_share_of_bound = 0; ///< |stored − exact| / (B + the conversion's error)
    /// Texels by |residual| in codes: up to ½, 1, 2, 4, … 2^12, and above.
    std::array<std::size_t, 15> histogram{};

    [[nodiscard]] std::size_t count(TexelClass texel_class) const
    {
        return counts.at(static_cast<std::size_t>(texel_class));
    }
};
/// Upper end of a bin of `histogram` [codes]; infinite for the last.
[[nodiscard]] double histogram_end_codes(std::size_t bin);

[[nodiscard]] DepthCertificate certify_texels(const DepthCoding& coding,
                                              std::span<const scene::TexelDepth> texels);

} // namespace gnomon::analysis
