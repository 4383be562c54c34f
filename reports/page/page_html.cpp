#include "reports/page/page_html.hpp"

#include "reports/page/packed_blocks.hpp"
#include "reports/page/page_assets.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::reports {

namespace {

/// A hash in the form of a Content-Security-Policy.
std::string csp_hash(const PageAsset& asset)
{
    std::vector<std::byte> bytes;
    for (std::size_t i = 0; i + 1 < asset.sha256.size(); i += 2) {
        std::uint8_t byte = 0;
        std::from_chars(asset.sha256.data() + i, asset.sha256.data() + i + 2, byte, 16);
        bytes.push_back(std::byte{byte});
    }
    return fmt::format("'sha256-{}'", base64(bytes));
}

std::string head(std::string_view title)
{
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src {} "
        "{}; style-src {}; img-src data: blob:; base-uri 'none'; form-action 'none'\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<title>{}</title>\n<style>{}</style>\n</head>\n",
        csp_hash(page_charts()), csp_hash(page_script()), csp_hash(page_style()), escaped(title),
        page_style().text);
}

/// JSON whose texts cannot end the surrounding script element.
std::string script_safe(const store::Json& data)
{
    std::string text = data.dump(-1, ' ', false, store::Json::error_handler_t::replace);
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
        text.replace(at, 1, "\\u003c");
    }
    return text;
}

} // namespace

std::string escaped(std::string_view text)
{
    std::string html;
    html.reserve(text.size());
    for (const char c : text) {
        switch (c) {
        case '&':
            html += "&amp;";
            break;
        case '<':
            html += "&lt;";
            break;
        case '>':
            html += "&gt;";
            break;
        case '"':
            html += "&quot;";
            break;
        case '\'':
            html += "&#39;";
            break;
        default:
            html += c;
        }
    }
    return html;
}

std::string number_cell(std::string_view text)
{
    return fmt::format("<td class=\"number\">{}</td>", escaped(text));
}

std::string row_heading(std::string_view text)
{
    return fmt::format("<th scope=\"row\"><bdi>{}</bdi></th>", escaped(text));
}

std::string table_head(std::string_view caption, std::span<const std::string_view> columns)
{
    std::string html = fmt::format(
        "<div class=\"scroll\"><table><caption>{}</caption>\n<thead><tr>", escaped(caption));
    bool is_first = true;
    for (const std::string_view column : columns) {
        html += fmt::format("<th scope=\"col\"{}>{}</th>", is_first ? "" : " class=\"number\"",
                            escaped(column));
        is_first = false;
    }
    return html + "</tr></thead>\n<tbody>\n";
}

std::string table_head(std::string_view caption, std::initializer_list<std::string_view> columns)
{
    return table_head(caption, std::span{columns.begin(), columns.size()});
}

std::string plain_page(std::string_view title, std::string_view body)
{
    return head(title) + std::string{body};
}

std::string picture_figure(const HeadlinePicture& picture, std::string_view caption,
                           std::string_view note)
{
    return fmt::format("<figure><img src=\"{}\" alt=\"{}\" width=\"{}\" height=\"{}\"><figcaption>"
                       "<b>{}</b><span>{}</span></figcaption></figure>\n",
                       picture.address, escaped(picture.alt), picture.size.width_px,
                       picture.size.height_px, escaped(caption), note);
}

std::string whole_page(std::string_view title, std::string_view body, const store::Json& data,
                       std::span<const std::string> blocks)
{
    std::string page = head(title);
    page += body;
    page += "<script type=\"application/json\" id=\"gnomon-data\">";
    page += script_safe(data);
    page += "</script>\n";
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        page += fmt::format("<script type=\"text/plain\" class=\"block\" id=\"b{}\">", i);
        page += blocks[i];
        page += "</script>\n";
    }
    for (const PageAsset& script : {page_charts(), page_script()}) {
        page += "<script>";
        page += script.text;
        page += "</script>\n";
    }
    return page + "</body>\n</html>\n";
}

} // namespace gnomon::reports
