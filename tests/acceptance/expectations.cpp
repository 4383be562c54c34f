#include "expectations.hpp"

#include "claims.hpp"
#include "methods/depth/depth_map.hpp"
#include "reference_rt/truth.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <span>

namespace gnomon::tests {
namespace {

using analysis::Cause;
using analysis::CauseCounts;
using analysis::Label;

double sum(std::span<const double> amounts)
{
    return std::accumulate(amounts.begin(), amounts.end(), 0.0);
}

void expect_amounts_explained(const analysis::Comparison& result, const std::string& label)
{
    const CauseCounts& counts = result.diagnosis->causes.counts;
    const analysis::CauseAmounts& amounts = result.diagnosis->causes.amounts;
    const analysis::ErrorAmounts& all = result.metrics.amounts;
    // Amounts of hardware are rounded to 2^-32 of a pixel, once or twice; sums of doubles round.
    const double allowed =
        0x1p-31 * static_cast<double>(result.metrics.pixels.scored()) + 1e-12 * all.total();
    EXPECT_NEAR(sum(amounts.by_cause) + all.unassigned, all.total(), allowed) << label;
    EXPECT_NEAR(sum(amounts.by_label) + all.unassigned, all.total(), allowed) << label;
    EXPECT_EQ(amounts.of(Cause::none), 0) << label;
    EXPECT_EQ(amounts.of(Label::none), 0) << label;
    EXPECT_LE(amounts.softening(), amounts.of(Cause::filter) + allowed) << label;
    EXPECT_LE(amounts.shadow_softening, all.shadow) << label;
    EXPECT_LE(amounts.light_softening, all.light) << label;
    if (!methods::filter_traits(result.job.lookup.filter).has_fractions()) {
        EXPECT_EQ(amounts.softening(), 0) << label;
        for (std::size_t i = 0; i < amounts.by_cause.size(); ++i) {
            EXPECT_EQ(amounts.by_cause[i], static_cast<double>(counts.by_cause[i])) << label;
        }
    }
}

} // namespace

void expect_certified(const analysis::Comparison& result,
                      const std::optional<std::uint64_t>& sample)
{
    const auto certificate = reference_rt::certify(
        *result.triangles, result.view,
        reference_rt::test::claims_of(result.receivers.triangle, result.truth,
                                      reference_rt::receiver_points(*result.triangles, result.view,
                                                                    result.receivers.triangle)),
        {sample});
    EXPECT_TRUE(certificate.is_certified()) << certificate.wrong << " wrong pixels";
    for (const auto& refutation : certificate.refutations) {
        ADD_FAILURE() << "pixel " << refutation.x << ", " << refutation.y << ": "
                      << refutation.reason;
    }
    // The checker derives every indeterminate pixel, with the zero sign that makes it so.
    EXPECT_EQ(certificate.silhouettes + certificate.vertices + certificate.grazes,
              certificate.derived[static_cast<std::size_t>(scene::PixelClass::indeterminate)]);
}

void expect_all_explained(const analysis::Comparison& result, const std::string& label)
{
    const CauseCounts& counts = result.diagnosis->causes.counts;
    const std::uint64_t wrong = result.metrics.false_shadow + result.metrics.false_lit;
    std::uint64_t causes = 0;
    for (const std::uint64_t count : counts.by_cause) {
        causes += count;
    }
    std::uint64_t labels = 0;
    for (const std::uint64_t count : counts.by_label) {
        labels += count;
    }
    EXPECT_EQ(causes, wrong) << label;
    EXPECT_EQ(labels, wrong) << label;
    EXPECT_EQ(counts.of(Cause::none), 0U) << label;
    EXPECT_EQ(counts.of(Label::none), 0U) << label;
    expect_amounts_explained(result, label);
}

} // namespace gnomon::tests
