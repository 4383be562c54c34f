#include "reports/pictures/panels.hpp"

#include "scene/camera/camera.hpp"
#include "store/exr/aov.hpp"
#include "store/images/layer_file.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::reports {

namespace {

using scene::PixelClass;
using scene::Vec3d;
using scene::Vec3f;

/// A pixel's reflected light, linear; `ambient` is 0 without a surface.
struct Shade {
    float ambient = 0;
    float diffuse = 0; ///< 0 where the light cannot arrive

    [[nodiscard]] bool is_surface() const { return ambient > 0; }
};

// Linear RGB. As outdoors, direct light is slightly warm and ambient light slightly cool.
constexpr Vec3f background{0.80F, 0.84F, 0.90F};
constexpr Vec3f diffuse_tint{0.86F, 0.81F, 0.73F};
constexpr Vec3f ambient_tint{0.76F, 0.80F, 0.88F};
/// Share of the ambient light in a shadow, which is occluded too; also for attached surfaces.
constexpr float shadowed_ambient = 0.72F;
/// How far the error panel fades towards white beneath its marks.
constexpr float fade = 0.62F;

Vec3d towards_light(const scene::Light& light, const Vec3d& point)
{
    const Vec3d way = light.way_from(point);
    const double length = glm::length(way);
    return length > 0 ? way / length : Vec3d{0, 1, 0};
}

/// Shades one pixel whose receiver is `triangle`.
Shade shade_pixel(const analysis::Comparison& comparison, std::uint32_t triangle, int x, int y,
                  PixelClass pixel_class)
{
    const Vec3d origin{comparison.triangles->corners(triangle)[0]};
    const scene::Ray ray = scene::pixel_ray(comparison.view.camera, comparison.view.image, x, y);
    const Vec3d view = -glm::normalize(ray.direction);
    const Vec3d normal = store::facing_normal(comparison, x, y);
    const double along = glm::dot(normal, ray.direction);
    const double distance = along != 0 ? glm::dot(normal, origin - ray.origin) / along : 0;
    const Vec3d light = towards_light(comparison.view.light, ray.origin + distance * ray.direction);

    // Sky light from above, and a faint light at the eye to keep unlit surfaces readable.
    const double sky = 0.5 + 0.5 * normal.y;
    const double ambient = 0.09 + 0.10 * sky + 0.10 * std::abs(glm::dot(normal, view));
    const bool receives_light =
        pixel_class != PixelClass::attached && pixel_class != PixelClass::out_of_light;
    const double diffuse = receives_light ? 0.80 * std::max(0.0, glm::dot(normal, light)) : 0.0;
    return {static_cast<float>(ambient), static_cast<float>(diffuse)};
}

/// What panels are drawn from: all images have one size.
struct PanelSource {
    scene::Image<Shade> shades;
    scene::Image<PixelClass> classes;
    scene::Image<scene::LightShare> truth; ///< of scored pixels
    scene::Image<float> verdicts;
};

scene::Image<Shade> shade_image(const analysis::Comparison& comparison)
{
    const scene::Image<std::uint32_t>& triangles = comparison.receivers.triangle;
    scene::Image<Shade> shades{triangles.size()};
    for (int y = 0; y < triangles.size().height_px; ++y) {
        for (int x = 0; x < triangles.size().width_px; ++x) {
            if (triangles(x, y) != scene::no_triangle) {
                shades(x, y) = shade_pixel(comparison, triangles(x, y), x, y,
                                           comparison.truth.pixel_class(x, y));
            }
        }
    }
    return shades;
}

/// The pixel's colour when the fraction `lit` of the light arrives, linear.
Vec3f colour(const Shade& shade, float lit)
{
    if (!shade.is_surface()) {
        return background;
    }
    const float arriving = shade.diffuse > 0 ? lit : 0.0F;
    const float ambient = shade.ambient * (shadowed_ambient + (1 - shadowed_ambient) * arriving);
    return ambient * ambient_tint + shade.diffuse * arriving * diffuse_tint;
}

PanelSource source_of(const analysis::Comparison& comparison)
{
    const scene::ImageSize size = comparison.receivers.triangle.size();
    PanelSource source{shade_image(comparison), comparison.truth.pixel_class,
                       scene::Image<scene::LightShare>{size}, scene::Image<float>{size}};
    for (std::size_t i = 0; i < source.truth.pixel_count(); ++i) {
        source.truth[i] = comparison.truth.share(i);
        source.verdicts[i] = comparison.lookup.samples[i].verdict;
    }
    return source;
}

/// Shades a pixel from its kept layers, which lack the direction to the eye.
/// @param tan_theta  of the angle between normal and light; NaN if the surface is grazed.
/// @param up         the normal's part along the world's Y axis; NaN without a surface.
Shade shade_kept(PixelClass pixel_class, float tan_theta, float up)
{
    constexpr float eye_light = 0.05F; // the mean of 0.10 |n · v| over directions
    if (pixel_class == PixelClass::background) {
        return {};
    }
    const float sky = std::isnan(up) ? 0.75F : 0.5F + 0.5F * up;
    const bool receives_light =
        pixel_class != PixelClass::attached && pixel_class != PixelClass::out_of_light;
    const float cosine = std::isnan(tan_theta) ? 0.0F : 1 / std::sqrt(1 + tan_theta * tan_theta);
    return {0.09F + 0.10F * sky + eye_light, receives_light ? 0.80F * cosine : 0.0F};
}

PanelSource source_of(store::LayerFile& file)
{
    // Without these layers, every surface is lit and turned upwards halfway.
    const auto layer = [&](const char* name, float otherwise) {
        return file.has(name) ? file.floats(name) : scene::Image<float>{file.size(), otherwise};
    };
    const scene::Image<float> truth = file.floats("truth");
    const scene::Image<float> tan_theta = layer("tan_theta", 1.0F);
    const scene::Image<float> up = layer("N.Y", 0.5F);
    PanelSource source{scene::Image<Shade>{file.size()}, file.classes(),
                       scene::Image<scene::LightShare>{file.size()}, file.floats("verdict")};
    for (std::size_t i = 0; i < truth.pixel_count(); ++i) {
        source.shades[i] = shade_kept(source.classes[i], tan_theta[i], up[i]);
        source.truth[i] = {truth[i], truth[i]};
    }
    return source;
}

std::uint8_t encode_srgb(float linear)
{
    const float value = std::clamp(linear, 0.0F, 1.0F);
    const float encoded =
        value <= 0.0031308F ? 12.92F * value : 1.055F * std::pow(value, 1 / 2.4F) - 0.055F;
    return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

store::Rgb encode_srgb(const Vec3f& linear)
{
    return {encode_srgb(linear.r), encode_srgb(linear.g), encode_srgb(linear.b)};
}

/// The pixels [first, last) that panel pixel `index` of `panel_px` covers, at least one, if the
/// panel shows `shown_px` pixels from `begin` on.
struct Span {
    int first;
    int last;
};

Span covered(int index, int panel_px, int begin, int shown_px)
{
    const auto scaled = [&](std::int64_t edge) { return edge * shown_px / panel_px; };
    const int first = static_cast<int>(scaled(index));
    const auto round_up =
        static_cast<int>((static_cast<std::int64_t>(index) + 1) * shown_px + panel_px - 1) /
        panel_px;
    return {begin + first, begin + std::clamp(round_up, first + 1, shown_px)};
}

/// Accumulates the pixels under one panel pixel.
class PixelAccumulator {
public:
    void add(const PanelSource& source, std::size_t pixel)
    {
        const PixelClass pixel_class = source.classes[pixel];
        const bool is_scored = scene::is_scored(pixel_class);
        const scene::LightShare truth = source.truth[pixel];
        const float verdict = source.verdicts[pixel];
        gl_ += colour(source.shades[pixel], verdict);
        // Undecided pixels are half lit.
        truth_ += colour(source.shades[pixel], is_scored ? truth.middle() : 0.5F);
        const Mark mark = mark_of(pixel_class, verdict);
        ++marks_[static_cast<std::size_t>(mark)];
        if (mark == Mark::none && is_scored) {
            const auto [too_dark, too_bright] = scene::error_of(truth, verdict);
            shadow_ += static_cast<float>(too_dark);
            light_ += static_cast<float>(too_bright);
        }
        ++pixels_;
    }

    [[nodiscard]] store::Rgb gl() const { return encode_srgb(gl_ / static_cast<float>(pixels_)); }
    [[nodiscard]] store::Rgb truth() const
    {
        return encode_srgb(truth_ / static_cast<float>(pixels_));
    }
    [[nodiscard]] store::Rgb error() const
    {
        const Mark mark = strongest_mark();
        if (mark != Mark::none) {
            return mark_colour(mark);
        }
        const Vec3f mean = truth_ / static_cast<float>(pixels_);
        // Desaturate slightly, so that only marks are coloured.
        const Vec3f grey{glm::dot(mean, Vec3f{0.2126F, 0.7152F, 0.0722F})};
        return tinted(encode_srgb(glm::mix(glm::mix(mean, grey, 0.5F), Vec3f{1}, fade)));
    }

private:
    [[nodiscard]] std::uint32_t count(Mark mark) const
    {
        return marks_[static_cast<std::size_t>(mark)];
    }
    [[nodiscard]] Mark strongest_mark() const
    {
        const std::uint32_t false_shadow = count(Mark::false_shadow);
        const std::uint32_t false_lit = count(Mark::false_lit);
        if (false_shadow + false_lit > 0) {
            return false_lit >= false_shadow ? Mark::false_lit : Mark::false_shadow;
        }
        if (count(Mark::unmatched) > 0) {
            return Mark::unmatched;
        }
        return count(Mark::indeterminate) > 0 ? Mark::indeterminate : Mark::none;
    }

    /// Tints the pixel by the amount that its correct verdicts are off.
    [[nodiscard]] store::Rgb tinted(const store::Rgb& faded) const
    {
        const store::Rgb mark =
            mark_colour(light_ >= shadow_ ? Mark::false_lit : Mark::false_shadow);
        const float share = std::max(light_, shadow_) / static_cast<float>(pixels_);
        const auto mixed = [&](std::uint8_t from, std::uint8_t to) {
            return static_cast<std::uint8_t>(
                std::lround(std::lerp(static_cast<float>(from), static_cast<float>(to), share)));
        };
        return {mixed(faded.r, mark.r), mixed(faded.g, mark.g), mixed(faded.b, mark.b)};
    }

    Vec3f gl_{0};
    Vec3f truth_{0};
    float shadow_ = 0; ///< sum of the errors of unmarked lit pixels
    float light_ = 0;  ///< the same sum for blocked pixels
    std::array<std::uint32_t, 5> marks_{};
    std::uint32_t pixels_ = 0;
};

} // namespace

Mark mark_of(PixelClass pixel_class, float verdict)
{
    switch (pixel_class) {
    case PixelClass::lit:
        return scene::is_false_shadow(pixel_class, verdict) ? Mark::false_shadow : Mark::none;
    case PixelClass::blocked:
        return scene::is_false_lit(pixel_class, verdict) ? Mark::false_lit : Mark::none;
    case PixelClass::unmatched:
        return Mark::unmatched;
    case PixelClass::indeterminate:
        return Mark::indeterminate;
    case PixelClass::background:
    case PixelClass::attached:
    case PixelClass::out_of_light:
        return Mark::none;
    }
    return Mark::none; // not reached
}

store::Rgb mark_colour(Mark mark)
{
    switch (mark) {
    case Mark::false_shadow:
        return {0xD5, 0x5E, 0x00}; // vermillion
    case Mark::false_lit:
        return {0x00, 0x72, 0xB2}; // blue
    case Mark::unmatched:
        return {0xCC, 0x79, 0xA7}; // reddish purple
    case Mark::indeterminate:
        return {0x00, 0x00, 0x00};
    case Mark::none:
        break;
    }
    return {0xFF, 0xFF, 0xFF};
}

namespace {

Panels draw(const PanelSource& source, scene::ImageSize size, const ImagePart& part)
{
    Panels panels{store::RgbImage{size}, store::RgbImage{size}, store::RgbImage{size}};
    for (int y = 0; y < size.height_px; ++y) {
        const Span rows = covered(y, size.height_px, part.top, part.size.height_px);
        for (int x = 0; x < size.width_px; ++x) {
            const Span columns = covered(x, size.width_px, part.left, part.size.width_px);
            PixelAccumulator accumulator;
            for (int row = rows.first; row < rows.last; ++row) {
                for (int column = columns.first; column < columns.last; ++column) {
                    accumulator.add(source, source.shades.index(column, row));
                }
            }
            panels.gl(x, y) = accumulator.gl();
            panels.truth(x, y) = accumulator.truth();
            panels.errors(x, y) = accumulator.error();
        }
    }
    return panels;
}

ImagePart whole_of(const PanelSource& source)
{
    return {0, 0, source.shades.size()};
}

} // namespace

Panels draw_panels(const analysis::Comparison& comparison, scene::ImageSize size,
                   const std::optional<ImagePart>& part)
{
    const PanelSource source = source_of(comparison);
    return draw(source, size, part.value_or(whole_of(source)));
}

store::RgbImage draw_errors(const analysis::Comparison& comparison,
                            const scene::Image<float>& verdicts, scene::ImageSize size,
                            const std::optional<ImagePart>& part)
{
    PanelSource source = source_of(comparison);
    source.verdicts = verdicts;
    return draw(source, size, part.value_or(whole_of(source))).errors;
}

Panels draw_panels(store::LayerFile& layers, scene::ImageSize size)
{
    const PanelSource source = source_of(layers);
    return draw(source, size, whole_of(source));
}

} // namespace gnomon::reports
