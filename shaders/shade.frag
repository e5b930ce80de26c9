// SPDX-License-Identifier: MIT
// One surface in one of limn::View: definitions in engine/scene/view.h.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_frame.h"
#include "shaders/shared/gpu_light.h"
#include "shaders/shared/gpu_material.h"
#include "shaders/shared/sh_irradiance.glsl"

layout(constant_id = 0) const uint kView = VIEW_LIT;
layout(constant_id = 1) const uint kFeatures = 0;

layout(push_constant) uniform Draw { GpuDraw draw; };

layout(set = 0, binding = 0) uniform FrameBlock { GpuFrame frame; };
layout(set = 0, binding = 1, std430) readonly buffer Lights { GpuLight lights[]; };
layout(set = 0, binding = 2, std430) readonly buffer ShadowViews { GpuShadowView shadowViews[]; };
layout(set = 0, binding = 3) uniform sampler2DArrayShadow shadowAtlas;
layout(set = 0, binding = 4) uniform sampler2DArray lightmap;
layout(set = 0, binding = 5, std430) readonly buffer Grid { vec4 grid[]; };

layout(set = 1, binding = 0) uniform MaterialBlock { GpuMaterial material; };
layout(set = 1, binding = 1) uniform sampler2D textures0;
layout(set = 1, binding = 2) uniform sampler2D textures1;
layout(set = 1, binding = 3) uniform sampler2D textures2;
layout(set = 1, binding = 4) uniform sampler2D textures3;

layout(location = 0) in vec3 fragPosition;
layout(location = 1) in vec3 fragNormal;
layout(location = 2) in vec4 fragTangent;
layout(location = 3) in vec4 fragUv;
layout(location = 4) in vec4 fragColor;
layout(location = 5) in vec2 fragLightmapUv;

layout(location = 0) out vec4 outColor;

bool has(uint feature) {
    return (kFeatures & feature) != 0;
}

vec2 textureUv(int k) {
    const vec3 uv = vec3(material.uvRows[2 * k].w > 0.5 ? fragUv.zw : fragUv.xy, 1);
    return vec2(dot(material.uvRows[2 * k].xyz, uv), dot(material.uvRows[2 * k + 1].xyz, uv));
}

struct Surface {
    vec3 position;
    vec3 geometricNormal; // unit, to the viewer
    vec3 normal;          // unit, of the interpolated vertex normals, on the viewer's side
    vec3 detailNormal;    // the same with the normal map
    vec3 toEye;           // unit
    vec3 baseColor;
    float metallic, roughness;
    vec3 albedo; // diffuse reflectance
};

vec3 mappedNormal(vec3 n, float side) {
    vec3 t = fragTangent.xyz - n * dot(n, fragTangent.xyz);
    const float t2 = dot(t, t);
    if (t2 < 1e-20)
        return n;
    t *= inversesqrt(t2);
    // The map is given in the front's frame: of the vertex normal before it was turned to the viewer.
    const vec3 front = side * n;
    const vec3 b = cross(front, t) * fragTangent.w;
    vec3 m = texture(textures2, textureUv(TEXTURE_NORMAL)).xyz * 2.0 - 1.0;
    m.xy *= material.normalScale;
    const vec3 mapped = side * (t * m.x + b * m.y + front * m.z);
    const float m2 = dot(mapped, mapped);
    return m2 > 1e-20 ? mapped * inversesqrt(m2) : n;
}

Surface readSurface(vec4 base) {
    Surface s;
    s.position = fragPosition;
    s.toEye = normalize(frame.eye - fragPosition);
    const vec3 g = cross(dFdx(fragPosition), dFdy(fragPosition));
    const float g2 = dot(g, g);
    const float side = gl_FrontFacing ? 1.0 : -1.0;
    const float n2 = dot(fragNormal, fragNormal);
    const vec3 n = n2 > 0.0 ? side * fragNormal * inversesqrt(n2) : s.toEye;
    s.geometricNormal = g2 > 0.0 ? g * inversesqrt(g2) : n;
    if (dot(s.geometricNormal, s.toEye) < 0.0)
        s.geometricNormal = -s.geometricNormal;
    s.normal = dot(n, s.geometricNormal) > 0.0 ? n : s.geometricNormal;
    s.detailNormal = s.normal;
    if (has(FEATURE_NORMAL_TEXTURE) && (kView == VIEW_LIT || kView == VIEW_NORMALS))
        s.detailNormal = mappedNormal(s.normal, side);
    s.baseColor = base.rgb;
    s.metallic = material.metallic;
    s.roughness = material.roughness;
    if (has(FEATURE_METALLIC_ROUGHNESS_TEXTURE)) {
        const vec4 t = texture(textures1, textureUv(TEXTURE_METALLIC_ROUGHNESS));
        s.roughness *= t.g;
        s.metallic *= t.b;
    }
    s.albedo = min(s.baseColor * (1.0 - s.metallic), 0.99);
    return s;
}

// Of the light's six views the one that looks from it to the point.
uint cubeFace(vec3 fromLight) {
    const vec3 a = abs(fromLight);
    if (a.x >= a.y && a.x >= a.z)
        return fromLight.x > 0.0 ? 0u : 1u;
    if (a.y >= a.z)
        return fromLight.y > 0.0 ? 2u : 3u;
    return fromLight.z > 0.0 ? 4u : 5u;
}

// 1: the light arrives; 0: it does not. `taps` 0 is free on software rasterisers, where only loops skip work.
float visibility(GpuLight light, Surface s, vec3 toLight, bool lit) {
    const int taps = light.shadowViews != SHADOW_NONE && lit ? 4 : 0;
    float sum = 0.0;
    vec3 uvz = vec3(0);
    float layer = 0.0;
    vec2 texel = 1.0 / vec2(textureSize(shadowAtlas, 0).xy);
    for (int k = 0; k < min(taps, 1); ++k) {
        const uint face = light.shadowViews == SHADOW_CUBE ? cubeFace(-toLight) : 0u;
        const GpuShadowView view = shadowViews[light.firstView + face];
        const float depth = view.perspective > 0.5 ? dot(view.axis.xyz, s.position) - view.axis.w : 1.0;
        const float width = view.texelSize * depth;
        const float cosine = dot(s.geometricNormal, toLight);
        const float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
        const vec3 p = s.position + width * (frame.normalBias * sine * s.geometricNormal +
                                             frame.lightBias * toLight);
        const vec4 q = view.toAtlas * vec4(p, 1);
        uvz = q.xyz / q.w;
        layer = float(view.layer);
    }
    // Four bilinear comparisons half a texel off the centre: a 3 x 3 tent.
    for (int k = 0; k < taps; ++k) {
        const vec2 offset = vec2((k & 1) != 0 ? 0.5 : -0.5, (k & 2) != 0 ? 0.5 : -0.5);
        sum += texture(shadowAtlas, vec4(uvz.xy + offset * texel, layer, uvz.z));
    }
    return taps > 0 ? 0.25 * sum : 1.0;
}

// sampleLight() of engine/scene/light.cpp.
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
    return light.strength * min(window / d2, 1e30);
}

// Cook-Torrance with GGX, without the cosine. Walter et al. Microfacet Models for Refraction through Rough
// Surfaces. 2007; the visibility term is Hammon's approximation of the height-correlated Smith term.
vec3 specularBrdf(Surface s, vec3 n, vec3 toLight, vec3 F0) {
    const vec3 h = normalize(s.toEye + toLight);
    const float NoL = max(dot(n, toLight), 0.0), NoV = max(dot(n, s.toEye), 1e-4);
    const float NoH = clamp(dot(n, h), 0.0, 1.0), VoH = clamp(dot(s.toEye, h), 0.0, 1.0);
    const float alpha = max(s.roughness * s.roughness, 2e-3);
    const float a2 = alpha * alpha;
    const float k = NoH * NoH * (a2 - 1.0) + 1.0;
    const float D = a2 / (kPi * k * k);
    const float V = 0.5 / mix(2.0 * NoL * NoV, NoL + NoV, alpha);
    const vec3 F = F0 + (1.0 - F0) * pow(1.0 - VoH, 5.0);
    return D * V * F;
}

// Directional albedo of the specular lobe. Karis. Physically Based Shading on Mobile. 2014.
vec3 specularAlbedo(vec3 F0, float roughness, float NoV) {
    const vec4 r = roughness * vec4(-1, -0.0275, -0.572, 0.022) + vec4(1, 0.0425, 1.04, -0.04);
    const float a = min(r.x * r.x, exp2(-9.28 * NoV)) * r.x + r.y;
    return max(F0 * (-1.04 * a + r.z) + (1.04 * a + r.w), 0.0);
}

// Adds what all lights send: irradiance, and in VIEW_LIT specular radiance.
void addDirect(Surface s, vec3 F0, inout vec3 E, inout vec3 specular) {
    for (uint i = 0; i < frame.lightCount; ++i) {
        const GpuLight light = lights[i];
        vec3 toLight;
        vec3 irradiance = lightIrradiance(light, s.position, toLight);
        const float NoL = max(dot(s.detailNormal, toLight), 0.0);
        const bool lit = NoL > 0.0 && dot(s.geometricNormal, toLight) > 0.0 &&
                         irradiance.x + irradiance.y + irradiance.z > 0.0;
        irradiance *= lit ? NoL * visibility(light, s, toLight, lit) : 0.0;
        E += irradiance;
        if (kView == VIEW_LIT && lit)
            specular += irradiance * specularBrdf(s, s.detailNormal, toLight, F0);
    }
}

// SH of the light that reaches the surface by bounces. False: there is none.
bool readIndirect(Surface s, out vec3 c[9]) {
    for (int i = 0; i < 9; ++i)
        c[i] = vec3(0);
    if (has(FEATURE_LIGHTMAP)) {
        for (int i = 0; i < 9; ++i)
            c[i] = textureLod(lightmap, vec3(fragLightmapUv, i), 0.0).rgb;
        return true;
    }
    if (!has(FEATURE_GRID))
        return false;
    const ivec3 last = ivec3(frame.gridSize) - 1;
    const vec3 x = clamp((s.position - frame.gridLower) * frame.gridScale - 0.5, vec3(0), vec3(last));
    const ivec3 lower = min(ivec3(x), last);
    const vec3 f = x - vec3(lower);
    for (int k = 0; k < 8; ++k) {
        const ivec3 high = ivec3(k & 1, (k >> 1) & 1, k >> 2);
        const ivec3 cell = min(lower + high, last);
        const vec3 w = mix(1.0 - f, f, vec3(high));
        const uint index =
            (uint(cell.z) * frame.gridSize.y + uint(cell.y)) * frame.gridSize.x + uint(cell.x);
        for (uint i = 0; i < 9; ++i)
            c[i] += w.x * w.y * w.z * grid[i * frame.gridCells + index].rgb;
    }
    return true;
}

vec3 emission() {
    vec3 e = material.emission;
    if (has(FEATURE_EMISSIVE_TEXTURE))
        e *= texture(textures3, textureUv(TEXTURE_EMISSIVE)).rgb;
    return e;
}

vec3 shade(Surface s) {
    if (kView == VIEW_ALBEDO)
        return s.albedo;
    if (kView == VIEW_NORMALS)
        return s.detailNormal * 0.5 + 0.5;
    const vec3 F0 = mix(vec3(0.04), s.baseColor, s.metallic);
    vec3 E = vec3(0), specular = vec3(0);
    if (kView == VIEW_LIT || kView == VIEW_DIRECT)
        addDirect(s, F0, E, specular);
    vec3 c[9];
    if (kView != VIEW_DIRECT && readIndirect(s, c)) {
        E += shIrradiance(c, s.detailNormal);
        if (kView == VIEW_LIT) {
            const float alpha = max(s.roughness * s.roughness, 0.05);
            const float NoV = clamp(dot(s.detailNormal, s.toEye), 0.0, 1.0);
            specular += specularAlbedo(F0, s.roughness, NoV) *
                        shLobe(c, reflect(-s.toEye, s.detailNormal), 2.0 / (alpha * alpha) - 2.0);
        }
    }
    if (kView == VIEW_IRRADIANCE)
        return E;
    const vec3 diffuse = s.albedo * E / kPi;
    return kView == VIEW_LIT ? diffuse + specular + emission() : diffuse;
}

void main() {
    vec4 base = material.baseColor * fragColor;
    if (has(FEATURE_BASE_COLOR_TEXTURE) && (has(FEATURE_ALPHA_MASK) || kView != VIEW_IRRADIANCE))
        base *= texture(textures0, textureUv(TEXTURE_BASE_COLOR));
    if (has(FEATURE_ALPHA_MASK) && base.a < material.alphaCutoff)
        discard;
    const Surface s = readSurface(base);
    const bool blackBack = !gl_FrontFacing && (draw.flags & DRAW_DOUBLE_SIDED) == 0;
    outColor = vec4(blackBack ? vec3(0) : shade(s), 1);
}
