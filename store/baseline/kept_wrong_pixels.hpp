#pragma once

#include "analysis/gate/new_pixels.hpp"

#include <filesystem>
#include <string>

namespace gnomon::store {

/// Whether the run kept a configuration's pixels.
[[nodiscard]] bool has_kept_pixels(const std::filesystem::path& run, const std::string& id);

/// Reads the wrong pixels of a configuration from RUN/pixels/ID.exr.
/// @throws scene::InputError  as `LayerFile` does; also for an unknown code of a cause or label.
[[nodiscard]] analysis::WrongPixels read_wrong_pixels(const std::filesystem::path& run,
                                                      const std::string& id);

/// Finds wrong pixels of a run that are not in the masks of a baseline.
class NewPixelFinder {
public:
    NewPixelFinder(std::filesystem::path baseline, std::filesystem::path run)
        : baseline_{std::move(baseline)},
          run_{std::move(run)}
    {
    }

    /// Implements `analysis::AskNewPixels`. Returns an obstacle if the images differ in size, or
    /// the run kept too few layers for the filter.
    /// @throws  as `read_mask` and `read_wrong_pixels`.
    [[nodiscard]] analysis::NewPixelAnswer operator()(const analysis::GateEntry& before,
                                                      const analysis::GateEntry& now,
                                                      const analysis::PixelFilter& filter) const;

private:
    std::filesystem::path baseline_;
    std::filesystem::path run_;
};

} // namespace gnomon::store
