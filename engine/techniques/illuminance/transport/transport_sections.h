// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace limn {

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
