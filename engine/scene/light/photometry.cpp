// SPDX-License-Identifier: MIT
#include "engine/scene/light/photometry.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vec2.hpp>

namespace limn {

/// Integral of a spot's profile and cone over all directions [sr], by Simpson's rule.
static double coneSolidAngle(const LightProfile& profile, const Light& spot) {
    constexpr int kSteps = 4096;
    const double inner = std::cos(double(spot.innerAngle)),
                 outer = std::cos(double(spot.outerAngle)), step = double(spot.outerAngle) / kSteps;
    double sum = 0;
    for (int i = 0; i <= kSteps; ++i) {
        const double angle = step * i,
                     edge = std::clamp((std::cos(angle) - outer) / (inner - outer), 0.0, 1.0);
        sum += (i == 0 || i == kSteps ? 1
                : i % 2 == 1          ? 4
                                      : 2) *
               edge * edge * meanShare(profile, angle) * std::sin(angle);
    }
    return 2 * glm::pi<double>() * sum * step / 3;
}

float lumen(const Light& light) {
    constexpr float kPi = glm::pi<float>();
    if (const LightProfile* profile = profileOf(light))
        return light.strength * float(light.kind == LightKind::Point
                                          ? profileSolidAngle(*profile)
                                          : coneSolidAngle(*profile, light));
    switch (light.kind) {
    case LightKind::Directional:
        return 0;
    case LightKind::Point:
        return 4 * kPi * light.strength;
    case LightKind::Spot: {
        const float inner = std::cos(light.innerAngle), outer = std::cos(light.outerAngle);
        return 2 * kPi * light.strength * ((1 - inner) + (inner - outer) / 3);
    }
    case LightKind::Rectangle:
        return kPi * light.strength * light.size.x * light.size.y;
    }
    return 0;
}

float strengthForLumen(const Light& light, float flux) {
    Light one = light;
    one.strength = 1;
    const float perUnit = lumen(one);
    return perUnit > 0 ? flux / perUnit : light.strength;
}

Light withoutProfile(Light light) {
    if (!profileOf(light))
        return light;
    const float flux = lumen(light);
    light.profile = {};
    light.strength = strengthForLumen(light, flux);
    return light;
}

static constexpr std::array kSunUnits = {LightUnit::Lux, LightUnit::Ev100},
                            kLampUnits = {LightUnit::Candela, LightUnit::Lumen};
static constexpr std::array kAreaUnits = {LightUnit::Nit, LightUnit::Lumen, LightUnit::Candela,
                                          LightUnit::Ev100};

std::span<const LightUnit> unitsOf(LightKind kind) {
    if (kind == LightKind::Directional)
        return kSunUnits;
    if (kind == LightKind::Rectangle)
        return kAreaUnits;
    return kLampUnits;
}

std::string_view nameOf(LightUnit unit) {
    constexpr std::array<std::string_view, 5> kNames = {"lux", "cd", "lm", "nits", "EV"};
    return kNames[std::size_t(unit)];
}

static bool sameWord(std::string_view a, std::string_view b) {
    return std::ranges::equal(
        a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

std::optional<LightUnit> unitNamed(std::string_view name) {
    using Named = std::pair<std::string_view, LightUnit>;
    constexpr std::array kNames = {
        Named("lux", LightUnit::Lux),    Named("lx", LightUnit::Lux),
        Named("cd", LightUnit::Candela), Named("candela", LightUnit::Candela),
        Named("lm", LightUnit::Lumen),   Named("lumen", LightUnit::Lumen),
        Named("nits", LightUnit::Nit),   Named("nit", LightUnit::Nit),
        Named("cd/m2", LightUnit::Nit),  Named("ev", LightUnit::Ev100),
        Named("ev100", LightUnit::Ev100)};
    for (const auto& [known, unit] : kNames)
        if (sameWord(known, name))
            return unit;
    return std::nullopt;
}

/// Strength at an exposure value of 0.
static float strengthAtZero(const Light& light) {
    return light.kind == LightKind::Directional ? 2.5f : 0.125f;
}

float strengthIn(LightUnit unit, const Light& light) {
    switch (unit) {
    case LightUnit::Lumen:
        return lumen(light);
    case LightUnit::Candela:
        return light.kind == LightKind::Rectangle ? light.strength * light.size.x * light.size.y
                                                  : light.strength;
    case LightUnit::Ev100:
        return std::log2(light.strength / strengthAtZero(light));
    case LightUnit::Lux:
    case LightUnit::Nit:
        break;
    }
    return light.strength;
}

Result<float> strengthFrom(float value, LightUnit unit, const Light& light) {
    const std::span<const LightUnit> units = unitsOf(light.kind);
    if (std::ranges::find(units, unit) == units.end()) {
        std::vector<std::string_view> names;
        for (const LightUnit known : units)
            names.push_back(nameOf(known));
        return fail(fmt::format("{}: not a unit of this kind of light, which has {}", nameOf(unit),
                                fmt::join(names, ", ")));
    }
    if (value < 0 && unit != LightUnit::Ev100)
        return fail(fmt::format("{} {}: may not be negative", value, nameOf(unit)));
    float strength = value;
    if (unit == LightUnit::Lumen)
        strength = strengthForLumen(light, value);
    else if (unit == LightUnit::Ev100)
        strength = strengthAtZero(light) * std::exp2(value);
    else if (unit == LightUnit::Candela && light.kind == LightKind::Rectangle)
        strength = value / (light.size.x * light.size.y);
    if (!(strength <= kMaxLight))
        return fail(fmt::format("{} {}: may not be more than {:g} {}", value, nameOf(unit),
                                kMaxLight, nameOf(units[0])));
    return strength;
}

Result<void> applyTyped(std::string_view text, Light& light) {
    constexpr std::string_view kBlank = " \t,";
    Light changed = light;
    const auto skip = [&] {
        text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
    };
    skip();
    if (text.empty())
        return fail("nothing typed; expected a number and its unit, as in 800 lm or 2700 K");
    for (; !text.empty(); skip()) {
        float value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || !std::isfinite(value))
            return fail(fmt::format("'{}': not a number", text));
        text.remove_prefix(std::size_t(end - text.data()));
        skip();
        const auto isUnit = [](char c) {
            return std::isalnum(static_cast<unsigned char>(c)) || c == '/';
        };
        const bool named = !text.empty() && std::isalpha(static_cast<unsigned char>(text.front()));
        const auto length =
            named ? std::size_t(std::ranges::find_if_not(text, isUnit) - text.begin()) : 0;
        const std::string_view word = text.substr(0, length);
        text.remove_prefix(length);
        if (sameWord(word, "k") || sameWord(word, "kelvin")) {
            if (value < kMinKelvin || value > kMaxKelvin)
                return fail(fmt::format("{} K: not {} to {} K", value, kMinKelvin, kMaxKelvin));
            changed.color = blackbodyColor(value);
            continue;
        }
        const std::optional<LightUnit> unit =
            word.empty() ? unitsOf(light.kind)[0] : unitNamed(word);
        if (!unit)
            return fail(fmt::format("'{}': no unit of light", word));
        const Result<float> strength = strengthFrom(value, *unit, changed);
        if (!strength)
            return tl::make_unexpected(strength.error());
        changed.strength = *strength;
    }
    light = changed;
    return {};
}

/// Planckian locus in CIE 1931 xy, cubic fits of Kim et al.
static glm::vec2 planckianXy(float kelvin) {
    const double t = 1e3 / double(kelvin);
    const double x = kelvin <= 4000
                         ? -0.2661239 * t * t * t - 0.2343589 * t * t + 0.8776956 * t + 0.179910
                         : -3.0258469 * t * t * t + 2.1070379 * t * t + 0.2226347 * t + 0.240390;
    double y = 0;
    if (kelvin <= 2222)
        y = -1.1063814 * x * x * x - 1.34811020 * x * x + 2.18555832 * x - 0.20219683;
    else if (kelvin <= 4000)
        y = -0.9549476 * x * x * x - 1.37418593 * x * x + 2.09137015 * x - 0.16748867;
    else
        y = 3.0817580 * x * x * x - 5.87338670 * x * x + 3.75112997 * x - 0.37001483;
    return {float(x), float(y)};
}

glm::vec3 blackbodyColor(float kelvin) {
    const glm::vec2 xy = planckianXy(std::clamp(kelvin, kMinKelvin, kMaxKelvin));
    const float X = xy.x / xy.y, Z = (1 - xy.x - xy.y) / xy.y;
    glm::vec3 rgb(3.2404542f * X - 1.5371385f - 0.4985314f * Z,
                  -0.9692660f * X + 1.8760108f + 0.0415560f * Z,
                  0.0556434f * X - 0.2040259f + 1.0572252f * Z);
    rgb = glm::max(rgb, glm::vec3(0));
    return rgb / std::max({rgb.x, rgb.y, rgb.z});
}

float nearestKelvin(glm::vec3 color) {
    const float largest = std::max({color.x, color.y, color.z});
    if (!(largest > 0))
        return 6500;
    const glm::vec3 wanted = color / largest;
    const auto distance = [&](float mired) {
        return glm::length(blackbodyColor(1e6f / mired) - wanted);
    };
    // Even steps in mired (1e6 / K) are about even to the eye.
    float best = 1e6f / 6500, bestDistance = distance(best);
    for (float mired = 1e6f / kMaxKelvin; mired <= 1e6f / kMinKelvin; mired += 1)
        if (const float d = distance(mired); d < bestDistance)
            best = mired, bestDistance = d;
    return 1e6f / best;
}

} // namespace limn
