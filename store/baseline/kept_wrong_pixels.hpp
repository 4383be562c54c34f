#pragma once

#include "analysis/gate/new_pixels.hpp"

#include <filesystem>
#include <string>

namespace gnomon::store {

/// Whether the run kept a configuration's pixels.
[[nodiscard]] bool has_kept_pixels(const std::filesystem::path& run, const std::string& id);

/// The wrong pixels of one of its configurations: RUN/pixels/ID.exr.
/// @throws scene::InputError  as `LayerFile` does; also for a code of a cause or a label that does
///                            not exist.
[[nodiscard]] analysis::WrongPixels read_wrong_pixels(const std::filesystem::path& run,
                                                      const std::string& id);

/// Finds new wrong pixels: the masks of a baseline against the pixels of a run.
class NewPixelFinder {
public:
    NewPixelFinder(std::filesystem::path baseline, std::filesystem::path run)
        : baseline_{std::move(baseline)},
          run_{std::move(run)}
    {
    }

    /// An `analysis::AskNewPixels`; no pixels but an obstacle if the images differ in size, or the
    /// run kept too little for the filter.
    /// @throws  as `read_mask` and `read_wrong_pixels`.
    [[nodiscard]] analysis::NewPixelAnswer operator()(const analysis::GateEntry& before,
                                                      const analysis::GateEntry& now,
                                                      const analysis::PixelFilter& filter) const;

private:
    std::filesystem::path baseline_;
    std::filesystem::path run_;
};

} // namespace gnomon::store
