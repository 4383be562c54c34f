#pragma once

#include "scene/error.hpp"
#include "scene/job/toml.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace gnomon::reports {

/// Converts the values of a rule file; error messages name the file, line and key.
class RuleValues {
public:
    /// @param name  The file name for messages.
    explicit RuleValues(std::string name) : name_{std::move(name)} {}

protected:
    using TomlMember = scene::TomlMember;
    static constexpr std::size_t longest_id = 200;

    [[nodiscard]] const std::string& name() const { return name_; }

    [[noreturn]] void fail(const TomlMember& member, std::string_view problem) const
    {
        throw scene::InputError(fmt::format("{}:{}: {}: {}", name_, member.line,
                                            scene::one_line(member.key.substr(0, longest_id)),
                                            problem));
    }
    [[noreturn]] void fail_value(const TomlMember& member, std::string_view wanted) const
    {
        fail(member, fmt::format("{} is not {}", scene::toml_excerpt(member.node), wanted));
    }

    [[nodiscard]] const std::string& text(const TomlMember& member) const
    {
        const auto* const value = std::get_if<std::string>(&member.node.value);
        if (value == nullptr) {
            fail_value(member, "a string");
        }
        return *value;
    }

    [[nodiscard]] bool flag(const TomlMember& member) const
    {
        const auto* const value = std::get_if<bool>(&member.node.value);
        if (value == nullptr) {
            fail_value(member, "true or false");
        }
        return *value;
    }

    [[nodiscard]] double number(const TomlMember& member) const
    {
        if (const auto* integer = std::get_if<std::int64_t>(&member.node.value)) {
            return static_cast<double>(*integer);
        }
        const auto* const real = std::get_if<double>(&member.node.value);
        if (real == nullptr || !std::isfinite(*real)) {
            fail_value(member, "a finite number");
        }
        return *real;
    }

    [[nodiscard]] double positive(const TomlMember& member) const
    {
        const double value = number(member);
        if (value < 0) {
            fail_value(member, "a number from 0 up");
        }
        return value;
    }

    [[nodiscard]] double share(const TomlMember& member) const
    {
        const double value = number(member);
        if (value < 0 || value > 1) {
            fail_value(member, "a number from 0 to 1");
        }
        return value;
    }

    [[nodiscard]] double trade_off(const TomlMember& member) const
    {
        const auto* const value = std::get_if<double>(&member.node.value);
        const bool is_infinite = value != nullptr && std::isinf(*value) && *value > 0;
        return is_infinite ? *value : positive(member);
    }

    [[nodiscard]] double count(const TomlMember& member) const
    {
        const auto* const value = std::get_if<std::int64_t>(&member.node.value);
        if (value == nullptr || *value < 0) {
            fail_value(member, "a whole number from 0 up");
        }
        return static_cast<double>(*value);
    }

private:
    std::string name_;
};

} // namespace gnomon::reports
