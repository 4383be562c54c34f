#pragma once

#include "store/json_values.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Members of a run's kept JSON. It may come from anywhere: a member of another type reads as
/// missing.
namespace gnomon::reports {

[[nodiscard]] inline const store::Json* member(const store::Json& object, std::string_view name)
{
    const auto found = object.is_object() ? object.find(name) : object.end();
    return found == object.end() || found->is_null() ? nullptr : &*found;
}

[[nodiscard]] inline std::optional<double> number_of(const store::Json& object,
                                                     std::string_view name)
{
    const store::Json* const found = member(object, name);
    return found != nullptr && found->is_number() ? std::optional{found->get<double>()}
                                                  : std::nullopt;
}

[[nodiscard]] inline std::string text_of(const store::Json& object, std::string_view name)
{
    const store::Json* const found = member(object, name);
    return found != nullptr && found->is_string() ? found->get<std::string>() : std::string{};
}

/// An array's elements; none if there is no such array.
[[nodiscard]] inline std::vector<store::Json> list_of(const store::Json& object,
                                                      std::string_view name)
{
    const store::Json* const found = member(object, name);
    return found != nullptr && found->is_array()
               ? std::vector<store::Json>{found->begin(), found->end()}
               : std::vector<store::Json>{};
}

[[nodiscard]] inline std::vector<std::string> texts_of(const store::Json& object,
                                                       std::string_view name)
{
    std::vector<std::string> texts;
    for (const store::Json& element : list_of(object, name)) {
        if (element.is_string()) {
            texts.push_back(element.get<std::string>());
        }
    }
    return texts;
}

} // namespace gnomon::reports
