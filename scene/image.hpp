#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::scene {

/// Width and height in pixels, both at least 1.
struct ImageSize {
    int width_px = 1280;
    int height_px = 720;

    [[nodiscard]] std::size_t pixel_count() const
    {
        return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
    }
    friend bool operator==(const ImageSize&, const ImageSize&) = default;
};

/// A row-major image whose pixel (0, 0) is the top left.
template <typename Pixel>
class Image {
public:
    Image() = default;
    explicit Image(ImageSize size, Pixel fill = {}) : size_{size}, pixels_(size.pixel_count(), fill)
    {
    }

    [[nodiscard]] ImageSize size() const { return size_; }
    [[nodiscard]] bool empty() const { return pixels_.empty(); }
    [[nodiscard]] std::size_t pixel_count() const { return pixels_.size(); }

    [[nodiscard]] Pixel& operator()(int x, int y) { return pixels_[index(x, y)]; }
    [[nodiscard]] const Pixel& operator()(int x, int y) const { return pixels_[index(x, y)]; }
    /// The index of a pixel for `operator[]`: row by row, from the top.
    [[nodiscard]] std::size_t index(int x, int y) const
    {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width_px) +
               static_cast<std::size_t>(x);
    }
    [[nodiscard]] Pixel& operator[](std::size_t i) { return pixels_[i]; }
    [[nodiscard]] const Pixel& operator[](std::size_t i) const { return pixels_[i]; }

    [[nodiscard]] Pixel* data() { return pixels_.data(); }
    [[nodiscard]] const Pixel* data() const { return pixels_.data(); }
    [[nodiscard]] auto begin() const { return pixels_.begin(); }
    [[nodiscard]] auto end() const { return pixels_.end(); }

private:
    ImageSize size_{0, 0};
    std::vector<Pixel> pixels_;
};

} // namespace gnomon::scene
