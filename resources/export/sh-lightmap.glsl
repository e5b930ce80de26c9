// SPDX-License-Identifier: MIT
// Irradiance E(n) [W m^-2] from a lightmap of spherical harmonics that Limn exported, GLSL. Outgoing radiance of a Lambertian surface is
// albedo / pi * E. uv is TEXCOORD_1, v down; n is the unit normal in world space, which may come from a normal map.
// Before it, define LIMN_BANDS as 2 or 3, and LIMN_SH(uv, i) as the RGB of coefficient i, for an array or a 3D texture:
//     #define LIMN_SH(uv, i) texture(lightmap, vec3(uv, float(i))).rgb
//     #define LIMN_SH(uv, i) texture(lightmap, vec3(uv, (float(i) + 0.5) / float(LIMN_BANDS * LIMN_BANDS))).rgb
// Coefficient i = l (l + 1) + m multiplies Y_i, real, orthonormal, without Condon-Shortley sign: E = sum of A_l c_i Y_i(n).
vec3 limnIrradiance(vec2 uv, vec3 n) {
    vec3 e = 0.8862269255 * LIMN_SH(uv, 0) // pi / (2 sqrt(pi))
        + 1.0233267079 * (LIMN_SH(uv, 1) * n.y + LIMN_SH(uv, 2) * n.z + LIMN_SH(uv, 3) * n.x); // 2 pi / 3 sqrt(3 / (4 pi))
#if LIMN_BANDS > 2
    e += 0.8580855308 * (LIMN_SH(uv, 4) * n.x * n.y + LIMN_SH(uv, 5) * n.y * n.z + LIMN_SH(uv, 7) * n.x * n.z) // pi / 4 sqrt(15 / (4 pi))
        + 0.2477079561 * LIMN_SH(uv, 6) * (3.0 * n.z * n.z - 1.0) // pi / 4 sqrt(5 / (16 pi))
        + 0.4290427654 * LIMN_SH(uv, 8) * (n.x * n.x - n.y * n.y); // pi / 4 sqrt(15 / (16 pi))
#endif
    return max(e, vec3(0.0));
}
