#pragma once

#include "scene/image.hpp"
#include "scene/vec.hpp"
#include "store/images/layer_file.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::store {

/// A case's EXR file and how messages speak of it. Every function throws scene::InputError as those
/// of `LayerFile` do.
class CaseImageFile {
public:
    /// @param memory_bytes  what may be taken; 0: not known.
    /// @throws scene::InputError  also for more pixels than a job may have, for compressions that
    ///                            change numbers, and for crops.
    CaseImageFile(const std::filesystem::path& path, std::uint64_t memory_bytes);

    [[nodiscard]] scene::ImageSize size() const { return file_.size(); }
    /// The first name that with the suffix behind it is a channel of the file; empty if none is.
    [[nodiscard]] std::string find(const std::vector<std::string>& names,
                                   std::string_view suffix = "");
    /// The three channels of the first vector whose first channel the file has: NAME.X, else
    /// NAME.R, else NAME.x. Empty if it has none.
    [[nodiscard]] std::optional<std::array<std::string, 3>>
    find_vector(const std::vector<std::string>& names);

    /// A channel of floats, halves or uints, as float32.
    [[nodiscard]] scene::Image<float> numbers(const std::string& name);
    /// A channel that must be float32, as depths and positions: half would round them away.
    [[nodiscard]] scene::Image<float> exact_numbers(const std::string& name,
                                                    std::string_view why_not_half);
    /// Whole numbers from 0: a uint channel as it is; of floats 2^32 − 1 where `position` is NaN.
    /// @param position  NaN where the number does not matter.
    [[nodiscard]] scene::Image<std::uint32_t>
    whole_numbers(const std::string& name, const scene::Image<scene::Vec3f>& position);

    [[noreturn]] void refuse(const std::string& what) const;
    [[noreturn]] void refuse_pixel(std::string_view what, std::size_t pixel,
                                   std::string_view remedy) const;
    /// "it has R, G, B", cut after some.
    [[nodiscard]] std::string listing();

private:
    void refuse_encoding();
    void require(const std::string& name);

    std::string name_; ///< of messages
    LayerFile file_;
};

} // namespace gnomon::store
