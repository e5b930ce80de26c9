// SPDX-License-Identifier: MIT
// Measures what each virtual light means to the view, as importances() of engine/techniques/light_skin/importance.cpp.
// Ritschel, Eisemann, Ha, Kim, Seidel. Making Imperfect Shadow Maps View-Adaptive. 2011
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/compute_groups.glsl"
#include "shaders/shared/gpu_skin_steps.h"
#include "shaders/shared/surface_pack.glsl"

layout(push_constant) uniform Push { GpuSkinStep step; };
layout(std430, binding = SKIN_STEP_TEXELS) readonly buffer Texels { GpuVirtualLight texels[]; };
layout(std430, binding = SKIN_STEP_IMPORTANCE) writeonly buffer Importance { float importance[]; };
layout(std430, binding = SKIN_STEP_SAMPLES) readonly buffer Samples { GpuViewSample samples[]; };

void main() {
    const uint i = groupIndex() * kLanes + gl_LocalInvocationID.x;
    if (i >= step.columns * step.rows)
        return;
    const GpuVirtualLight light = texels[i];
    const vec3 normal = octDecode(unpackSnorm2x16(light.normal));
    const float bound = step.nearest * step.nearest;
    float sum = 0.0;
    for (uint k = 0u; k < step.samples; ++k) {
        const GpuViewSample s = samples[k];
        const vec3 l = s.position - light.position;
        const float l2 = dot(l, l);
        sum += s.found * max(dot(normal, l), 0.0) * max(-dot(s.normal, l), 0.0) / (max(l2, 1e-30) * max(l2, bound));
    }
    importance[i] = light.area > 0.0 ? sum * dot(light.flux, vec3(0.2126, 0.7152, 0.0722)) : 0.0;
}
