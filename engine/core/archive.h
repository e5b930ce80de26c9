// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace limn {

// One list of fields serves all directions: `template <class A, class T> void fields(A& a, T& t)`
// calls a("name", t.field, rules...) for each field. It writes with a ByteWriter and a const T,
// reads with a ByteReader and a T, and checks the rules with a FieldCheck. Data is little-endian,
// as in memory; an array or string is a u64 count followed by its elements.

/// Appends fields to `bytes`.
class ByteWriter {
public:
    std::string bytes;

    template <class T, class... Rules>
    requires(sizeof...(Rules) > 0) void operator()(std::string_view, const T& field,
                                                   const Rules&...) {
        put(field);
    }
    template <class T, class Rule, class F>
    void each(std::string_view, const std::vector<T>& v, const Rule&, const F& fields) {
        put(std::uint64_t(v.size()));
        for (const T& element : v)
            fields(element);
    }

    template <class T>
    requires std::is_trivially_copyable_v<T>
    void put(const T& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); }
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void put(const std::vector<T>& v) {
        put(std::uint64_t(v.size()));
        bytes.append(reinterpret_cast<const char*>(v.data()), v.size() * sizeof(T));
    }
    void put(const std::string& s) {
        put(std::uint64_t(s.size()));
        bytes += s;
    }
};

/// Reads fields from bytes, which must outlive the reader. If the bytes end too early, `ok` becomes
/// false and the fields are empty; no count makes it allocate more than the bytes could hold.
class ByteReader {
public:
    explicit ByteReader(std::string_view source) : m_rest(source) {}
    bool ok = true;
    bool atEnd() const { return m_rest.empty(); }

    template <class T, class... Rules>
    requires(sizeof...(Rules) > 0) void operator()(std::string_view, T& field, const Rules&...) {
        take(field);
    }
    /// Also applies the rule, so that `fields` may rely on the number of elements.
    template <class T, class Rule, class F>
    void each(std::string_view, std::vector<T>& v, const Rule& rule, const F& fields) {
        v.resize(count(sizeof(std::uint64_t))); // an element is at least an array's length
        if (rule(v)) {
            ok = false;
            v.clear();
        }
        for (T& element : v)
            fields(element);
    }

private:
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void take(T& value) { takeBytes(&value, sizeof value); }
    /// Any byte other than 0 or 1 is invalid.
    void take(bool& value) {
        std::uint8_t byte = 0;
        take(byte);
        ok = ok && byte <= 1;
        value = byte == 1;
    }
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void take(std::vector<T>& v) {
        v.resize(count(sizeof(T)));
        takeBytes(v.data(), v.size() * sizeof(T));
    }
    void take(std::string& s) {
        s.resize(count(1));
        takeBytes(s.data(), s.size());
    }
    void takeBytes(void* out, std::size_t size) {
        if (size > m_rest.size()) {
            ok = false;
            m_rest = {};
            return;
        }
        if (size > 0)
            std::memcpy(out, m_rest.data(), size);
        m_rest.remove_prefix(size);
    }
    /// Reads a count of elements of at least `elementSize` bytes; 0 if the remaining bytes cannot
    /// hold them.
    std::size_t count(std::size_t elementSize) {
        std::uint64_t n = 0;
        take(n);
        if (n > m_rest.size() / elementSize) {
            ok = false;
            return 0;
        }
        return std::size_t(n);
    }

    std::string_view m_rest;
};

} // namespace limn
