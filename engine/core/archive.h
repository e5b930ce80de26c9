// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace limn {

// One list of fields serves both directions: `template <class A, class T> void fields(A& a, T& t)`
// writes with a ByteWriter and a const T, reads and checks with a ByteReader and a T.
// Little-endian, as in memory: an array or string is a u64 count and its elements.

/// Appends fields to `bytes`.
class ByteWriter {
public:
    std::string bytes;

    template <class T>
    requires std::is_trivially_copyable_v<T>
    void operator()(const T& value) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void operator()(const std::vector<T>& v) {
        (*this)(std::uint64_t(v.size()));
        bytes.append(reinterpret_cast<const char*>(v.data()), v.size() * sizeof(T));
    }
    void operator()(const std::string& s) {
        (*this)(std::uint64_t(s.size()));
        bytes += s;
    }
    template <class T, class F>
    void each(const std::vector<T>& v, F field) {
        (*this)(std::uint64_t(v.size()));
        for (const T& element : v)
            field(element);
    }
};

/// Takes fields from bytes that outlive it. Where they end too soon `ok` becomes false and what is
/// read is empty; no count makes it allocate more than the bytes could hold.
class ByteReader {
public:
    explicit ByteReader(std::string_view source) : m_rest(source) {}
    bool ok = true;
    bool atEnd() const { return m_rest.empty(); }

    template <class T>
    requires std::is_trivially_copyable_v<T>
    void operator()(T& value) { take(&value, sizeof value); }
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void operator()(std::vector<T>& v) {
        v.resize(count(sizeof(T)));
        take(v.data(), v.size() * sizeof(T));
    }
    void operator()(std::string& s) {
        s.resize(count(1));
        take(s.data(), s.size());
    }
    template <class T, class F>
    void each(std::vector<T>& v, F field) {
        v.resize(count(1));
        for (T& element : v)
            field(element);
    }

private:
    void take(void* out, std::size_t size) {
        if (size > m_rest.size()) {
            ok = false;
            m_rest = {};
            return;
        }
        if (size > 0)
            std::memcpy(out, m_rest.data(), size);
        m_rest.remove_prefix(size);
    }
    /// A count of elements of at least `elementSize` bytes that the rest can hold.
    std::size_t count(std::size_t elementSize) {
        std::uint64_t n = 0;
        take(&n, sizeof n);
        if (n > m_rest.size() / elementSize) {
            ok = false;
            return 0;
        }
        return std::size_t(n);
    }

    std::string_view m_rest;
};

} // namespace limn
