// SPDX-License-Identifier: MIT
// Replaces the last kWords words of some links. `changed` holds the number of each link, followed by its new words.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/relight.glsl"

layout(constant_id = 1) const uint kWords = 1;
layout(constant_id = 2) const uint kLinkWords = RELIGHT_CONE_WORDS;

layout(std430, binding = 0) writeonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer Changed { uint changed[]; };

void main() {
    const uint i = itemIndex();
    if (i >= range.end)
        return;
    const uint item = i / kWords * (kWords + 1), word = i % kWords;
    links[(changed[item] + 1) * kLinkWords - kWords + word] = changed[item + 1 + word];
}
