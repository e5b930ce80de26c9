// SPDX-License-Identifier: MIT
// Cones through voxels: engine/techniques/radiance_volumes/shadow_cone.cpp. Needs `voxels`, the words of all levels, and
// kVoxelSide.

const float kConeStart = 2.0, kConeDark = 1.0 / 1024.0;
const int kPublishedSteps = 32;

uint voxelLevels(uint side) {
    return uint(findMSB(side)) + 1u;
}

/// Trilinear opacity of a level, of the mean where `weight` is 0.
float opacityAt(uint side0, uint level, vec3 p, vec3 weight) {
    uint first = 0u;
    for (uint k = 0u; k < level; ++k)
        first += (side0 >> k) * (side0 >> k) * (side0 >> k);
    const int side = int(side0 >> level);
    const vec3 q = p / float(1u << level) - 0.5;
    const vec3 base = floor(q), f = q - base;
    const ivec3 c = ivec3(base);
    const bool directional = weight != vec3(0);
    float sum = 0.0;
    for (int k = 0; k < 8; ++k) {
        const ivec3 high = ivec3(k & 1, k >> 1 & 1, k >> 2), cell = c + high;
        if (any(lessThan(cell, ivec3(0))) || any(greaterThanEqual(cell, ivec3(side))))
            continue;
        const vec3 w = mix(1.0 - f, f, vec3(high));
        const uint word = voxels[first + uint((cell.z * side + cell.y) * side + cell.x)];
        const vec3 along = vec3(word & 255u, word >> 8 & 255u, word >> 16 & 255u);
        const float opacity = level == 0u ? along.x : directional ? dot(weight, along) : float(word >> 24);
        sum += w.x * w.y * w.z * opacity;
    }
    return sum * (1.0 / 255.0);
}

/// isEmptyAbout().
bool isEmptyAbout(uint side, vec3 p, float reach) {
    const ivec3 c = clamp(ivec3(floor(p)), ivec3(0), ivec3(int(side) - 1));
    const vec3 outside = abs(p - (vec3(c) + 0.5));
    const float away = max(outside.x, max(outside.y, outside.z));
    const uint word = voxels[(uint(c.z) * side + uint(c.y)) * side + uint(c.x)];
    return float(word >> 24) - 0.5 - away >= reach;
}

/// Opacity of a sphere of that radius.
float sphereOpacity(uint side, vec3 p, float radius, vec3 weight) {
    const uint levels = voxelLevels(side);
    const float level = clamp(log2(max(radius, 1.0)), 0.0, float(levels - 1u));
    const uint fine = min(uint(level), levels - 1u);
    const float toCoarse = level - float(fine);
    if (isEmptyAbout(side, p, 1.5 * float(1u << (fine + (toCoarse > 0.0 ? 1u : 0u)))))
        return 0.0;
    const float near = opacityAt(side, fine, p, weight);
    return toCoarse > 0.0 ? near + toCoarse * (opacityAt(side, fine + 1u, p, weight) - near) : near;
}

/// coneVisibility().
float coneVisibility(uint side, uint shadows, vec3 from, vec3 to, float sine) {
    const float reach = distance(from, to);
    if (shadows == VOLUME_SHADOWS_NONE || !(reach > kConeStart))
        return 1.0;
    const vec3 direction = (to - from) / reach;
    const bool published = shadows == VOLUME_SHADOWS_PUBLISHED;
    const vec3 weight = published ? vec3(0) : direction * direction;
    float clear = 1.0, d = kConeStart;
    for (int i = 0; published ? i < kPublishedSteps && d < reach : d + d * sine <= reach - kConeStart && clear > kConeDark;
         ++i) {
        const float radius = d * sine;
        clear *= 1.0 - sphereOpacity(side, from + d * direction, radius, weight);
        d += max(1.0, published ? 2.0 * radius / (1.0 - sine) : radius);
    }
    return published || clear > kConeDark ? clear : 0.0;
}
