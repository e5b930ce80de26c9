// SPDX-License-Identifier: MIT
// Adds the light of photons in three lattices and of splats, as PhotonLatticePart and PhotonSplatPart of
// engine/techniques/photon_lattices do.
// Norén, Sjölin. Image Space Light Lattice Photon Mapping with Spherical Harmonics. 2010
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_photons.h"
#include "shaders/shared/light_pass.glsl"

layout(set = 0, binding = FRAME_REFLECTIONS) uniform sampler2DArray reflectionTable;
layout(set = 1, binding = PHOTON_LATTICES, std140) uniform Photons { GpuPhotons photons; };
layout(set = 1, binding = PHOTON_ENTRIES, std430) readonly buffer Entries { uint entries[]; };
layout(set = 1, binding = PHOTON_CELLS, std430) readonly buffer Cells { GpuPhotonCell cells[]; };
layout(set = 1, binding = PHOTON_SPLATS, std430) readonly buffer Splats { GpuSplat splats[]; };
layout(set = 1, binding = PHOTON_SPLAT_BUCKETS, std430) readonly buffer Buckets { uint buckets[]; };

const float kMean = 0.28209479, kSlope = 0.48860251; // factors of the first two bands of harmonics

/// Adds a cell's light and area towards a normal with harmonics y.
void addCell(GpuPhotonLattice lattice, uvec3 place, float weight, vec4 y, inout vec4 sum) {
    const uint entry = entries[lattice.first + (place.z * lattice.size.y + place.y) * lattice.size.x + place.x];
    if (entry == PHOTON_NO_ENTRY)
        return;
    for (int i = 0; i < 4; ++i)
        sum += weight * y[i] * cells[entry].value[i];
}

vec3 latticeIrradiance(GpuPhotonLattice lattice, PackedSurface s, vec4 y) {
    const vec3 lifted = s.position + s.geometricNormal * (photons.lift * lattice.cell);
    const vec3 at = (lifted - lattice.lower) / lattice.cell;
    vec4 sum = vec4(0);
    if (photons.trilinear == 0u) {
        addCell(lattice, uvec3(clamp(at, vec3(0), vec3(lattice.size) - 0.5)), 1.0, y, sum);
    } else {
        const vec3 last = vec3(lattice.size) - 1.0;
        const vec3 x = clamp(at - 0.5, vec3(0), last);
        const uvec3 lower = uvec3(min(floor(x), max(last - 1.0, 0.0)));
        const vec3 t = x - vec3(lower);
        for (uint k = 0u; k < 8u; ++k) {
            const uvec3 high = uvec3(k & 1u, (k >> 1) & 1u, k >> 2);
            const vec3 w = mix(1.0 - t, t, vec3(high));
            addCell(lattice, min(lower + high, lattice.size - 1u), w.x * w.y * w.z, y, sum);
        }
    }
    return sum.rgb * (photons.factor / max(sum.a, photons.minArea * lattice.cell * lattice.cell));
}

vec3 splatIrradiance(PackedSurface s) {
    const float r2 = photons.splatRadius * photons.splatRadius;
    const ivec3 middle = ivec3(floor(s.position / photons.splatRadius));
    vec3 sum = vec3(0);
    for (int k = 0; k < 27; ++k) {
        const ivec3 cell = middle + ivec3(k % 3, k / 3 % 3, k / 9) - 1;
        const uint bucket = photonBucket(cell.x, cell.y, cell.z, photons.bucketMask);
        for (uint i = buckets[bucket]; i < buckets[bucket + 1u]; ++i) {
            const GpuSplat splat = splats[i];
            const vec3 way = splat.position - s.position;
            // Cells that share a bucket must not add its splats twice.
            if (ivec3(floor(splat.position / photons.splatRadius)) == cell && dot(way, way) <= r2 &&
                dot(splat.normal, s.geometricNormal) >= photons.minCosine)
                sum += splat.power;
        }
    }
    return sum / (kPi * r2);
}

void main() {
    outColor = vec4(0);
    PackedSurface s;
    if (!litSurface(s))
        return;
    const vec4 y = vec4(kMean, kSlope * s.detailNormal.yzx);
    vec3 irradiance = vec3(0);
    for (int k = 0; k < PHOTON_LATTICE_COUNT; ++k)
        irradiance += latticeIrradiance(photons.lattice[k], s, y);
    if (photons.splats > 0u)
        irradiance += splatIrradiance(s);
    irradiance = max(irradiance, 0.0);
    // Light counts as equal from all directions.
    const float NoV = clamp(dot(s.detailNormal, s.toEye), 0.0, 1.0);
    const vec2 share = reflectionLobe(reflectionTable, s.roughness, NoV, 2).share;
    writeLight(s, irradiance, (s.F0 * share.x + share.y) * irradiance / kPi);
}
