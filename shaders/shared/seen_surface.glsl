// SPDX-License-Identifier: MIT
// The surface seen in a pixel, as surface.frag left it. Needs `frame` and surface_pack.glsl.

layout(set = 0, binding = FRAME_SURFACE) uniform usampler2D surfaceImage;
layout(set = 0, binding = FRAME_DEPTH) uniform sampler2D depthImage; // 0: no surface, infinitely far
layout(set = 0, binding = FRAME_RECEIVER) uniform sampler2D receiverImage;

// Where the pixel's ray meets the surface.
vec3 positionAt(vec2 pixel, float depth) {
    const vec2 ndc = 2.0 * pixel * frame.pixelSize - 1.0;
    const vec3 ray = frame.rayCentre + ndc.x * frame.rayRight - ndc.y * frame.rayUp;
    return frame.eye + ray * (frame.depthScale / (depth + frame.depthOffset));
}

PackedSurface seenSurface(float depth) {
    const ivec2 pixel = ivec2(gl_FragCoord.xy);
    PackedSurface s = unpackSurface(texelFetch(surfaceImage, pixel, 0), texelFetch(receiverImage, pixel, 0));
    s.position = positionAt(gl_FragCoord.xy, depth);
    s.toEye = normalize(frame.eye - s.position);
    return s;
}
