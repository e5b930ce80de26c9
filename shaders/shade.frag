// SPDX-License-Identifier: MIT
// One surface in one of the limn::View without direct light: definitions in engine/scene/view.h.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/surface.glsl"

layout(location = 0) out vec4 outColor;

vec3 shade(Surface s) {
    if (kView == VIEW_ALBEDO)
        return s.albedo;
    if (kView == VIEW_NORMALS)
        return s.detailNormal * 0.5 + 0.5;
    const vec3 E = readIndirect(s, s.detailNormal, 0.0).irradiance; // the lobe is not used
    return kView == VIEW_IRRADIANCE ? E : s.albedo * E / kPi;
}

void main() {
    const Surface s = readSurface(baseColor());
    outColor = vec4(isBlackBack() ? vec3(0) : shade(s), 1);
}
