#include "gl_case.hpp"

#include "raster_gl/depth_formats.hpp"
#include "raster_gl/polygon_offset.hpp"

#include <cmath>

namespace gnomon::raster_gl {
namespace {

TEST(OffsetUnit, IsBetweenOneAndTwoStepsOfEachFormat)
{
    GNOMON_REQUIRE_GL();
    for (const FormatSupport& support : query_depth_formats(*tests::shared_context())) {
        if (!support.supported) {
            continue;
        }
        const auto format = scene::depth_format_from_name(support.name).value();
        const auto units = measure_offset_units(*tests::shared_context(), format);
        ASSERT_EQ(units.size(), 6U) << support.name;
        for (const scene::OffsetUnit& unit : units) {
            // GL's conformance tests accept r in [2^-b, 2·2^-b] for unorm. For float it is
            // 2^(e − 23), and twice that on NVIDIA's driver.
            // float32 pipelines cannot resolve 32 bits: there r is a float's, 2^-24 and more.
            const int bits = std::min(format.bits, 24);
            const double least = format.is_float() ? std::ldexp(1.0, std::ilogb(unit.depth) - 23)
                                                   : std::ldexp(1.0, -format.bits);
            const double most =
                format.is_float() ? (tests::is_mesa() ? 1 : 2) * least : std::ldexp(2.0, -bits);
            // The shift is 1/64 at least, and its ends are off by a float32 step each.
            EXPECT_GE(unit.r, least * (1 - 0x1p-9)) << support.name << " at " << unit.depth;
            EXPECT_LE(unit.r, most * (1 + 0x1p-9)) << support.name << " at " << unit.depth;
        }
    }
}

} // namespace
} // namespace gnomon::raster_gl
