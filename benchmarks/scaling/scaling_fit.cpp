#include "cost_model.hpp"
#include "measurements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

/// scaling_fit MEASUREMENTS.csv MODEL.csv CHECKS.csv: fits the cost model to measurements, and
/// checks it on sizes that were excluded from the fit.
///
/// Exit status: 0 all checks are within 20 %; 1 one is not; 2 a file is invalid.
namespace gnomon::benchmarks {
namespace {

constexpr double most_deviation = 0.2;

std::ofstream output(const char* path)
{
    std::ofstream file{path};
    if (!file) {
        throw std::runtime_error{fmt::format("{}: cannot be written", path)};
    }
    return file;
}

/// @return  Whether all checks are within the allowed deviation.
bool check(const std::vector<FittedCost>& costs, const std::vector<Measurement>& measurements,
           std::ofstream& checks)
{
    checks << "quantity,series,size,predicted,measured\n";
    bool is_near = true;
    for (const FittedCost& cost : costs) {
        for (const Measurement& measured : measurements) {
            if (!measured.is_check || !is_of(*cost.description, measured)) {
                continue;
            }
            const double predicted = predict(cost, measured.size);
            checks << fmt::format("{},{},{},{},{}\n", cost.description->quantity, measured.series,
                                  series_size(measured), predicted, measured.value);
            const double deviation = predicted / measured.value - 1;
            const bool is_off = std::abs(deviation) > most_deviation;
            is_near = is_near && !is_off;
            fmt::print("{:<16} {:<15} {:>10} {:>+7.1f} %{}\n", cost.description->quantity,
                       measured.series, series_size(measured), 100 * deviation,
                       is_off ? "  too far" : "");
        }
    }
    return is_near;
}

bool run(const char* measurements_path, const char* model_path, const char* checks_path)
{
    const std::vector<Measurement> measurements = read_measurements(measurements_path);
    std::vector<FittedCost> costs;
    std::ranges::transform(cost_descriptions(), std::back_inserter(costs),
                           [&](const CostDescription& cost) { return fit(cost, measurements); });
    std::ofstream model = output(model_path);
    model << "quantity,term,coefficient\n";
    for (const FittedCost& cost : costs) {
        for (const FittedTerm& term : cost.terms) {
            model << fmt::format("{},{},{}\n", cost.description->quantity, name_of(term.term),
                                 term.coefficient);
        }
    }
    std::ofstream checks = output(checks_path);
    return check(costs, measurements, checks);
}

} // namespace
} // namespace gnomon::benchmarks

int main(int argc, char** argv)
{
    if (argc != 4) {
        fmt::print(stderr, "usage: scaling_fit MEASUREMENTS.csv MODEL.csv CHECKS.csv\n");
        return 2;
    }
    try {
        return gnomon::benchmarks::run(argv[1], argv[2], argv[3]) ? 0 : 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "scaling_fit: {}\n", error.what());
        return 2;
    }
}
