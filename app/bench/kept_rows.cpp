// SPDX-License-Identifier: MIT
#include "app/bench/kept_rows.h"

#include "engine/core/read_file.h"
#include "engine/core/replace_file.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace limn {

Result<KeptRows> KeptRows::open(const std::string& folder, const std::string& name) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        return fail(fmt::format("{}: {}", folder, error.message()));
    KeptRows rows;
    rows.m_path = folder + "/" + name + ".rows";
    if (!std::filesystem::exists(rows.m_path, error))
        return rows;
    Result<std::string> text = readFile(rows.m_path);
    if (!text)
        return fail(fmt::format("{}: {}", rows.m_path, text.error().message));
    int line = 1;
    for (std::size_t begin = 0; begin < text->size(); ++line) {
        const std::size_t end = std::min(text->find('\n', begin), text->size());
        const Result<Json> kept = parseJson(std::string_view(*text).substr(begin, end - begin));
        if (!kept || !(*kept)["key"].isString() || !(*kept)["row"].isObject())
            return fail(fmt::format("{}: line {} is no row of a benchmark", rows.m_path, line));
        rows.m_rows[(*kept)["key"].get<std::string>()] = (*kept)["row"];
        begin = end + 1;
    }
    rows.m_text = std::move(*text);
    return rows;
}

const Json* KeptRows::find(const std::string& key) const {
    const auto row = m_rows.find(key);
    return row == m_rows.end() ? nullptr : &row->second;
}

Result<void> KeptRows::keep(const std::string& key, const Json& row) {
    m_text += Json{{"key", key}, {"row", row}}.dump() + "\n";
    m_rows[key] = row;
    return replaceFile(m_path, m_text);
}

} // namespace limn
