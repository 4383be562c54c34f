#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::benchmarks {

/// What the cost of a sweep depends on.
struct SweepSize {
    double triangles = 0;
    double pixels = 0;
    double texels = 0;
    double biases = 0; ///< of each curve
    double curves = 0; ///< each with a map and a lookup of its own
};

/// One quantity, measured at one size.
struct Measurement {
    std::string series;    ///< the member of the size that varies, as it is called there
    bool is_check = false; ///< no fit sees it
    SweepSize size;
    std::string quantity;
    double value = 0; ///< [s] or [bytes]
};

/// Reads lines "series,is_check,triangles,pixels,texels,biases,curves,quantity,value" below a head.
/// @throws std::runtime_error  if the file cannot be read, or a line is another.
[[nodiscard]] std::vector<Measurement> read_measurements(const std::filesystem::path& path);

/// The measurement's size along its series.
/// @throws std::runtime_error  if there is no such series.
[[nodiscard]] double series_size(const Measurement& measurement);

} // namespace gnomon::benchmarks
