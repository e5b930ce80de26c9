// SPDX-License-Identifier: MIT
// Writes into each texel of a 3D image what a linear lookup of another one finds half a texel further along z.
#version 460

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(binding = 0) uniform sampler3D source;
layout(binding = 1, r32f) uniform writeonly image3D target;

void main() {
    const ivec3 size = imageSize(target), texel = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(texel, size)))
        return;
    const vec3 position = (vec3(texel) + vec3(0.5, 0.5, 1.0)) / vec3(size);
    imageStore(target, texel, vec4(textureLod(source, position, 0.0).r));
}
