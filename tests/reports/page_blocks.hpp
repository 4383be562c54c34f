#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::reports {

/// A page as another program reads it, by docs/report.md alone.
class ReadPage {
public:
    explicit ReadPage(std::string html);

    [[nodiscard]] const std::string& html() const { return html_; }
    [[nodiscard]] const nlohmann::json& data() const { return data_; }
    /// The text of the element with that id, up to the next end of a script.
    [[nodiscard]] std::string script(const std::string& id) const;

    /// The bits of a block's numbers.
    [[nodiscard]] std::vector<std::uint64_t> bits(const nlohmann::json& block) const;
    [[nodiscard]] std::vector<float> floats(const nlohmann::json& block) const;
    /// A column of the table, as the CSV file has it: texts, empty for no value.
    [[nodiscard]] std::vector<std::string> texts(const nlohmann::json& column) const;

private:
    std::string html_;
    nlohmann::json data_;
};

/// Undoes base64 and zlib, planes and differences.
/// @param bytes_each  1, 2, 4 or 8.
[[nodiscard]] std::vector<std::uint64_t> unpacked(const std::string& text, std::size_t bytes_each,
                                                  int differences);

} // namespace gnomon::reports
