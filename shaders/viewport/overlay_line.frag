// SPDX-License-Identifier: MIT
// Draws the edges of triangles over the faded picture.
#version 460

layout(location = 0) in vec3 fragPosition;   // not used; overlay_surface.vert writes it
layout(location = 1) in vec2 fragLightmapUv; // not used either

layout(location = 0) out vec4 outColor;

void main() {
    outColor = vec4(0.55, 0.8, 1.0, 1);
}
