// SPDX-License-Identifier: MIT
// Irradiance E(n) [W m^-2] from a lightmap of spherical harmonics that Limn exported as an array of 4 or 9 layers, WGSL. Outgoing radiance
// of a Lambertian surface is albedo / pi * E. uv is TEXCOORD_1, v down; n is the unit normal in world space. Coefficient
// i = l (l + 1) + m multiplies Y_i, real, orthonormal, without Condon-Shortley sign: E = sum of A_l c_i Y_i(n).
fn limnIrradiance(lightmap: texture_2d_array<f32>, smooth_: sampler, uv: vec2f, n: vec3f) -> vec3f {
    var e = 0.8862269255 * textureSampleLevel(lightmap, smooth_, uv, 0, 0.0).rgb // pi / (2 sqrt(pi))
        + 1.0233267079 * (textureSampleLevel(lightmap, smooth_, uv, 1, 0.0).rgb * n.y // 2 pi / 3 sqrt(3 / (4 pi))
            + textureSampleLevel(lightmap, smooth_, uv, 2, 0.0).rgb * n.z
            + textureSampleLevel(lightmap, smooth_, uv, 3, 0.0).rgb * n.x);
    if (textureNumLayers(lightmap) > 4) {
        e += 0.8580855308 * (textureSampleLevel(lightmap, smooth_, uv, 4, 0.0).rgb * n.x * n.y // pi / 4 sqrt(15 / (4 pi))
                + textureSampleLevel(lightmap, smooth_, uv, 5, 0.0).rgb * n.y * n.z
                + textureSampleLevel(lightmap, smooth_, uv, 7, 0.0).rgb * n.x * n.z)
            + 0.2477079561 * textureSampleLevel(lightmap, smooth_, uv, 6, 0.0).rgb * (3.0 * n.z * n.z - 1.0) // pi / 4 sqrt(5 / (16 pi))
            + 0.4290427654 * textureSampleLevel(lightmap, smooth_, uv, 8, 0.0).rgb * (n.x * n.x - n.y * n.y); // pi / 4 sqrt(15 / (16 pi))
    }
    return max(e, vec3f(0.0));
}
