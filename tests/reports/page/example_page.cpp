#include "example_page.hpp"

#include "example_run.hpp"
#include "reports/json/comparison_json.hpp"
#include "store/csv/csv_text.hpp"
#include "store/exr/aov.hpp"
#include "store/output_file.hpp"
#include "store/run/run_store.hpp"
#include "store/run_folder/pixels.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::reports {

namespace {

std::vector<Bytef> decoded_base64(const std::string& text)
{
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<Bytef> bytes;
    std::uint32_t group = 0;
    int bits = 0;
    for (const char c : text) {
        if (c == '=') {
            break;
        }
        const std::size_t digit = digits.find(c);
        if (digit == std::string_view::npos) {
            throw std::runtime_error("not base64");
        }
        group = group << 6U | static_cast<std::uint32_t>(digit);
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes.push_back(static_cast<Bytef>(group >> static_cast<unsigned>(bits) & 0xFFU));
        }
    }
    return bytes;
}

std::size_t width_of(const std::string& type)
{
    return type == "u8" ? 1 : type == "u16" ? 2 : type == "f64" ? 8 : 4;
}

} // namespace

std::vector<std::uint64_t> unpacked(const std::string& text, std::size_t bytes_each,
                                    int differences)
{
    const std::vector<Bytef> packed = decoded_base64(text);
    std::vector<Bytef> planes(1U << 16U);
    uLongf size = 0;
    int outcome = Z_BUF_ERROR;
    while (outcome == Z_BUF_ERROR) { // the buffer is too small
        planes.resize(2 * planes.size());
        size = planes.size();
        outcome = uncompress(planes.data(), &size, packed.data(), packed.size());
    }
    if (outcome != Z_OK) {
        throw std::runtime_error("not zlib");
    }
    const std::size_t count = size / bytes_each;
    std::vector<std::uint64_t> numbers(count);
    for (std::size_t i = 0; i < size; ++i) {
        numbers[i % count] |= std::uint64_t{planes[i]} << (8 * (i / count));
    }
    const std::uint64_t mask = bytes_each == 8 ? ~0ULL : (1ULL << (8 * bytes_each)) - 1;
    for (int pass = 0; pass < differences; ++pass) {
        for (std::size_t i = 1; i < count; ++i) {
            numbers[i] = (numbers[i] + numbers[i - 1]) & mask;
        }
    }
    return numbers;
}

ReadPage::ReadPage(std::string html)
    : html_{std::move(html)},
      data_(nlohmann::json::parse(script("gnomon-data"))) // braces would make an array
{
}

std::string ReadPage::script(const std::string& id) const
{
    const std::string mark = fmt::format("id=\"{}\">", id);
    const std::size_t first = html_.find(mark);
    if (first == std::string::npos) {
        throw std::runtime_error("no element " + id);
    }
    const std::size_t begin = first + mark.size();
    return html_.substr(begin, html_.find("</script", begin) - begin);
}

std::vector<std::uint64_t> ReadPage::bits(const nlohmann::json& block) const
{
    auto numbers =
        unpacked(script(block.at("block")), width_of(block.at("type")), block.at("delta"));
    if (numbers.size() != block.at("count")) {
        throw std::runtime_error("another number of numbers");
    }
    return numbers;
}

std::vector<float> ReadPage::floats(const nlohmann::json& block) const
{
    std::vector<float> values;
    for (const std::uint64_t number : bits(block)) {
        values.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(number)));
    }
    return values;
}

std::vector<std::string> ReadPage::texts(const nlohmann::json& column) const
{
    constexpr std::uint64_t none = 0xFFFFFFFF;
    const std::string type = column.at("type");
    std::vector<std::string> all;
    for (const std::uint64_t number : bits(column)) {
        if (type == "text") {
            all.push_back(number == none ? "" : column.at("dictionary").at(number));
        } else if (type == "f64") {
            const auto value = std::bit_cast<double>(number);
            all.push_back(std::isnan(value) ? "" : store::cell_text(value));
        } else {
            all.push_back(fmt::format("{}", number));
        }
    }
    return all;
}

ReadPage written_page(const std::filesystem::path& run, const std::filesystem::path& out,
                      std::size_t most_image_bytes)
{
    std::filesystem::create_directories(out);
    write_report_csv(run, out);
    write_report({run, out, {}, "python3-matplotlib is missing", {}, {}, most_image_bytes});
    return ReadPage{store::read_text(out / "report.html")};
}

void keep_example(const std::filesystem::path& folder, const analysis::Comparison& comparison)
{
    store::ExampleRun run;
    run.curves = 1;
    run.biases = 1;
    store::RunDescription description = run.description();
    description.axes = {};
    std::filesystem::create_directories(folder);
    store::RunStore store{folder, store::RunStore::Access::write};
    store.plan(description, run.configurations());
    analysis::FinishedCurve curve = run.curve(0);
    curve.rows.front().result.metrics = comparison.metrics;
    store.record(curve);
    const std::string id = run.configurations().front().id;
    store::make_pixels_folder(folder);
    store::write_file(store::detail_path(folder, id), comparison_json(comparison));
    store::write_aov(store::pixels_path(folder, id), comparison, store::example().points);
}

} // namespace gnomon::reports
