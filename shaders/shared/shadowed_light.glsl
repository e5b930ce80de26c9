// SPDX-License-Identifier: MIT
// Light that arrives from a GpuLight. The including shader must declare shadowViews[], shadowAtlas and
// profiles[].
#include "shaders/shared/light_profile.glsl"

// Index of that one of the light's six views that looks from the light to the point.
uint cubeFace(vec3 fromLight) {
    const vec3 a = abs(fromLight);
    if (a.x >= a.y && a.x >= a.z)
        return fromLight.x > 0.0 ? 0u : 1u;
    if (a.y >= a.z)
        return fromLight.y > 0.0 ? 2u : 3u;
    return fromLight.z > 0.0 ? 4u : 5u;
}

// Weight of texel `offset` (from the 2 x 2 texels around the point) in a tent 3 texels wide; `f` is the point's
// position within them.
vec4 tentWeight(vec4 offset, float f) {
    return 0.5 * (max(1.0 - abs(f - 0.5 - offset), 0.0) + max(1.0 - abs(f + 0.5 - offset), 0.0));
}

// Gradient of atlas depth with respect to atlas u and v on the surface's plane. `width` is a texel's width there.
vec2 planeGradient(GpuShadowView view, vec3 n, vec4 q, float width) {
    const vec3 t = width * normalize(cross(n, abs(n.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0)));
    const vec4 qt = q + view.toAtlas * vec4(t, 0), qb = q + view.toAtlas * vec4(cross(n, t), 0);
    const vec3 dt = qt.xyz / qt.w - q.xyz / q.w, db = qb.xyz / qb.w - q.xyz / q.w;
    const float det = dt.x * db.y - dt.y * db.x;
    if (abs(det) < 1e-14)
        return vec2(0);
    return vec2(dt.z * db.y - db.z * dt.y, dt.x * db.z - db.x * dt.z) / det;
}

// The view that resolves `position` best. For a directional light this is the finest cascade that contains it, else the
// map of the whole scene.
GpuShadowView bestView(GpuLight light, vec3 position, vec3 toLight) {
    uint best = light.firstView + (light.shadowViews == SHADOW_CUBE ? cubeFace(-toLight) : 0u);
    for (uint k = 1u; k <= light.cascades; ++k) {
        const uint view = light.firstView + k;
        const vec2 uv = (shadowViews[view].toAtlas * vec4(position, 1)).xy;
        const vec4 inside = shadowViews[view].inside;
        if (all(greaterThan(uv, inside.xy)) && all(lessThan(uv, inside.zw)))
            best = view;
    }
    return shadowViews[best];
}

// A texel that shows something this many texels behind the receiver's plane does not show the receiver, which ends
// before it.
const float kBehindTexels = 4.0;

// Visibility of the light from `position` on a surface of unit normal n: 1 if the light arrives, 0 if it does not. The
// point is moved by `bias` texels along the normal and towards the light. Each texel is compared with the depth of the
// surface's plane at the texel's centre, so that flat surfaces need no bias, however steep. Texels that show only what
// lies far behind the plane are ignored, because the receiver has no part in them; otherwise light would leak in where
// closed geometry ends, for example below the edge of a roof. If all texels are such, the surface is too small for the
// map and counts as lit. A loop replaces a branch, because software rasterisers skip nothing else.
float visibility(GpuLight light, vec3 position, vec3 n, vec3 toLight, vec2 bias, bool lit) {
    float visible = 1.0;
    const int count = lit ? 1 : 0;
    for (int once = 0; once < count; ++once) {
        const GpuShadowView view = bestView(light, position, toLight);
        const float depth =
            view.perspective > 0.5 ? dot(view.axis.xyz, position) - view.axis.w : 1.0;
        const float width = view.texelSize * depth;
        const vec3 p = position + width * (bias.x * n + bias.y * toLight);
        const vec4 q = view.toAtlas * vec4(p, 1);
        const vec3 centre = q.xyz / q.w;
        const vec4 further = q - view.toAtlas * vec4(kBehindTexels * width * toLight, 0);
        const float behind = further.z / further.w - centre.z; // < 0
        const vec2 gradient = planeGradient(view, n, q, width);
        const vec2 size = vec2(textureSize(shadowAtlas, 0).xy);
        const vec2 x = centre.xy * size - 0.5, base = floor(x), f = x - base;
        float sum = 0.0, shown = 0.0; // weights of the texels that see the receiver, and of those that are not ignored
        for (int k = 0; k < 4; ++k) {
            const vec2 corner = vec2((k & 1) * 2 - 1, (k >> 1) * 2 - 1);
            const vec4 stored = textureGather(
                shadowAtlas, vec3((base + corner + 1.0) / size, float(view.layer)));
            const vec4 i = corner.x + vec4(0, 1, 1, 0), j = corner.y + vec4(1, 1, 0, 0);
            const vec4 plane = centre.z + gradient.x * ((base.x + i + 0.5) / size.x - centre.x) +
                               gradient.y * ((base.y + j + 0.5) / size.y - centre.y);
            const vec4 weight = tentWeight(i, f.x) * tentWeight(j, f.y);
            const vec4 tells = weight * vec4(greaterThanEqual(stored, plane + behind));
            sum += dot(vec4(greaterThanEqual(plane, stored)), tells);
            shown += dot(vec4(1), tells);
        }
        visible = shown > 0.0 ? sum / shown : 1.0;
    }
    return visible;
}

// sampleLight() of engine/scene/light/light.cpp.
vec3 lightIrradiance(GpuLight light, vec3 p, out vec3 toLight) {
    toLight = -light.direction;
    if (light.kind == LIGHT_DIRECTIONAL)
        return light.strength;
    const vec3 d = light.position - p;
    const float d2 = dot(d, d);
    if (!(d2 > 0.0)) {
        toLight = vec3(0);
        return vec3(0);
    }
    const float inverse = inversesqrt(d2);
    toLight = d * inverse;
    const float q = d2 * inverse * light.inverseRange;
    float window = clamp(1.0 - q * q * q * q, 0.0, 1.0);
    if (light.kind == LIGHT_SPOT) {
        const float t = clamp((dot(-toLight, light.direction) - light.cosOuter) * light.spotScale,
                              0.0, 1.0);
        window *= t * t;
    }
    window *= profileShare(light, -toLight);
    return min(light.strength * (window / max(d2, 1e-16)), LIGHT_MOST_IRRADIANCE);
}
