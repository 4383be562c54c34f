#pragma once

#include "example_comparison.hpp"
#include "reports/page/report.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::reports {

/// Reads a page independently of the writer, as docs/report.md describes it.
class ReadPage {
public:
    explicit ReadPage(std::string html);

    [[nodiscard]] const std::string& html() const { return html_; }
    [[nodiscard]] const nlohmann::json& data() const { return data_; }
    /// The text of the script element with this id.
    [[nodiscard]] std::string script(const std::string& id) const;

    /// The numbers of a block, as bits.
    [[nodiscard]] std::vector<std::uint64_t> bits(const nlohmann::json& block) const;
    [[nodiscard]] std::vector<float> floats(const nlohmann::json& block) const;
    /// A column of the table as CSV texts; empty for no value.
    [[nodiscard]] std::vector<std::string> texts(const nlohmann::json& column) const;

private:
    std::string html_;
    nlohmann::json data_;
};

/// Decodes base64, zlib, byte planes and differences.
/// @param bytes_each  1, 2, 4 or 8.
[[nodiscard]] std::vector<std::uint64_t> unpacked(const std::string& text, std::size_t bytes_each,
                                                  int differences);

/// A text that a page must show without interpreting it.
inline const std::string hostile_text =
    "</script><img src=x onerror=alert(1)> \"'&\u202e\U0001f600";

/// Writes the report of a run and reads it back.
/// @param most_image_bytes  Limit for all layers.
[[nodiscard]] ReadPage
written_page(const std::filesystem::path& run, const std::filesystem::path& out,
             std::size_t most_image_bytes = ReportOptions{}.most_image_bytes);

/// Writes a run of one comparison, with its layers.
void keep_example(const std::filesystem::path& folder,
                  const analysis::Comparison& comparison = store::example().comparison);

} // namespace gnomon::reports
