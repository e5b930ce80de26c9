// SPDX-License-Identifier: MIT
// Mixes a picture into the mean of others, with its weight as the alpha of blending.
#version 460

layout(push_constant) uniform Push { float weight; };
layout(set = 0, binding = 0) uniform sampler2D picture;
layout(location = 0) out vec4 outColor;

void main() {
    outColor = vec4(texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb, weight);
}
