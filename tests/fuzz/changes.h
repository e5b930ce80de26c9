// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace limn {

/// One change of one field, to be found by counting.
struct Change {
    enum Kind : std::uint8_t { Set, Fill, Resize, Copy, Bits, Kinds };
    std::uint8_t field = 0;
    std::uint8_t kind = 0;
    std::uint16_t index = 0;     ///< of an array's element, modulo its size; a new size
    std::uint64_t value[2] = {}; ///< its first bytes become the element
};

/// A list of changes out of a fuzzer's bytes, 20 each.
class Changes {
public:
    explicit Changes(std::string_view bytes) : m_rest(bytes) {}

    template <class T>
    T number() {
        T value{};
        const std::size_t size = std::min(sizeof value, m_rest.size());
        if (size > 0)
            std::memcpy(&value, m_rest.data(), size);
        m_rest.remove_prefix(size);
        return value;
    }
    /// None once the bytes are used up.
    std::optional<Change> next() {
        if (m_rest.empty())
            return {};
        Change change;
        change.field = number<std::uint8_t>();
        change.kind = number<std::uint8_t>() % Change::Kinds;
        change.index = number<std::uint16_t>();
        change.value[0] = number<std::uint64_t>();
        change.value[1] = number<std::uint64_t>();
        return change;
    }

private:
    std::string_view m_rest;
};

/// Makes one change to the fields of a list, as engine/core/archive.h has them. Bools and texts
/// stay as they are: other bytes would be no bool.
struct ChangingArchive {
    const Change& change;
    std::size_t met = 0;

    template <class T, class... Rules>
    void operator()(std::string_view, T& field, const Rules&...) {
        if (met++ == change.field)
            alter(field);
    }
    template <class T, class Rule, class F>
    void each(std::string_view, std::vector<T>& v, const Rule&, const F& fields) {
        if (met++ == change.field && change.kind == Change::Resize)
            v.resize(change.index % (v.size() + 3));
        for (T& element : v)
            fields(element);
    }

private:
    template <class T>
    void set(T& value) const {
        std::memcpy(static_cast<void*>(&value), change.value,
                    std::min(sizeof value, sizeof change.value));
    }
    void alter(bool&) const {}
    void alter(std::string&) const {}
    template <class T>
    void alter(T& value) const {
        set(value);
    }
    template <class T>
    void alter(std::vector<T>& v) const {
        if (change.kind == Change::Resize) {
            T last{};
            set(last);
            v.resize(change.index % (v.size() + 3), last);
        } else if (v.empty()) {
            return;
        } else if (change.kind == Change::Fill) {
            for (T& element : v)
                set(element);
        } else if (change.kind == Change::Copy) {
            v[change.index % v.size()] = v[change.value[0] % v.size()];
        } else if (change.kind == Change::Bits) {
            reinterpret_cast<unsigned char*>(v.data())[change.index % (v.size() * sizeof(T))] ^=
                static_cast<unsigned char>(change.value[0]);
        } else {
            set(v[change.index % v.size()]);
        }
    }
};

} // namespace limn
