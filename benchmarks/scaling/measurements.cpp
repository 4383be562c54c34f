#include "measurements.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace gnomon::benchmarks {
namespace {

constexpr std::size_t columns = 9;

std::vector<std::string> split(const std::string& line)
{
    std::vector<std::string> fields;
    std::istringstream stream{line};
    for (std::string field; std::getline(stream, field, ',');) {
        fields.push_back(field);
    }
    return fields;
}

Measurement measurement_of(const std::vector<std::string>& fields)
{
    const SweepSize size{std::stod(fields[2]), std::stod(fields[3]), std::stod(fields[4]),
                         std::stod(fields[5]), std::stod(fields[6])};
    return {fields[0], fields[1] == "1", size, fields[7], std::stod(fields[8])};
}

} // namespace

std::vector<Measurement> read_measurements(const std::filesystem::path& path)
{
    std::ifstream file{path};
    if (!file) {
        throw std::runtime_error{fmt::format("{}: cannot be read", path.string())};
    }
    std::string line;
    std::getline(file, line); // the header
    std::vector<Measurement> measurements;
    while (std::getline(file, line)) {
        const std::vector<std::string> fields = split(line);
        if (fields.size() != columns) {
            throw std::runtime_error{
                fmt::format("{}: {} is not a measurement", path.string(), line)};
        }
        measurements.push_back(measurement_of(fields));
    }
    return measurements;
}

double series_size(const Measurement& measurement)
{
    const SweepSize& size = measurement.size;
    if (measurement.series == "triangles") {
        return size.triangles;
    }
    if (measurement.series == "pixels") {
        return size.pixels;
    }
    if (measurement.series == "texels") {
        return size.texels;
    }
    if (measurement.series == "biases") {
        return size.biases;
    }
    if (measurement.series == "configurations") {
        return size.biases * size.curves;
    }
    if (measurement.series == "start") {
        return 1;
    }
    throw std::runtime_error{fmt::format("{}: unknown series", measurement.series)};
}

} // namespace gnomon::benchmarks
