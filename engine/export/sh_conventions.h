// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace limn {

// Spherical harmonics of incident radiance as other engines expect them. Ours are real,
// orthonormal, without Condon-Shortley sign, coefficient (l, m) at l(l+1)+m, in a right-handed
// world with +Y up. Their polynomials are K_i times 1; y, z, x; xy, yz, 3z^2-1, xz, x^2-y^2.
// three.js uses the same and needs no conversion.

/// The first three bands of radiance [W m^-2 sr^-1], RGB.
using Sh3 = std::array<glm::vec3, 9>;

/// K_i, the constant in front of polynomial i.
extern const std::array<float, 9> kShConstants;

/// E(n) / pi as a sum of polynomials without constants, in our order: e_i = K_i A_l / pi c_i.
/// Filament's IndirectLight::Builder::irradiance(3, sh) takes it: its own basis has the
/// Condon-Shortley sign, which cancels once constants are multiplied in.
Sh3 irradiancePolynomial(const Sh3& c);

/// StandardMaterial.ambientSH of PlayCanvas: irradiancePolynomial() in the order 1, x, y, z, xz,
/// yz, xy, 3z^2-1, x^2-y^2.
Sh3 playcanvasAmbient(const Sh3& c);

/// How a scene's world is related to glTF's. Babylon.js mirrors glTF files into its left-handed
/// world at x = 0; in right-handed worlds its shaders mirror what they look up at z = 0.
enum class BabylonWorld { LeftHanded, RightHanded };

/// SphericalHarmonics of Babylon.js before its convertIncidentRadianceToIrradiance() and
/// convertIrradianceToLambertianRadiance(): with Condon-Shortley sign, mirrored for that world.
Sh3 babylonHarmonics(const Sh3& c, BabylonWorld world);

/// irradianceCoefficients of the glTF extension EXT_lights_image_based, as Babylon.js reads it:
/// babylonHarmonics() times A_l. [W m^-2]
Sh3 imageBasedLight(const Sh3& c, BabylonWorld world);

/// Probe of a LightmapGIData of Godot 4: c / pi.
Sh3 godotProbe(const Sh3& c);

/// Directional lightmap of Godot 4, in packed form: layer 0 holds l0 = K_0 c_0, the mean of E / pi
/// over all normals; layers 1 to 3, for y, z and x, hold 0.5 + 2/3 K_1 c_i / (8 l0), clamped to
/// [0, 1]. 0.5 where l0 is not above 0.
std::array<glm::vec3, 4> godotDirectional(std::span<const glm::vec3, 4> c);

/// The 28 numbers of a cell of three.js' LightProbeGridWebGL: 9 colours one after the other and a
/// 0, in 7 groups of 4.
std::array<glm::vec4, 7> threeGridCell(const Sh3& c);

} // namespace limn
