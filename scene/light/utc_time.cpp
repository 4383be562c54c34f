#include "scene/light/utc_time.hpp"

#include <charconv>
#include <cstddef>

namespace gnomon::scene {
namespace {

/// Reads a text from its beginning; once something is not as expected, nothing more is.
class TimeReader {
public:
    explicit TimeReader(std::string_view text) : rest_{text} {}

    [[nodiscard]] bool is_sound() const { return is_sound_; }
    [[nodiscard]] bool is_at_end() const { return rest_.empty(); }

    /// A number of exactly so many digits, in a range.
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

    /// Digits after a point, of which three count.
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

/// What the offset at the end says is to be taken off: "Z", "+02:00".
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

} // namespace gnomon::scene
