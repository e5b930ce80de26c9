// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_material.h"

layout(constant_id = 1) const uint kFeatures = 0;

layout(set = 1, binding = 0) uniform MaterialBlock { GpuMaterial material; };
layout(set = 1, binding = 1) uniform sampler2D baseColorTexture;

layout(location = 0) in vec4 fragUv;
layout(location = 1) in float fragAlpha;

void main() {
    float alpha = material.baseColor.a * fragAlpha;
    if ((kFeatures & FEATURE_BASE_COLOR_TEXTURE) != 0) {
        const vec3 uv = vec3(material.uvRows[0].w > 0.5 ? fragUv.zw : fragUv.xy, 1);
        alpha *= textureLod(baseColorTexture, // as in surface.glsl
                            vec2(dot(material.uvRows[0].xyz, uv), dot(material.uvRows[1].xyz, uv)), 0.0).a;
    }
    if (alpha < material.alphaCutoff)
        discard;
}
