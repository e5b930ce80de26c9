// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace limn {

struct JsonMember;

/// A JSON value. Objects keep the order in which members were added. Integers are exact; all other
/// numbers are doubles, and those that are not finite are written as null.
///
/// An initialiser list is an object if each of its elements is a list of a string and a value, and
/// an array otherwise: Json{{"size", 3}} has one member. The library that reads and writes the text
/// is included by json.cpp alone, because it costs a compiler seconds.
class Json {
    enum class Kind { Null, Boolean, Integer, Unsigned, Float, String, Array, Members };

public:
    Json(); ///< null
    Json(std::nullptr_t) : Json() {}
    template <std::same_as<bool> T>
    Json(T value) : Json(Kind::Boolean, value) {}
    template <std::integral T>
    requires(!std::same_as<T, bool>) Json(T value)
        : Json(std::is_signed_v<T> ? Kind::Integer : Kind::Unsigned,
               std::uint64_t(std::int64_t(value))) {}
    template <std::floating_point T>
    Json(T value) : Json(Kind::Float, 0, double(value)) {}
    Json(std::string value);
    Json(std::string_view value);
    Json(const char* value);
    Json(std::initializer_list<Json> values);
    Json(const std::map<std::string, double>& members);
    template <class T>
    Json(const std::vector<T>& values) : Json(Kind::Array) {
        for (const T& value : values)
            push_back(Json(value));
    }
    Json(const Json&);
    Json(Json&&) noexcept;
    Json& operator=(const Json&);
    Json& operator=(Json&&) noexcept;
    ~Json();

    static Json array(std::initializer_list<Json> values = {});
    static Json object();
    bool isNull() const { return m_kind == Kind::Null; }
    bool isBoolean() const { return m_kind == Kind::Boolean; }
    bool isInteger() const { return m_kind == Kind::Integer || m_kind == Kind::Unsigned; }
    bool isFloat() const { return m_kind == Kind::Float; }
    bool isNumber() const { return isInteger() || isFloat(); }
    bool isString() const { return m_kind == Kind::String; }
    bool isArray() const { return m_kind == Kind::Array; }
    bool isObject() const { return m_kind == Kind::Members; }

    /// The value as a bool, a number or a string. Precondition: it is one.
    template <class T>
    T get() const {
        if constexpr (std::same_as<T, bool>)
            return boolean();
        else if constexpr (std::floating_point<T>)
            return T(number());
        else if constexpr (std::integral<T>)
            return T(integer());
        else
            return text();
    }
    /// The integer, if it lies within T; none otherwise.
    template <std::integral T>
    std::optional<T> integerWithin() const {
        const bool fits = isInteger() && (m_kind == Kind::Unsigned || std::int64_t(m_integer) >= 0
                                              ? std::in_range<T>(m_integer)
                                              : std::in_range<T>(std::int64_t(m_integer)));
        return fits ? std::optional<T>(T(m_integer)) : std::nullopt;
    }

    /// Number of elements or members; 0 for all other values.
    std::size_t size() const;
    bool empty() const { return size() == 0; }
    // Arrays. Null becomes an array when something is added.
    void push_back(Json value);
    template <std::integral Index>
    Json& operator[](Index index) {
        return m_elements[std::size_t(index)];
    }
    template <std::integral Index>
    const Json& operator[](Index index) const {
        return m_elements[std::size_t(index)];
    }
    Json& back() { return m_elements.back(); }
    auto begin() { return m_elements.begin(); }
    auto end() { return m_elements.end(); }
    auto begin() const { return m_elements.begin(); }
    auto end() const { return m_elements.end(); }

    // Objects. Null becomes an object when a member is named, which is null until it is assigned.
    Json& operator[](std::string_view key);
    const Json& operator[](std::string_view key) const; ///< null if there is no such member
    const Json* find(std::string_view key) const;       ///< null: there is no such member
    bool contains(std::string_view key) const { return find(key) != nullptr; }
    std::span<const JsonMember> members() const;
    void update(const Json& object); ///< adds or replaces each of its members
    void erase(std::string_view key);

    /// The text: on one line, or with `indent` spaces for each level. Bytes of strings that are not
    /// UTF-8 are replaced by U+FFFD.
    std::string dump(int indent = -1) const;

    /// Numbers are equal if their values are; the order of members counts.
    friend bool operator==(const Json& a, const Json& b);

private:
    explicit Json(Kind kind, std::uint64_t integer = 0, double number = 0);
    bool boolean() const;
    double number() const;
    std::uint64_t integer() const; ///< signed ones in two's complement
    const std::string& text() const;

    Kind m_kind = Kind::Null;
    std::uint64_t m_integer = 0;
    double m_number = 0;
    std::string m_text;
    std::vector<Json> m_elements;
    std::vector<JsonMember> m_members;
};

struct JsonMember {
    std::string key;
    Json value;
};

/// Reads one JSON value. Fails, with the line and column, on text that is not JSON, and on arrays
/// and objects that are nested deeper than `maxDepth`. Of members of the same name the last counts.
Result<Json> parseJson(std::string_view text, int maxDepth = 64);

} // namespace limn
