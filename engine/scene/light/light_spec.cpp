// SPDX-License-Identifier: MIT
#include "engine/scene/light/light_spec.h"

#include "engine/scene/light/ies_file.h"
#include "engine/scene/light/photometry.h"
#include "engine/scene/origin.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace limn {

static std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(separator, begin), text.size());
        parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

/// The words between blanks. Quotes keep a word together, as in `ies="hall lamp.ies"`, and do not
/// belong to it.
static std::vector<std::string> splitWords(std::string_view text) {
    std::vector<std::string> words(1);
    bool quoted = false;
    for (const char c : text)
        if (c == '"')
            quoted = !quoted;
        else if (c == ' ' && !quoted)
            words.emplace_back();
        else
            words.back() += c;
    std::erase(words, "");
    return words;
}

template <class Number = float>
static Result<Number> parseNumber(std::string_view word, std::string_view text) {
    Number value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(float(value)))
        return fail(fmt::format("'{}': '{}' is not a number", word, text));
    return value;
}

template <class Number = float>
static Result<glm::vec<3, Number>> parseTriple(std::string_view word, std::string_view text) {
    const std::vector<std::string_view> parts = split(text, ',');
    if (parts.size() != 3)
        return fail(fmt::format("'{}': expected three numbers x,y,z", word));
    glm::vec<3, Number> v;
    for (int i = 0; i < 3; ++i) {
        const Result<Number> number = parseNumber<Number>(word, parts[std::size_t(i)]);
        if (!number)
            return tl::make_unexpected(number.error());
        v[i] = *number;
    }
    return v;
}

static Result<float> parseNonNegative(std::string_view word, std::string_view text) {
    Result<float> number = parseNumber(word, text);
    if (number && *number < 0)
        return fail(fmt::format("'{}': may not be negative", word));
    return number;
}

static tl::unexpected<Error> tooMuchLight(std::string_view word) {
    return fail(fmt::format("'{}': may not be more than {:g}", word, kMaxLight));
}

static Result<glm::vec3> parseColor(std::string_view word, std::string_view text) {
    Result<glm::vec3> color = parseTriple(word, text);
    if (color && (color->x < 0 || color->y < 0 || color->z < 0))
        return fail(fmt::format("'{}': a color may not be negative", word));
    if (color && std::max({color->x, color->y, color->z}) > kMaxLight)
        return tooMuchLight(word);
    return color;
}

static Result<glm::vec2> parseSize(std::string_view word, std::string_view text) {
    const std::vector<std::string_view> parts = split(text, ',');
    if (parts.size() != 2)
        return fail(fmt::format("'{}': expected two numbers w,h", word));
    glm::vec2 size;
    for (int i = 0; i < 2; ++i) {
        const Result<float> number = parseNumber(word, parts[std::size_t(i)]);
        if (!number)
            return tl::make_unexpected(number.error());
        if (*number < kMinLightSize || *number > kMaxLightSize)
            return fail(fmt::format("'{}': an edge is {} to {} m long", word, kMinLightSize,
                                    kMaxLightSize));
        size[i] = *number;
    }
    return size;
}

namespace {

/// A word whose value depends on other words: flux on the cone, for one.
struct StrengthWord {
    std::string_view word;
    LightUnit unit;
    float value = 0;
};

/// What words mean beside their light.
struct WordContext {
    const glm::dvec3& origin;
    bool profiled = false; ///< one of the words names a profile, which others turn
    std::optional<StrengthWord> strength;
};

} // namespace

/// Sets the field named by a word's key, for the kinds of light that support it. A strength is put
/// off to the context.
static Result<void> applyWord(Light& light, std::string_view word, WordContext& context) {
    const std::size_t equals = word.find('=');
    if (equals == std::string_view::npos)
        return fail(fmt::format("'{}': expected key=value", word));
    const std::string_view key = word.substr(0, equals), text = word.substr(equals + 1);
    const bool sun = light.kind == LightKind::Directional, spot = light.kind == LightKind::Spot,
               rect = light.kind == LightKind::Rectangle;
    const auto store = [](auto& field, auto&& parsed) -> Result<void> {
        if (!parsed)
            return tl::make_unexpected(parsed.error());
        field = *parsed;
        return {};
    };
    if (key == "name") {
        light.name = text;
        return {};
    }
    if (key == "color")
        return store(light.color, parseColor(word, text));
    if (key == "kelvin") {
        const Result<float> kelvin = parseNumber(word, text);
        if (kelvin && (*kelvin < kMinKelvin || *kelvin > kMaxKelvin))
            return fail(fmt::format("'{}': not {} to {} K", word, kMinKelvin, kMaxKelvin));
        return store(light.color, kelvin.map(blackbodyColor));
    }
    if (const std::optional<LightUnit> unit = unitNamed(key)) {
        const Result<float> value = parseNumber(word, text);
        if (!value)
            return tl::make_unexpected(value.error());
        context.strength = {word, *unit, *value};
        return {};
    }
    if (key == "ies" && !sun && !rect) {
        const Result<PhotometricFile> file = readIes(std::string(text));
        if (!file)
            return fail(fmt::format("'{}': {}", word, file.error().message));
        light.profile = {std::make_shared<const LightProfile>(file->profile)};
        return {};
    }
    if (key == "pos" && !sun) {
        glm::dvec3 position(0);
        const Result<void> stored = store(position, parseTriple<double>(word, text));
        light.position = toWorld(context.origin, position);
        return stored;
    }
    if (key == "range" && !sun && !rect)
        return store(light.range, parseNonNegative(word, text));
    if (key == "size" && rect)
        return store(light.size, parseSize(word, text));
    if (key == "roll" && (rect || context.profiled)) {
        const Result<void> stored = store(light.roll, parseNumber(word, text));
        light.roll = glm::radians(light.roll);
        return stored;
    }
    if (key == "dir" && (light.kind != LightKind::Point || context.profiled)) {
        const Result<glm::vec3> direction = parseTriple(word, text);
        if (!direction)
            return tl::make_unexpected(direction.error());
        const glm::dvec3 d(*direction); // the square of 1e-30 is no float
        if (!(glm::dot(d, d) > 0))
            return fail(fmt::format("'{}': a direction may not be zero", word));
        light.direction = glm::vec3(glm::normalize(d));
        return {};
    }
    if ((key == "inner" || key == "outer") && spot) {
        const Result<float> degrees = parseNonNegative(word, text);
        if (degrees && *degrees > 90)
            return fail(fmt::format("'{}': at most 90 degrees", word));
        Result<void> stored = store(key == "inner" ? light.innerAngle : light.outerAngle, degrees);
        if (stored)
            (key == "inner" ? light.innerAngle : light.outerAngle) = glm::radians(*degrees);
        return stored;
    }
    return fail(fmt::format("'{}': unknown for this kind of light", word));
}

Result<Light> parseLight(std::string_view spec, const glm::dvec3& origin) {
    Light light;
    const std::vector<std::string> words = splitWords(spec);
    WordContext context{origin, std::ranges::any_of(words, [](const std::string& word) {
                            return word.starts_with("ies=");
                        })};
    bool first = true;
    for (const std::string& word : words) {
        if (first) {
            if (word == "sun")
                light.kind = LightKind::Directional, light.name = "Sun";
            else if (word == "point")
                light.kind = LightKind::Point, light.name = "Point";
            else if (word == "spot")
                light.kind = LightKind::Spot, light.name = "Spot";
            else if (word == "rect")
                light.kind = LightKind::Rectangle, light.name = "Rectangle";
            else
                return fail(
                    fmt::format("light '{}': '{}' is not sun, point, spot or rect", spec, word));
            if (light.kind != LightKind::Directional)
                light.position = toWorld(origin, light.position);
            first = false;
            continue;
        }
        if (const Result<void> applied = applyWord(light, word, context); !applied)
            return fail(fmt::format("light '{}': {}", spec, applied.error().message));
    }
    if (first)
        return fail("light: empty; expected sun, point, spot or rect");
    if (light.kind == LightKind::Spot && !(light.innerAngle < light.outerAngle))
        return fail(fmt::format("light '{}': inner must be less than outer", spec));
    if (light.profile)
        light.strength = light.profile->peak;
    if (const auto& strength = context.strength) {
        const Result<float> converted = strengthFrom(strength->value, strength->unit, light);
        if (!converted)
            return fail(fmt::format("light '{}': '{}': {}", spec, strength->word,
                                    converted.error().message));
        light.strength = *converted;
    }
    return light;
}

static Result<void> applySkyWord(Sky& sky, std::string_view word) {
    const std::size_t equals = word.find('=');
    const std::string_view key = word.substr(0, equals);
    glm::vec3* field = key == "up"        ? &sky.radiance
                       : key == "horizon" ? &sky.horizon
                       : key == "ground"  ? &sky.ground
                                          : nullptr;
    if (equals == std::string_view::npos || !field)
        return fail(fmt::format("'{}': expected up=, horizon= or ground=", word));
    const Result<glm::vec3> color = parseColor(word, word.substr(equals + 1));
    if (!color)
        return tl::make_unexpected(color.error());
    *field = *color;
    return {};
}

Result<Sky> parseSky(std::string_view spec) {
    Sky sky;
    const std::vector<std::string_view> words = split(spec, ' ');
    if (words[0] != "gradient") {
        const Result<glm::vec3> radiance = parseColor(spec, spec);
        if (!radiance)
            return fail(fmt::format("sky {}", radiance.error().message));
        sky.radiance = *radiance;
        return sky;
    }
    sky.kind = SkyKind::Gradient;
    for (std::size_t i = 1; i < words.size(); ++i)
        if (!words[i].empty())
            if (const Result<void> applied = applySkyWord(sky, words[i]); !applied)
                return fail(fmt::format("sky '{}': {}", spec, applied.error().message));
    return sky;
}

} // namespace limn
