#include "methods/prefiltered/kernels.hpp"

#include <array>
#include <cstddef>

namespace gnomon::methods {
namespace {

/// 32-bit floats: the kernels' weights, along a line.
constexpr std::array<float, 1> one{1.0F};
constexpr std::array<float, 3> box3{1 / 3.0F, 1 / 3.0F, 1 / 3.0F};
constexpr std::array<float, 5> box5{0.2F, 0.2F, 0.2F, 0.2F, 0.2F};
constexpr std::array<float, 7> box7{1 / 7.0F, 1 / 7.0F, 1 / 7.0F, 1 / 7.0F,
                                    1 / 7.0F, 1 / 7.0F, 1 / 7.0F};
constexpr std::array<float, 9> box9{1 / 9.0F, 1 / 9.0F, 1 / 9.0F, 1 / 9.0F, 1 / 9.0F,
                                    1 / 9.0F, 1 / 9.0F, 1 / 9.0F, 1 / 9.0F};
/// Binomial coefficients over their sum: exact.
constexpr std::array<float, 3> gaussian3{0.25F, 0.5F, 0.25F};
constexpr std::array<float, 5> gaussian5{1 / 16.0F, 4 / 16.0F, 6 / 16.0F, 4 / 16.0F, 1 / 16.0F};
constexpr std::array<float, 7> gaussian7{1 / 64.0F,  6 / 64.0F, 15 / 64.0F, 20 / 64.0F,
                                         15 / 64.0F, 6 / 64.0F, 1 / 64.0F};
constexpr std::array<float, 9> gaussian9{1 / 256.0F,  8 / 256.0F,  28 / 256.0F,
                                         56 / 256.0F, 70 / 256.0F, 56 / 256.0F,
                                         28 / 256.0F, 8 / 256.0F,  1 / 256.0F};
constexpr std::array<Kernel, 5> box_kernels{{{one}, {box3}, {box5}, {box7}, {box9}}};
constexpr std::array<Kernel, 5> gaussian_kernels{
    {{one}, {gaussian3}, {gaussian5}, {gaussian7}, {gaussian9}}};

} // namespace

const Kernel& blur_kernel(std::string_view weights, int width_texels)
{
    const auto& kernels = weights == "box" ? box_kernels : gaussian_kernels;
    return kernels.at(static_cast<std::size_t>(width_texels / 2));
}

} // namespace gnomon::methods
