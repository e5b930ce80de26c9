// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/light/light.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace limn {

/// Luminous flux [lm] of a point or spot light of strength [cd], or a rectangle of [nits]. Point: 4
/// pi I. Spot, with glTF's squared edge: 2 pi I ((1 - cos inner) + (cos inner - cos outer) / 3).
/// With a profile: the integral of both. Rectangle: pi L A. Directional: 0, it has none.
float lumen(const Light& light);

/// Strength [cd, nits] that gives `flux` [lm]; the light's own strength when it has no flux.
float strengthForLumen(const Light& light, float flux);

/// The light with its flux spread evenly over its sphere or cone, for what knows no profiles.
Light withoutProfile(Light light);

/// A unit in which people state how bright a light is.
enum class LightUnit : std::uint8_t { Lux, Candela, Lumen, Nit, Ev100 };

/// The units that lights of a kind are stated in; the first is that of Light::strength.
std::span<const LightUnit> unitsOf(LightKind kind);

/// "lux", "cd", "lm", "nits" or "EV".
std::string_view nameOf(LightUnit unit);

/// The unit with a name, in any case: those of nameOf(), "lx", "candela", "lumen", "nit", "cd/m2",
/// "EV100".
std::optional<LightUnit> unitNamed(std::string_view name);

/// Strength of the light in one of unitsOf(its kind). EV100 is the exposure value at ISO 100 of a
/// meter that faces the light: L = 2^EV / 8 nits for a reflected-light meter (K = 12.5) that sees a
/// rectangle, E = 2.5 * 2^EV lux for an incident-light one (C = 250) in a sun.
/// ISO 2720. Photographic exposure meters. 1974
float strengthIn(LightUnit unit, const Light& light);

/// The strength that a light of this kind and shape has if it is `value` of a unit. Fails for units
/// that are not unitsOf(its kind), naming those that are, for values below 0 other than EV, and for
/// strengths above kMaxLight.
Result<float> strengthFrom(float value, LightUnit unit, const Light& light);

/// Applies what someone types for a light, with its unit: "800 lm", "12.5cd", "13 EV", "2700 K",
/// which sets the colour; a number alone is a strength. Several, as "800 lm 2700 K", are applied
/// one after the other. Fails, and changes nothing, for what it does not understand.
Result<void> applyTyped(std::string_view text, Light& light);

/// The temperatures that blackbodyColor() knows [K].
inline constexpr float kMinKelvin = 1667, kMaxKelvin = 25000;

/// Linear Rec. 709 colour of a black body, with a largest component of 1 and none below 0.
/// Temperatures are clamped to [1667, 25000] K. Kim, Kang, Hong, Hwang. Design of advanced color
/// temperature control system for HDTV applications. 2002
glm::vec3 blackbodyColor(float kelvin);

/// Temperature [K] whose chromaticity is nearest to `color`; 6500 for black.
float nearestKelvin(glm::vec3 color);

} // namespace limn
