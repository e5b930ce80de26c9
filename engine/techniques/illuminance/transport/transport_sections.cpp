// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/transport/transport_sections.h"

#include <bit>
#include <cstring>

#include <xxhash.h>

namespace limn {

namespace {

static_assert(std::endian::native == std::endian::little, "sections are written as in memory");

constexpr std::size_t kAlignment = 64;
constexpr std::uint32_t kMajor = 2, kMinor = 2;

struct Header {
    char magic[8] = {'L', 'I', 'M', 'N', 'R', 'T', '\r', '\n'};
    std::uint32_t major = kMajor, minor = kMinor, sections = 0, reserved = 0;
    std::uint64_t bytes = 0, tableHash = 0;
    std::uint64_t zero[3] = {};
};
static_assert(sizeof(Header) == kTransportHeaderBytes);

std::size_t aligned(std::size_t n) {
    return (n + kAlignment - 1) / kAlignment * kAlignment;
}

} // namespace

std::vector<TransportEntry> transportTable(std::string_view file) {
    Header header;
    std::memcpy(&header, file.data(), sizeof header);
    std::vector<TransportEntry> table(header.sections);
    std::memcpy(table.data(), file.data() + sizeof header, table.size() * sizeof(TransportEntry));
    return table;
}

std::string_view transportSection(std::string_view file, std::string_view tag) {
    for (const TransportEntry& entry : transportTable(file))
        if (std::string_view(entry.tag, sizeof entry.tag) == tag)
            return file.substr(std::size_t(entry.offset), std::size_t(entry.bytes));
    return {};
}

void TransportSections::addBytes(const char* tag, std::uint32_t elementSize, std::string bytes) {
    m_sections.push_back({tag, elementSize, std::move(bytes)});
}

std::string TransportSections::file() const {
    std::vector<TransportEntry> table;
    std::size_t end = sizeof(Header) + m_sections.size() * sizeof(TransportEntry);
    for (const Section& s : m_sections) {
        TransportEntry entry{{},
                             s.elementSize,
                             aligned(end),
                             s.bytes.size(),
                             XXH64(s.bytes.data(), s.bytes.size(), 0)};
        std::memcpy(entry.tag, s.tag, sizeof entry.tag);
        end = std::size_t(entry.offset) + s.bytes.size();
        table.push_back(entry);
    }
    Header header;
    header.sections = std::uint32_t(table.size());
    header.bytes = end;
    header.tableHash = XXH64(table.data(), table.size() * sizeof(TransportEntry), 0);
    std::string file(end, '\0');
    std::memcpy(file.data(), &header, sizeof header);
    std::memcpy(file.data() + sizeof header, table.data(), table.size() * sizeof(TransportEntry));
    for (std::size_t k = 0; k < table.size(); ++k)
        std::memcpy(file.data() + table[k].offset, m_sections[k].bytes.data(),
                    m_sections[k].bytes.size());
    return file;
}

} // namespace limn
