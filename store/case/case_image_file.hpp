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

/// A case's image, whose channels may be spread over several files. Every function throws
/// scene::InputError as those of `ChannelFile` do.
class CaseImageFile {
public:
    /// @param sources       at least one.
    /// @param is_bottom_up  the lowest row comes first; .pfm files have their own order.
    /// @param memory_bytes  memory limit; 0: unknown.
    /// @throws scene::InputError  also for more pixels than a job may have, lossy compression,
    ///                            crops, files of different sizes, and a channel in two files.
    CaseImageFile(std::span<const scene::CaseImageSource> sources, bool is_bottom_up,
                  std::uint64_t memory_bytes);

    [[nodiscard]] scene::ImageSize size() const { return parts_.front().file->size(); }
    [[nodiscard]] bool has(const std::string& name) { return part_of(name) != nullptr; }
    /// The first name for which NAME + `suffix` is a channel; empty if there is none.
    [[nodiscard]] std::string find(const std::vector<std::string>& names,
                                   std::string_view suffix = "");
    /// The three channels of the first vector in the file: NAME.X, else NAME.R, else NAME.x; for an
    /// empty name X, R or x. Empty if there is none.
    [[nodiscard]] std::optional<std::array<std::string, 3>>
    find_vector(const std::vector<std::string>& names);

    /// A channel of any type as float32.
    [[nodiscard]] scene::Image<float> numbers(const std::string& name);
    /// A channel that must be float32, such as depths and positions.
    [[nodiscard]] scene::Image<float> exact_numbers(const std::string& name,
                                                    std::string_view why_not_half);
    /// As `exact_numbers`, for an image of squares below each other. If the lowest row comes first,
    /// each square is flipped; their order stays.
    [[nodiscard]] scene::Image<float> exact_squares(const std::string& name,
                                                    std::string_view why_not_half);
    /// A channel of whole numbers from 0. Floats become 2^32 − 1 where `position` is NaN.
    /// @param position  NaN where the number does not matter.
    [[nodiscard]] scene::Image<std::uint32_t>
    whole_numbers(const std::string& name, const scene::Image<scene::Vec3f>& position);

    [[noreturn]] void refuse(const std::string& what) const;
    /// @param channel  whose file the message names.
    [[noreturn]] void refuse_pixel(const std::string& channel, std::string_view what,
                                   std::size_t pixel, std::string_view remedy);
    /// "it has R, G, B", with at most 12 channels.
    [[nodiscard]] std::string listing();

private:
    struct Part {
        std::string name; ///< for messages
        std::unique_ptr<ChannelFile> file;
        bool is_bottom_up = false;
    };

    [[nodiscard]] static Part open(const scene::CaseImageSource& source, bool is_bottom_up);
    void check_parts();
    void check_memory(std::uint64_t memory_bytes);
    /// Null if no file has the channel.
    [[nodiscard]] Part* part_of(const std::string& name);
    /// The file that holds a channel; throws if there is none.
    [[nodiscard]] Part& require(const std::string& name);
    [[nodiscard]] Part& require_exact(const std::string& name, std::string_view why_not_half);

    std::vector<Part> parts_;
};

} // namespace gnomon::store
