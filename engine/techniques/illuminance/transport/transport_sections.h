// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace limn {

/// An entry of a transport file's table of sections.
struct TransportEntry {
    char tag[4];
    std::uint32_t elementSize;
    std::uint64_t offset, bytes, hash;
};
static_assert(sizeof(TransportEntry) == 32);

/// Bytes of a transport file before its table.
inline constexpr std::size_t kTransportHeaderBytes = 64;

/// The table of a file that TransportSections wrote, in the order of offsets.
std::vector<TransportEntry> transportTable(std::string_view file);

/// The bytes of a section of such a file. Precondition: it is there.
std::string_view transportSection(std::string_view file, std::string_view tag);

/// Collects the sections of a transport file and writes header, table and sections.
class TransportSections {
public:
    /// Adds a section; `tag` has four letters. Elements have no padding.
    template <class T>
    void add(const char* tag, std::span<const T> elements) {
        static_assert(std::is_trivially_copyable_v<T>);
        addBytes(
            tag, sizeof(T),
            std::string(reinterpret_cast<const char*>(elements.data()), elements.size_bytes()));
    }
    template <class T>
    void add(const char* tag, const std::vector<T>& elements) {
        add(tag, std::span<const T>(elements));
    }
    void addBytes(const char* tag, std::uint32_t elementSize, std::string bytes);

    /// The file's bytes.
    std::string file() const;

private:
    struct Section {
        const char* tag;
        std::uint32_t elementSize;
        std::string bytes;
    };
    std::vector<Section> m_sections;
};

} // namespace limn
