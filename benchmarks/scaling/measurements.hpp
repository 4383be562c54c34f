#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::benchmarks {

/// The sizes that the cost of a sweep depends on.
struct SweepSize {
    double triangles = 0;
    double pixels = 0;
    double texels = 0;
    double biases = 0; ///< of each curve
    double curves = 0; ///< each with its own map and lookup
};

/// One quantity, measured at one size.
struct Measurement {
    std::string series;    ///< the name of the varied member of `size`
    bool is_check = false; ///< excluded from the fit
    SweepSize size;
    std::string quantity;
    double value = 0; ///< [s] or [bytes]
};

/// Reads lines "series,is_check,triangles,pixels,texels,biases,curves,quantity,value" after a
/// header.
/// @throws std::runtime_error  if the file cannot be read, or a line is malformed.
[[nodiscard]] std::vector<Measurement> read_measurements(const std::filesystem::path& path);

/// The measurement's size along its series.
/// @throws std::runtime_error  if the series is unknown.
[[nodiscard]] double series_size(const Measurement& measurement);

} // namespace gnomon::benchmarks
