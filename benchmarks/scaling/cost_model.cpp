#include "cost_model.hpp"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gnomon::benchmarks {
namespace {

/// SQLite's cache, as `store::prepare_run` sets it.
constexpr double most_cached_bytes = 32 << 20;

/// An estimate from the fit of `database_bytes`.
double database_bytes(const SweepSize& size)
{
    return size.curves * (72'000 + size.biases * 250);
}

std::vector<const Measurement*> fitted_to(const CostDescription& cost,
                                          std::span<const Measurement> measurements)
{
    std::vector<const Measurement*> chosen;
    for (const Measurement& measurement : measurements) {
        if (!measurement.is_check && is_of(cost, measurement)) {
            chosen.push_back(&measurement);
        }
    }
    if (chosen.size() < cost.terms.size()) {
        throw std::runtime_error{fmt::format("{}: {} measurements for {} terms", cost.quantity,
                                             chosen.size(), cost.terms.size())};
    }
    return chosen;
}

Eigen::VectorXd coefficients_of(const std::vector<Term>& terms,
                                const std::vector<const Measurement*>& measurements)
{
    const auto rows = static_cast<Eigen::Index>(measurements.size());
    Eigen::MatrixXd shares(rows, static_cast<Eigen::Index>(terms.size()));
    for (Eigen::Index row = 0; row < shares.rows(); ++row) {
        const Measurement& measured = *measurements[static_cast<std::size_t>(row)];
        for (Eigen::Index column = 0; column < shares.cols(); ++column) {
            const Term term = terms[static_cast<std::size_t>(column)];
            shares(row, column) = value_of(term, measured.size) / measured.value;
        }
    }
    // Terms differ by many orders of magnitude; columns of equal length keep the system well
    // conditioned.
    const Eigen::VectorXd lengths = shares.colwise().norm();
    const Eigen::MatrixXd scaled = shares * lengths.cwiseInverse().asDiagonal();
    const Eigen::VectorXd solved = scaled.colPivHouseholderQr().solve(Eigen::VectorXd::Ones(rows));
    return solved.cwiseQuotient(lengths);
}

} // namespace

std::string_view name_of(Term term)
{
    switch (term) {
    case Term::once:
        return "once";
    case Term::triangles:
        return "triangles";
    case Term::pixels:
        return "pixels";
    case Term::texels:
        return "texels";
    case Term::pixels_log_triangles:
        return "pixels log2(triangles)";
    case Term::triangles_log_triangles:
        return "triangles log2(triangles)";
    case Term::biases:
        return "biases";
    case Term::rows:
        return "rows";
    case Term::curves:
        return "curves";
    case Term::cached_database:
        return "cached database";
    }
    return {};
}

double value_of(Term term, const SweepSize& size)
{
    switch (term) {
    case Term::once:
        return 1;
    case Term::triangles:
        return size.triangles;
    case Term::pixels:
        return size.pixels;
    case Term::texels:
        return size.texels;
    case Term::pixels_log_triangles:
        return size.pixels * std::log2(size.triangles);
    case Term::triangles_log_triangles:
        return size.triangles * std::log2(size.triangles);
    case Term::biases:
        return size.biases;
    case Term::rows:
        return size.biases * size.curves;
    case Term::curves:
        return size.curves;
    case Term::cached_database:
        return std::min(database_bytes(size), most_cached_bytes);
    }
    return 0;
}

std::span<const CostDescription> cost_descriptions()
{
    static const std::vector<CostDescription> costs{
        {"start_s", {Term::once}, {"start"}},
        {"scene_s", {Term::once, Term::triangles}, {"triangles"}},
        {"hierarchies_s",
         {Term::once, Term::triangles, Term::triangles_log_triangles},
         {"triangles"}},
        {"receivers_s", {Term::once, Term::pixels, Term::triangles}, {"pixels", "triangles"}},
        // GL reports where it draws each triangle, hence the term in triangles.
        {"truth_s",
         {Term::once, Term::pixels, Term::triangles, Term::pixels_log_triangles},
         {"pixels", "triangles"}},
        {"map_s", {Term::once, Term::texels, Term::triangles}, {"texels", "triangles"}},
        {"lookup_s", {Term::once, Term::pixels}, {"pixels"}},
        {"curve_s",
         {Term::once, Term::pixels, Term::triangles, Term::pixels_log_triangles},
         {"pixels", "triangles"}},
        {"sweep_s", {Term::once, Term::triangles}, {"triangles"}},
        {"small_sweep_s", {Term::once, Term::curves, Term::rows}, {"biases", "configurations"}},
        {"memory_bytes",
         {Term::once, Term::triangles, Term::pixels, Term::texels, Term::biases,
          Term::cached_database},
         {"triangles", "pixels", "texels", "biases", "configurations"}},
        {"database_bytes", {Term::once, Term::curves, Term::rows}, {"biases", "configurations"}},
        {"merge_s", {Term::once, Term::curves, Term::rows}, {"biases", "configurations"}},
        {"csv_bytes", {Term::once, Term::curves, Term::rows}, {"biases", "configurations"}},
    };
    return costs;
}

bool is_of(const CostDescription& cost, const Measurement& measurement)
{
    return measurement.quantity == cost.quantity &&
           std::ranges::find(cost.series, measurement.series) != cost.series.end();
}

FittedCost fit(const CostDescription& cost, std::span<const Measurement> measurements)
{
    const std::vector<const Measurement*> chosen = fitted_to(cost, measurements);
    std::vector<Term> terms = cost.terms;
    for (;;) {
        const Eigen::VectorXd coefficients = coefficients_of(terms, chosen);
        Eigen::Index least = 0;
        if (coefficients.minCoeff(&least) < 0 && terms.size() > 1) {
            terms.erase(terms.begin() + least);
            continue;
        }
        FittedCost fitted{&cost, {}};
        for (std::size_t i = 0; i < terms.size(); ++i) {
            fitted.terms.push_back({terms[i], coefficients[static_cast<Eigen::Index>(i)]});
        }
        return fitted;
    }
}

double predict(const FittedCost& cost, const SweepSize& size)
{
    double sum = 0;
    for (const FittedTerm& term : cost.terms) {
        sum += term.coefficient * value_of(term.term, size);
    }
    return sum;
}

} // namespace gnomon::benchmarks
