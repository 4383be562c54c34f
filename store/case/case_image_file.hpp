#pragma once

#include "scene/case/file.hpp"
#include "scene/image.hpp"
#include "scene/vec.hpp"
#include "store/images/channel_file.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::store {

/// A case's image, of one file or of several that are one, and how messages speak of it. Every
/// function throws scene::InputError as those of `ChannelFile` do.
class CaseImageFile {
public:
    /// @param sources       at least one.
    /// @param is_bottom_up  The lowest row comes first, but in .pfm files.
    /// @param memory_bytes  what may be taken; 0: not known.
    /// @throws scene::InputError  also for more pixels than a job may have, for compressions that
    ///                            change numbers, for crops, and for files of unequal size or that
    ///                            hold one channel twice.
    CaseImageFile(std::span<const scene::CaseImageSource> sources, bool is_bottom_up,
                  std::uint64_t memory_bytes);

    [[nodiscard]] scene::ImageSize size() const { return parts_.front().file->size(); }
    [[nodiscard]] bool has(const std::string& name) { return part_of(name) != nullptr; }
    /// The first name that with the suffix behind it is a channel of the file; empty if none is.
    [[nodiscard]] std::string find(const std::vector<std::string>& names,
                                   std::string_view suffix = "");
    /// The three channels of the first vector whose first channel the file has: NAME.X, else
    /// NAME.R, else NAME.x; of an empty name X, R or x. Empty if it has none.
    [[nodiscard]] std::optional<std::array<std::string, 3>>
    find_vector(const std::vector<std::string>& names);

    /// A channel of floats, halves or uints, as float32.
    [[nodiscard]] scene::Image<float> numbers(const std::string& name);
    /// A channel that must be float32, as depths and positions: half would round them away.
    [[nodiscard]] scene::Image<float> exact_numbers(const std::string& name,
                                                    std::string_view why_not_half);
    /// As `exact_numbers`, of an image that is squares below each other: each of them is turned
    /// where the lowest row comes first, and they stay in their order.
    [[nodiscard]] scene::Image<float> exact_squares(const std::string& name,
                                                    std::string_view why_not_half);
    /// Whole numbers from 0: a uint channel as it is; of floats 2^32 − 1 where `position` is NaN.
    /// @param position  NaN where the number does not matter.
    [[nodiscard]] scene::Image<std::uint32_t>
    whole_numbers(const std::string& name, const scene::Image<scene::Vec3f>& position);

    [[noreturn]] void refuse(const std::string& what) const;
    /// @param channel  whose file is to be named.
    [[noreturn]] void refuse_pixel(const std::string& channel, std::string_view what,
                                   std::size_t pixel, std::string_view remedy);
    /// "it has R, G, B", cut after some.
    [[nodiscard]] std::string listing();

private:
    struct Part {
        std::string name; ///< of messages
        std::unique_ptr<ChannelFile> file;
        bool is_bottom_up = false;
    };

    [[nodiscard]] static Part open(const scene::CaseImageSource& source, bool is_bottom_up);
    void check_parts();
    void check_memory(std::uint64_t memory_bytes);
    /// Null if no file has the channel.
    [[nodiscard]] Part* part_of(const std::string& name);
    /// The file of a channel, of a type that can be read.
    [[nodiscard]] Part& require(const std::string& name);
    [[nodiscard]] Part& require_exact(const std::string& name, std::string_view why_not_half);

    std::vector<Part> parts_;
};

} // namespace gnomon::store
