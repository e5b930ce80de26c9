// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/archive.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

namespace limn {

// Rules for the values of an archive's fields. A rule is called with the field and returns a
// description of the error, or nullptr. Rules may refer to other fields: fields are checked in the
// order in which they are listed, up to the first error.

/// Whether predicate(x) holds for every number in a number, an enum, a glm vector or matrix, or an
/// array of those.
template <class T, class Predicate>
bool allNumbers(const T& value, const Predicate& predicate) {
    if constexpr (std::is_enum_v<T>) {
        return predicate(std::underlying_type_t<T>(value));
    } else if constexpr (std::is_arithmetic_v<T>) {
        return predicate(value);
    } else if constexpr (requires { value.begin(); }) {
        for (const auto& element : value)
            if (!allNumbers(element, predicate))
                return false;
        return true;
    } else {
        for (int i = 0; i < T::length(); ++i)
            if (!allNumbers(value[i], predicate))
                return false;
        return true;
    }
}

namespace rule {

/// Accepts every value.
inline constexpr auto any = [](const auto&) -> const char* { return nullptr; };

/// Returns `words` if test(field) is false.
template <class Test>
auto holds(const char* words, Test test) {
    return
        [words, test](const auto& field) -> const char* { return test(field) ? nullptr : words; };
}

/// Returns `words` if test(index, element) is false for any element.
template <class Test>
auto each(const char* words, Test test) {
    return holds(words, [test](const auto& field) {
        for (std::size_t i = 0; i < field.size(); ++i)
            if (!test(i, field[i]))
                return false;
        return true;
    });
}

/// The field has n elements.
inline auto count(std::uint64_t n) {
    return holds("of another length", [n](const auto& field) { return field.size() == n; });
}
/// The field is empty or has n elements.
inline auto noneOr(std::uint64_t n) {
    return holds("of another length",
                 [n](const auto& field) { return field.empty() || field.size() == n; });
}

/// Every number is < end: for indices and enums.
inline auto below(std::uint64_t end) {
    return holds("out of range", [end](const auto& field) {
        return allNumbers(field, [end](auto x) { return std::uint64_t(x) < end; });
    });
}
/// Every number is < end or equal to `mark`.
inline auto belowOr(std::uint64_t end, std::uint32_t mark) {
    return holds("out of range", [end, mark](const auto& field) {
        return allNumbers(field, [=](std::uint32_t x) { return x < end || x == mark; });
    });
}
/// Every number is in [low, high]; NaN is rejected.
inline auto within(double low, double high) {
    return holds("out of range, or not a number", [low, high](const auto& field) {
        return allNumbers(field, [=](auto x) { return double(x) >= low && double(x) <= high; });
    });
}
/// Every number is finite.
inline constexpr auto finite = [](const auto& field) -> const char* {
    return allNumbers(field, [](auto x) { return std::isfinite(x); }) ? nullptr : "not a number";
};

/// The field has n + 1 non-decreasing offsets from 0 to `end`.
inline auto offsets(std::uint64_t n, std::uint64_t end) {
    return holds("offsets that do not cover what they should", [n, end](const auto& field) {
        if (field.size() != n + 1 || field.front() != 0 || field.back() != end)
            return false;
        for (std::size_t i = 0; i < n; ++i)
            if (field[i] > field[i + 1])
                return false;
        return true;
    });
}

} // namespace rule

/// The archive that checks what another one has read: it applies the rules of the same list of
/// fields. A field cannot be listed without a rule.
class FieldCheck {
public:
    std::string defect; ///< of the first field that breaks a rule, "surfels: out of range"

    template <class T, class... Rules>
    requires(sizeof...(Rules) > 0) void operator()(std::string_view name, const T& field,
                                                   const Rules&... rules) {
        const char* wrong = defect.empty() ? nullptr : "";
        ((wrong = wrong ? wrong : rules(field)), ...);
        if (wrong && defect.empty())
            defect = fmt::format("{}: {}", name, wrong);
    }
    template <class T, class Rule, class F>
    void each(std::string_view name, const std::vector<T>& v, const Rule& rule, const F& fields) {
        (*this)(name, v, rule);
        for (const T& element : v) {
            if (!defect.empty())
                return;
            fields(element);
        }
    }
};

/// Reads and checks the fields that `fields(archive)` lists, calling it with a ByteReader and then
/// with a FieldCheck. Returns false if `bytes` are fewer or more than the fields or a rule is
/// broken; the fields are then unspecified.
template <class Fields>
bool readFields(std::string_view bytes, const Fields& fields) {
    ByteReader reader(bytes);
    fields(reader);
    FieldCheck check;
    if (reader.ok && reader.atEnd())
        fields(check);
    return reader.ok && reader.atEnd() && check.defect.empty();
}

} // namespace limn
