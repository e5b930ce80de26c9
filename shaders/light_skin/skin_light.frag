// SPDX-License-Identifier: MIT
// Lights surfaces by the proxy lights of the caches near them, as SkinPart of engine/techniques/light_skin/skin_part.h
// does. Bischoff, Schwandt, Broll. A Real-Time Global Illumination Approach for High Resolution Reflective Shadow Maps in
// Open World Scenes. 2017, equations 8 and 9.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/light_pass.glsl"
#include "shaders/shared/gpu_skin.h"

layout(constant_id = 2) const bool kGlossy = true; // there are glossy proxies
layout(constant_id = 3) const float kNearestProxy = 0.5; // as that of skin_part.h

layout(set = 0, binding = FRAME_REFLECTIONS) uniform sampler2DArray reflectionTable;
layout(set = 1, binding = SKIN_CACHES, std430) readonly buffer Caches { GpuSkinCache caches[]; };
layout(set = 1, binding = SKIN_LISTS, std430) readonly buffer Lists { GpuSkinList lists[]; };
layout(set = 1, binding = SKIN_CUBES, std430) readonly buffer Cubes { GpuSkinCube cubes[]; };
layout(set = 1, binding = SKIN_PROXIES, std430) readonly buffer Proxies { GpuSkinProxies proxies[]; };
layout(set = 1, binding = SKIN_INSTANCES, std430) readonly buffer Instances { GpuSkinInstance instances[]; };

const uint kNone = 0xffffffffu;

bool isBefore(ivec3 a, ivec3 b) {
    if (a.z != b.z)
        return a.z < b.z;
    return a.y != b.y ? a.y < b.y : a.x < b.x;
}

/// Number of a cube of the instance's mesh; kNone: no surface lies there.
uint findCube(GpuSkinInstance instance, ivec3 cube) {
    uint low = instance.cube, high = instance.cube + instance.cubes;
    while (low < high) {
        const uint middle = (low + high) / 2u;
        if (isBefore(cubes[middle].cube, cube))
            low = middle + 1u;
        else
            high = middle;
    }
    return low < instance.cube + instance.cubes && cubes[low].cube == cube ? low : kNone;
}

/// The cube of a place in object space, or the nearest of those around it.
uint cubeAt(GpuSkinInstance instance, vec3 place) {
    const ivec3 middle = ivec3(floor(place / instance.edge));
    uint found = findCube(instance, middle);
    if (found != kNone)
        return found;
    float nearest = 1e30;
    for (int k = 0; k < 27; ++k) {
        const ivec3 cube = middle + ivec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
        const vec3 lower = vec3(cube) * instance.edge;
        const vec3 d = max(max(lower - place, place - lower - instance.edge), 0.0);
        if (dot(d, d) >= nearest)
            continue;
        const uint other = findCube(instance, cube);
        if (other == kNone)
            continue;
        nearest = dot(d, d);
        found = other;
    }
    return found;
}

/// Number of the list for a surface; kNone: it has none.
uint listOf(GpuSkinInstance instance, PackedSurface s) {
    const vec4 p = vec4(s.position, 1);
    const vec3 place = vec3(dot(instance.toObject[0], p), dot(instance.toObject[1], p), dot(instance.toObject[2], p));
    const vec3 normal = normalize(vec3(dot(instance.normalRow0, s.geometricNormal), dot(instance.normalRow1, s.geometricNormal),
                                       dot(instance.normalRow2, s.geometricNormal)));
    const uint cube = cubeAt(instance, place - normal * (1e-3 * instance.edge));
    if (cube == kNone)
        return kNone;
    const uint first = cubes[cube].lists >> SKIN_LIST_BITS, count = cubes[cube].lists & ((1u << SKIN_LIST_BITS) - 1u);
    uint best = first;
    for (uint i = first + 1u; i < first + count; ++i)
        if (dot(lists[i].normal, normal) > dot(lists[best].normal, normal))
            best = i;
    return best;
}

vec3 mirroredWay(vec3 position, vec3 normal) {
    const vec3 way = position - frame.eye;
    const float l = length(way);
    return l > 0.0 ? reflect(way / l, normal) : normal;
}

/// A point light in place of all proxies near a surface.
struct MeanProxy {
    vec3 place, flux;
    float distance; // of the proxies from their caches
};

MeanProxy over(MeanProxy sums, float weight) {
    return weight > 0.0 ? MeanProxy(sums.place / weight, sums.flux / weight, sums.distance / weight)
                        : MeanProxy(vec3(0), vec3(0), 1.0);
}

/// Weighted means over the list's caches; flux 0 where none of them lights the surface.
void meanProxies(GpuSkinInstance instance, uint list, PackedSurface s, out MeanProxy diffuse, out MeanProxy glossy) {
    const vec3 mirrored = mirroredWay(s.position, s.detailNormal);
    float farthest = 0.0;
    uint count = 0u;
    for (; count < 16u && lists[list].cache[count / 4u][count % 4u] != SKIN_NO_CACHE; ++count) {
        const uint c = instance.cache + lists[list].cache[count / 4u][count % 4u];
        farthest = max(farthest, distance(s.position, caches[c].position));
    }
    if (count < 16u)
        farthest *= 2.0;
    diffuse = MeanProxy(vec3(0), vec3(0), 0.0);
    glossy = MeanProxy(vec3(0), vec3(0), 0.0);
    float sum = 0.0, glossySum = 0.0;
    for (uint i = 0u; i < count; ++i) {
        const uint c = instance.cache + lists[list].cache[i / 4u][i % 4u];
        const GpuSkinCache cache = caches[c];
        const float near = farthest > 0.0 ? 1.0 - distance(s.position, cache.position) / farthest : 1.0;
        const float w = near * sqrt(max(dot(s.detailNormal, cache.normal), 0.0));
        sum += w;
        diffuse.place += w * proxies[c].diffusePlace;
        diffuse.flux += w * proxies[c].diffuseFlux;
        diffuse.distance += w * proxies[c].diffuseDistance;
        if (!kGlossy || kView != VIEW_LIT)
            continue;
        const float g = near * sqrt(max(dot(mirrored, mirroredWay(cache.position, cache.normal)), 0.0));
        glossySum += g;
        glossy.place += g * proxies[c].glossyPlace;
        glossy.flux += g * proxies[c].glossyFlux;
        glossy.distance += g * proxies[c].glossyDistance;
    }
    diffuse = over(diffuse, sum);
    glossy = over(glossy, glossySum);
}

/// Irradiance of a point light, and the way to it.
vec3 irradianceOf(MeanProxy proxy, PackedSurface s, out vec3 direction) {
    const vec3 way = proxy.place - s.position;
    const float l = max(length(way), 1e-12), r = max(l, max(kNearestProxy * proxy.distance, 1e-12));
    direction = way / l;
    return proxy.flux * (max(dot(direction, s.detailNormal), 0.0) / (4.0 * kPi * r * r));
}

/// Exponent of the lobe of a roughness, as glossExponent() of engine/techniques/light_skin/light_caches.cpp.
float glossExponent(float roughness) {
    const float alpha2 = roughness * roughness * roughness * roughness;
    return clamp((2.0 / max(alpha2, 1e-6) - 2.0) / 4.0, 1.0, 500.0);
}

vec3 reflected(MeanProxy proxy, PackedSurface s) {
    vec3 direction;
    const vec3 irradiance = irradianceOf(proxy, s, direction);
    const float exponent = glossExponent(s.roughness);
    const float cosine = clamp(dot(mirroredWay(s.position, s.detailNormal), direction), 0.0, 1.0);
    const float lobe = (exponent + 2.0) / (2.0 * kPi) * pow(cosine, exponent);
    const float NoV = clamp(dot(s.detailNormal, s.toEye), 0.0, 1.0);
    const vec2 share = reflectionLobe(reflectionTable, s.roughness, NoV, 2).share;
    const vec3 F0 = mix(vec3(0.04), s.baseColor, s.metallic);
    return (F0 * share.x + share.y) * irradiance * lobe;
}

void main() {
    PackedSurface s;
    outColor = vec4(0);
    if (!litSurface(s))
        return;
    const GpuSkinInstance instance = instances[instanceOf(s)];
    const uint list = instance.cubes > 0u ? listOf(instance, s) : kNone;
    if (list == kNone)
        return;
    MeanProxy diffuse, glossy;
    meanProxies(instance, list, s, diffuse, glossy);
    vec3 direction;
    const vec3 irradiance = irradianceOf(diffuse, s, direction);
    const vec3 specular = kGlossy && kView == VIEW_LIT ? reflected(glossy, s) : vec3(0);
    writeLight(s, irradiance, specular);
}
