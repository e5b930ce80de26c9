// SPDX-License-Identifier: MIT
// How a surface scatters a photon, as scatter() of engine/techniques/photon_lattices/photon_surface.cpp, and what that calls:
// sampleSpecular(), sampleFacet(), splitAtBoundary(). Needs sampler.glsl, fresnel.glsl, gpu_photons.h and kPi.
// Heitz. Sampling the GGX Distribution of Visible Normals. 2018
// Walter et al. Microfacet Models for Refraction through Rough Surfaces. 2007

const float kSmoothRoughness = 0.05, kNarrowRoughness = 0.5, kMinAlpha = 2e-3, kMinNoV = 1e-4;

/// A surface point that a photon meets. Normals face the side that it comes from.
struct PhotonSurface {
    vec3 geometricNormal, normal;
    vec3 diffuse, metal, tint; // shares; of metal: base colour
    float metallic, roughness, transmitted, ior;
    bool isThin, inside;
};

/// A direction in which a photon may go on, and the share of its power that it keeps.
struct Way {
    vec3 direction, share;
    uint event; // PHOTON_*
};

// Duff et al. Building an Orthonormal Basis, Revisited. 2017
mat3 basisAround(vec3 n) {
    const float s = n.z < 0.0 ? -1.0 : 1.0;
    const float a = -1.0 / (s + n.z), b = n.x * n.y * a;
    return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

float alphaOf(float roughness) {
    return max(roughness * roughness, kMinAlpha);
}

vec3 cosineDirection(vec3 n, vec2 u) {
    const float phi = 2.0 * kPi * u.y, sine = sqrt(u.x);
    return basisAround(n) * vec3(sine * cos(phi), sine * sin(phi), sqrt(1.0 - u.x));
}

vec3 localEye(mat3 basis, vec3 toEye) {
    vec3 v = toEye * basis;
    v.z = max(v.z, kMinNoV);
    return normalize(v);
}

vec3 visibleNormal(vec3 v, float alpha, vec2 u) {
    const vec3 stretched = normalize(vec3(alpha * v.xy, v.z));
    const float across = dot(stretched.xy, stretched.xy);
    const vec3 t1 = across > 0.0 ? vec3(-stretched.y, stretched.x, 0.0) / sqrt(across) : vec3(1, 0, 0);
    const vec3 t2 = cross(stretched, t1);
    const float r = sqrt(u.x), phi = 2.0 * kPi * u.y;
    const float x = r * cos(phi), s = 0.5 * (1.0 + stretched.z);
    const float y = (1.0 - s) * sqrt(max(1.0 - x * x, 0.0)) + s * r * sin(phi);
    const vec3 n = x * t1 + y * t2 + sqrt(max(1.0 - x * x - y * y, 0.0)) * stretched;
    return normalize(vec3(alpha * n.xy, max(n.z, 0.0)));
}

/// Hammon's visibility times 2 NoL and Smith's masking, as shareOfFacet() of engine/scene/surface/specular.cpp.
float shareOfFacet(float alpha, float NoV, float NoL) {
    const float a2 = alpha * alpha;
    const float visibility = 0.5 / mix(2.0 * NoL * NoV, NoL + NoV, alpha);
    return 2.0 * NoL * visibility * (NoV + sqrt(a2 + (1.0 - a2) * NoV * NoV));
}

float facetShare(float roughness, float NoV, float NoL) {
    return NoL > 0.0 ? min(shareOfFacet(alphaOf(roughness), max(NoV, kMinNoV), NoL), 1.0) : 0.0;
}

vec3 schlickFresnel(vec3 F0, float cosine) {
    return F0 + (1.0 - F0) * pow(1.0 - cosine, 5.0);
}

Way metalWay(PhotonSurface s, vec3 n, vec3 direction, vec2 u) {
    Way way = Way(vec3(0), vec3(0), PHOTON_SPECULAR | (s.roughness <= kNarrowRoughness ? PHOTON_NARROW : 0u));
    if (s.roughness < kSmoothRoughness) {
        way.direction = reflect(direction, n);
        way.share = s.metallic * schlickFresnel(s.metal, clamp(-dot(direction, n), 0.0, 1.0));
        return way;
    }
    const mat3 basis = basisAround(n);
    const float alpha = alphaOf(s.roughness);
    const vec3 v = localEye(basis, -direction), h = visibleNormal(v, alpha, u);
    const float VoH = clamp(dot(v, h), 0.0, 1.0);
    const vec3 l = 2.0 * VoH * h - v;
    if (l.z > 0.0) {
        way.direction = basis * normalize(l);
        way.share = s.metallic * min(schlickFresnel(s.metal, VoH) * shareOfFacet(alpha, v.z, l.z), 1.0);
    }
    return way;
}

vec3 refractedDirection(vec3 n, vec3 toLight, float eta) {
    const float incident = clamp(dot(n, toLight), 0.0, 1.0);
    const float sine2 = max(1.0 - incident * incident, 0.0) / eta / eta;
    if (!(sine2 < 1.0))
        return vec3(0);
    return normalize((incident / eta - sqrt(1.0 - sine2)) * n - toLight / eta);
}

void glassWays(PhotonSurface s, vec3 n, vec3 toLight, vec2 u, inout Way mirrored, inout Way refracted) {
    const bool isSmooth = s.roughness < kSmoothRoughness;
    vec3 facet = n;
    if (!isSmooth) {
        const mat3 basis = basisAround(n);
        facet = basis * visibleNormal(localEye(basis, toLight), alphaOf(s.roughness), u);
    }
    const float cosine = dot(facet, toLight);
    const float eta = s.inside && !s.isThin ? 1.0 / s.ior : s.ior;
    const float reflectance = fresnelDielectric(cosine, eta);
    mirrored.direction = normalize(2.0 * cosine * facet - toLight);
    refracted.direction = s.isThin ? mirrored.direction - 2.0 * dot(mirrored.direction, n) * n
                                   : refractedDirection(facet, toLight, eta);
    vec2 unmasked = vec2(dot(mirrored.direction, n) > 0.0, dot(refracted.direction, n) < 0.0);
    if (!isSmooth)
        unmasked *= vec2(facetShare(s.roughness, dot(n, toLight), dot(n, mirrored.direction)),
                         facetShare(s.roughness, dot(n, toLight), -dot(n, refracted.direction)));
    mirrored.share = vec3(s.transmitted * reflectance * unmasked.x);
    refracted.share = s.tint * ((1.0 - reflectance) * unmasked.y);
}

float sumOf(vec3 power) {
    return power.r + power.g + power.b;
}

/// Returns the way on, with the photon's power in place of its share; event 0: absorbed.
Way scatter(PhotonSurface s, vec3 direction, vec3 power, uint index, uint dimension) {
    const vec2 u = samplerPair(0u, index, dimension + 1u);
    const vec3 n = dot(s.normal, direction) < 0.0 ? s.normal : s.geometricNormal;
    Way ways[4];
    const Way none = Way(vec3(0), vec3(0), 0u);
    ways[0] = Way(cosineDirection(s.geometricNormal, u), s.diffuse, PHOTON_DIFFUSE);
    ways[1] = s.metallic > 0.0 ? metalWay(s, n, direction, u) : none;
    ways[2] = Way(vec3(0), vec3(0), PHOTON_SPECULAR | PHOTON_NARROW);
    ways[3] = Way(vec3(0), vec3(0), PHOTON_TRANSMITTED | PHOTON_NARROW);
    if (s.tint != vec3(0))
        glassWays(s, n, -direction, u, ways[2], ways[3]);
    float share[4], all = 0.0;
    for (int i = 0; i < 4; ++i) {
        const float side = i == 3 ? -1.0 : 1.0;
        if (i > 0 && !(side * dot(ways[i].direction, s.geometricNormal) > 0.0))
            ways[i].share = vec3(0);
        share[i] = sumOf(power * ways[i].share) / sumOf(power);
        all += share[i];
    }
    float rest = samplerPair(0u, index, dimension).x * max(all, 1.0);
    for (int i = 0; i < 4; ++i) {
        if (rest < share[i]) {
            ways[i].share = power * ways[i].share / share[i];
            return ways[i];
        }
        rest -= share[i];
    }
    return none;
}
