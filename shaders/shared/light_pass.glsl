// SPDX-License-Identifier: MIT
// What a fragment shader of limn::LightPipelines needs: the surface seen in its pixel, and how light becomes the
// picture's. It binds its own data to set 1 and further ones. Needs the extension GL_GOOGLE_include_directive.
#include "shaders/shared/gpu_frame.h"
#include "shaders/shared/gpu_material.h"
#include "shaders/shared/specular.glsl"
#include "shaders/shared/surface_pack.glsl"

layout(constant_id = 0) const uint kView = VIEW_LIT;
layout(constant_id = 1) const bool kDiffuse = true; // shows diffuse light, not only what is glossy

layout(set = 0, binding = FRAME_BLOCK) uniform FrameBlock { GpuFrame frame; };

layout(location = 0) out vec4 outColor;

#include "shaders/shared/seen_surface.glsl"

/// False where the pixel shows no surface, or the back of a one-sided one, which is black.
bool litSurface(out PackedSurface s) {
    const float depth = texelFetch(depthImage, ivec2(gl_FragCoord.xy), 0).r;
    s = seenSurface(depth);
    return depth > 0.0 && dot(s.detailNormal, s.geometricNormal) > -0.99; // as surface.frag marks backs
}

/// The surface's instance, an index into limn::Scene::instances. Precondition: it has no lightmap.
uint instanceOf(PackedSurface s) {
    return uint(s.lightmapUv.x);
}

/// Writes bounced light: irradiance, at least 0, and radiance that the surface reflects glossily towards the eye.
void writeLight(PackedSurface s, vec3 irradiance, vec3 glossy) {
    vec3 radiance = kView == VIEW_IRRADIANCE ? irradiance : s.albedo * irradiance / kPi;
    if (!kDiffuse)
        radiance = vec3(0);
    if (kView == VIEW_LIT)
        radiance += glossy;
    outColor = vec4(radiance, 0);
}
