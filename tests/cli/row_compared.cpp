#include "row_compared.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

namespace gnomon::testing {

namespace {

using Json = nlohmann::json;

/// The JSON member that a column names by its path; nullptr if there is none.
const Json* find_member(const Json& object, const std::string& column)
{
    if (object.at("job").contains(column)) {
        return &object.at("job").at(column);
    }
    const Json* member = &object;
    std::string rest = column;
    while (!rest.empty()) {
        const std::string name = rest.substr(0, rest.find('.'));
        rest.erase(0, name.size() + 1);
        if (member->is_null()) {
            return member; // a group that was not computed
        }
        if (member->is_array()) {
            const std::size_t index = name == "lo" ? 0 : name == "hi" ? 1 : std::stoul(name);
            member = &member->at(index);
        } else if (member->contains(name)) {
            member = &member->at(name);
        } else {
            return nullptr;
        }
    }
    return member;
}

/// Whether a cell equals the JSON value.
bool is_same(const std::string& cell, const Json& value)
{
    if (value.is_null()) {
        return cell.empty();
    }
    if (value.is_number()) {
        return !cell.empty() && std::strtod(cell.c_str(), nullptr) == value.get<double>();
    }
    if (value.is_string()) {
        return cell == value.get<std::string>();
    }
    return !cell.empty() && Json::parse(cell, nullptr, false) == value;
}

} // namespace

void expect_row_compares(const std::map<std::string, std::string>& row, const Json& compared)
{
    // Columns that a comparison has under another name, or not at all.
    const std::set<std::string> others{"schema",     "ordinal",   "id",       "curve",
                                       "case",       "status",    "message",  "scene_hash",
                                       "map_near_m", "map_far_m", "map_bytes"};
    std::size_t found = 0;
    for (const auto& [column, cell] : row) {
        const Json* value = find_member(compared, column);
        if (value != nullptr) {
            EXPECT_TRUE(is_same(cell, *value)) << column << ": " << cell << " and " << *value;
            ++found;
        } else if (!others.contains(column)) {
            EXPECT_EQ(cell, "") << column << " is a key that the job leaves out";
        }
    }
    EXPECT_EQ(row.at("scene_hash"), compared.at("scene").at("hash").get<std::string>());
    EXPECT_GT(found, 80U) << "columns were compared";
}

} // namespace gnomon::testing
