// SPDX-License-Identifier: MIT
#pragma once

#include "engine/runtime/xxhash64.h"

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace limn {

/// Where a section of a transport file lies: its entry in the table, and its bytes.
struct SectionPlace {
    std::string tag;
    std::size_t entry, begin, end;
};

/// The sections of a valid file.
inline std::vector<SectionPlace> sectionsOf(const std::string& file) {
    std::uint32_t count;
    std::memcpy(&count, &file[16], sizeof count);
    std::vector<SectionPlace> sections;
    for (std::size_t at = 64; at < 64 + std::size_t(32) * count; at += 32) {
        std::uint64_t place[2];
        std::memcpy(place, &file[at + 8], sizeof place);
        sections.push_back(
            {file.substr(at, 4), at, std::size_t(place[0]), std::size_t(place[0] + place[1])});
    }
    return sections;
}

inline SectionPlace sectionOf(const std::string& file, const std::string& tag) {
    for (const SectionPlace& section : sectionsOf(file))
        if (section.tag == tag)
            return section;
    return {};
}

/// Whether a byte belongs to no section.
inline bool isPadding(const std::string& file, std::size_t at) {
    const std::vector<SectionPlace> sections = sectionsOf(file);
    if (at < 64 + 32 * sections.size())
        return false;
    for (const SectionPlace& section : sections)
        if (at >= section.begin && at < section.end)
            return false;
    return true;
}

/// Changes the bytes of a section, not their number.
template <class Change>
void changeSection(std::string& file, const std::string& tag, const Change& change) {
    const SectionPlace place = sectionOf(file, tag);
    std::string section = file.substr(place.begin, place.end - place.begin);
    change(section);
    file.replace(place.begin, section.size(), section);
}

/// Puts all hashes right that lie within the file.
inline void rehash(std::string& file) {
    if (file.size() < 64)
        return;
    std::uint32_t count;
    std::memcpy(&count, &file[16], sizeof count);
    std::size_t at = 64;
    for (; count > 0 && file.size() - at >= 32; at += 32, --count) {
        std::uint64_t place[2];
        std::memcpy(place, &file[at + 8], sizeof place);
        if (place[0] > file.size() || place[1] > file.size() - place[0])
            continue;
        const std::uint64_t hash = runtime::xxhash64(file.data() + place[0], std::size_t(place[1]));
        std::memcpy(&file[at + 24], &hash, sizeof hash);
    }
    const std::uint64_t hash = runtime::xxhash64(file.data() + 64, at - 64);
    std::memcpy(&file[32], &hash, sizeof hash);
}

} // namespace limn
