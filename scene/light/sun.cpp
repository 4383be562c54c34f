#include "scene/light/sun.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace gnomon::scene {
namespace {

/// Reads a text from its beginning; an unexpected character makes it unsound for good.
class TimeReader {
public:
    explicit TimeReader(std::string_view text) : rest_{text} {}

    [[nodiscard]] bool is_sound() const { return is_sound_; }
    [[nodiscard]] bool is_at_end() const { return rest_.empty(); }

    /// Reads a number of exactly this many digits, within a range.
    int number(std::size_t digits, int least, int most)
    {
        int value = 0;
        const std::string_view text = rest_.substr(0, digits);
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool is_whole = text.size() == digits && end == text.data() + digits &&
                              text.find_first_not_of("0123456789") == std::string_view::npos;
        is_sound_ =
            is_sound_ && error == std::errc{} && is_whole && value >= least && value <= most;
        rest_.remove_prefix(text.size());
        return value;
    }

    [[nodiscard]] bool takes(char letter)
    {
        const bool is_there = rest_.starts_with(letter);
        rest_.remove_prefix(is_there ? 1 : 0);
        return is_there;
    }
    void expect(char letter) { is_sound_ = takes(letter) && is_sound_; }

    /// Reads fractional digits; only the first three count.
    int milliseconds()
    {
        int value = 0;
        int scale = 100;
        std::size_t digits = 0;
        for (; digits < rest_.size() && rest_[digits] >= '0' && rest_[digits] <= '9'; ++digits) {
            value += scale * (rest_[digits] - '0');
            scale /= 10;
        }
        is_sound_ = is_sound_ && digits > 0;
        rest_.remove_prefix(digits);
        return value;
    }

private:
    std::string_view rest_;
    bool is_sound_ = true;
};

/// The offset from UTC to subtract: "Z", "+02:00".
std::chrono::minutes read_offset(TimeReader& reader)
{
    if (reader.takes('Z')) {
        return {};
    }
    const bool is_behind = reader.takes('-');
    if (!is_behind) {
        reader.expect('+');
    }
    const std::chrono::hours hours{reader.number(2, 0, 23)};
    reader.expect(':');
    const std::chrono::minutes offset = hours + std::chrono::minutes{reader.number(2, 0, 59)};
    return is_behind ? -offset : offset;
}

} // namespace

std::optional<UtcTime> utc_time(std::string_view text)
{
    TimeReader reader{text};
    const std::chrono::year year{reader.number(4, 0, 9999)};
    reader.expect('-');
    const auto month = static_cast<unsigned>(reader.number(2, 1, 12));
    reader.expect('-');
    const auto day = static_cast<unsigned>(reader.number(2, 1, 31));
    reader.expect('T');
    const std::chrono::hours hours{reader.number(2, 0, 23)};
    reader.expect(':');
    const std::chrono::minutes minutes{reader.number(2, 0, 59)};
    std::chrono::milliseconds seconds{0};
    if (reader.takes(':')) {
        seconds = std::chrono::seconds{reader.number(2, 0, 59)};
        if (reader.takes('.')) {
            seconds += std::chrono::milliseconds{reader.milliseconds()};
        }
    }
    const std::chrono::minutes offset = read_offset(reader);
    const std::chrono::year_month_day date{year, std::chrono::month{month}, std::chrono::day{day}};
    if (!reader.is_sound() || !reader.is_at_end() || !date.ok()) {
        return std::nullopt;
    }
    return std::chrono::sys_days{date} + hours + minutes + seconds - offset;
}

namespace {

constexpr double turn = 2 * std::numbers::pi;

/// a sin x + b cos x, x a multiple of the year's angle.
struct YearTerm {
    double sine, cosine;
};
/// d sin(ωt + φ), a perturbation by the moon or a planet.
struct WaveTerm {
    double amplitude, frequency, phase;
};

constexpr std::array<YearTerm, 3> year_terms{
    {{3.33024e-2, -2.0582e-3}, {3.512e-4, -4.07e-5}, {5.2e-6, -9e-7}}};
constexpr std::array<WaveTerm, 7> wave_terms{{{1.27e-5, 1.49e-3, -2.337},
                                              {1.21e-5, 4.31e-3, 3.065},
                                              {2.33e-5, 1.076e-2, -1.533},
                                              {3.49e-5, 1.575e-2, -2.358},
                                              {2.67e-5, 2.152e-2, 0.074},
                                              {1.28e-5, 3.152e-2, 1.547},
                                              {3.14e-5, 2.1277e-1, -0.488}}};

/// Days since the year 2060 began.
double days_since_2060(UtcTime time)
{
    using Days = std::chrono::duration<double, std::chrono::days::period>;
    constexpr std::chrono::sys_days begin{std::chrono::year{2060} / 1 / 1};
    return Days{time - begin}.count();
}

/// The sun's ecliptic longitude, seen from the earth, without nutation [rad].
double ecliptic_longitude(double days)
{
    const double year_angle = 0.0172019715 * days;
    double longitude = 1.7527901 + 1.7202792159e-2 * days + std::numbers::pi;
    double multiple = 0;
    for (const YearTerm& term : year_terms) {
        multiple += year_angle;
        longitude += term.sine * std::sin(multiple) + term.cosine * std::cos(multiple);
    }
    longitude += -8.23e-5 * std::sin(year_angle) * std::sin(2.92e-5 * days);
    for (const WaveTerm& wave : wave_terms) {
        longitude += wave.amplitude * std::sin(wave.frequency * days + wave.phase);
    }
    return longitude;
}

struct Equatorial {
    double hour_angle; ///< at Greenwich [rad]
    double declination;
};

Equatorial equatorial(double days)
{
    // Terrestrial time minus universal time, extrapolated.
    const double ahead_s = 96.4 + 0.00158 * days;
    const double terrestrial = days + ahead_s / 86400;
    const double node = 9.282e-4 * terrestrial - 0.8;
    const double nutation = 8.34e-5 * std::sin(node);
    const double longitude = ecliptic_longitude(terrestrial) + nutation;
    const double obliquity = 4.089567e-1 - 6.19e-9 * terrestrial + 4.46e-5 * std::cos(node);
    const double right_ascension =
        std::atan2(std::sin(longitude) * std::cos(obliquity), std::cos(longitude));
    return {1.7528311 + 6.300388099 * days - right_ascension + 0.92 * nutation,
            std::asin(std::sin(longitude) * std::sin(obliquity))};
}

} // namespace

bool has_sun(UtcTime time)
{
    return time >= std::chrono::sys_days{std::chrono::year{first_sun_year} / 1 / 1} &&
           time < std::chrono::sys_days{std::chrono::year{last_sun_year + 1} / 1 / 1};
}

SunPosition sun_position(double latitude_deg, double longitude_deg, UtcTime time)
{
    constexpr double parallax = 4.26e-5; // of the sun at the horizon
    const auto [greenwich, declination] = equatorial(days_since_2060(time));
    const double hour_angle = greenwich + glm::radians(longitude_deg);
    const double latitude = glm::radians(latitude_deg);
    const double sine =
        std::clamp(std::sin(latitude) * std::sin(declination) +
                       std::cos(latitude) * std::cos(declination) * std::cos(hour_angle),
                   -1.0, 1.0);
    const double elevation = std::asin(sine) - parallax * std::sqrt(1 - sine * sine);
    const double from_south =
        std::atan2(std::sin(hour_angle) * std::cos(declination),
                   std::cos(hour_angle) * std::cos(declination) * std::sin(latitude) -
                       std::sin(declination) * std::cos(latitude));
    const double from_north = from_south + std::numbers::pi;
    return {glm::degrees(from_north < turn ? from_north : from_north - turn),
            glm::degrees(elevation)};
}

Vec3d sun_direction(const SunPosition& sun, const Vec3d& north)
{
    const Vec3d up{0, 1, 0};
    const Vec3d ahead = glm::normalize(Vec3d{north.x, 0, north.z});
    const Vec3d east = glm::cross(ahead, up);
    const double azimuth = glm::radians(sun.azimuth_deg);
    const double elevation = glm::radians(sun.elevation_deg);
    return -(std::cos(elevation) * (std::sin(azimuth) * east + std::cos(azimuth) * ahead) +
             std::sin(elevation) * up);
}

LightSettings with_direction(LightSettings light, const Vec3d& north)
{
    if (!light.sun) {
        return light;
    }
    const SunPosition sun = sun_position(light.sun->latitude_deg, light.sun->longitude_deg,
                                         utc_time(light.sun->time).value());
    light.direction = sun_direction(sun, north);
    light.sun.reset();
    return light;
}

} // namespace gnomon::scene
