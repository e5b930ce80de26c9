// SPDX-License-Identifier: MIT
// Soft shadow of a rectangle from depth cubes seen from the centres of its quarters. Each quarter uses
// percentage-closer soft shadows (Fernando. Percentage-Closer Soft Shadows. 2005). A texel counts as a blocker only if
// the line from the receiver through the surface point that it stores meets the quarter, as in backprojection
// (Guennebaud, Barthe, Paulin. Real-time Soft Shadow Mapping by Backprojection. 2006), so that walls beside a receiver
// do not shadow it. The including shader must declare shadowViews[] and shadowAtlas.

// Number of points per quarter for the blocker search and for the filter.
const int kSearchPoints = 8;
const int kFilterPoints = 8;

// Points are tested at the nearest blocker's distance and at this fraction of it. A wall that is slanted to the light
// is even nearer for some points, and behind it they would look lit.
const float kNearer = 0.65;

// Blockers nearer to the receiver than this many texels belong to its own surface.
const float kBlockerBias = 1.5;

Rectangle quarter(Rectangle r, int k) {
    const vec2 side = vec2(k & 1, k >> 1) - 0.5;
    return Rectangle(r.centre + side.x * r.halfWidth + side.y * r.halfHeight, 0.5 * r.halfWidth,
                     0.5 * r.halfHeight, r.normal);
}

// Fraction of the way from the surface to the plane of rectangle `r` at which something hides a part of `r` from the
// surface, according to the map seen from the centre of `r` (views from `firstView` on) in the direction of `q`; 0 if
// nothing does.
float blockerAt(uint firstView, Rectangle r, PackedSurface s, float height, vec3 q) {
    const vec3 way = q - r.centre;
    const GpuShadowView view = shadowViews[firstView + cubeFace(way)];
    const vec4 atlas = view.toAtlas * vec4(q, 1);
    const vec2 size = vec2(textureSize(shadowAtlas, 0).xy);
    const float stored =
        texelFetch(shadowAtlas, ivec3(atlas.xy / atlas.w * size, int(view.layer)), 0).r;
    const float depth = view.zFar * SHADOW_NEAR / (stored * (1.0 - SHADOW_NEAR) + SHADOW_NEAR);
    const vec3 toBlocker = r.centre + way * (depth / dot(view.axis.xyz, way)) - s.position;
    const float nearer = -dot(toBlocker, r.normal);
    if (dot(toBlocker, s.geometricNormal) <= kBlockerBias * view.texelSize * depth ||
        nearer <= 0.0 || nearer >= height)
        return 0.0;
    const vec2 uv = coordinates(r, s.position + toBlocker * (height / nearer) - r.centre);
    return max(abs(uv.x), abs(uv.y)) <= 1.0 ? nearer / height : 0.0;
}

// Point i on `r` of a sequence that is evenly distributed at any length. Roberts. The Unreasonable Effectiveness of
// Quasirandom Sequences. 2018
vec3 spreadPoint(Rectangle r, float i) {
    return pointOn(r, 2.0 * fract(i * vec2(0.75487767, 0.56984029)) - 1.0);
}

// Smallest fraction of the way at which something blocks; 1 if nothing does. Blockers may be anywhere between surface
// and rectangle, so each point is tested at a different distance, with small steps near the surface.
float nearestBlocker(uint firstView, Rectangle r, PackedSurface s, float height, float noise) {
    float least = 1.0;
    for (int i = -1; i < kSearchPoints; ++i) {
        vec3 q = s.position; // whether the centre sees the surface
        if (i >= 0) {
            const float step = (float((i * 3 + 1) % kSearchPoints) + noise) / float(kSearchPoints);
            const float ratio = exp2(mix(-5.0, 2.0, step)); // distance to the surface : to the light
            q = mix(s.position, spreadPoint(r, float(i) + noise), ratio / (1.0 + ratio));
        }
        const float share = blockerAt(firstView, r, s, height, q);
        least = share > 0.0 ? min(least, share) : least;
    }
    return least;
}

// Sum of the weights of the visible points of `r`, each weighted by the irradiance it sends, and the sum of all
// weights.
vec2 quarterVisibility(uint firstView, Rectangle r, PackedSurface s, float height, float noise) {
    const float share = nearestBlocker(firstView, r, s, height, noise);
    float sum = 0.0, hidden = 0.0;
    for (int i = 0; i < kFilterPoints; ++i) {
        const vec3 way = spreadPoint(r, float(i) + noise) - s.position;
        const float arriving = pointIrradiance(r, way, s.detailNormal);
        sum += arriving;
        hidden += dot(way, s.geometricNormal) > 0.0 ? 0.0 : arriving; // below the triangle's plane
    }
    const int looks = share < 1.0 ? kFilterPoints : 0;
    for (int i = 0; i < looks; ++i) {
        const vec3 onLight = spreadPoint(r, float(i) + noise);
        if (dot(onLight - s.position, s.geometricNormal) > 0.0 &&
            (blockerAt(firstView, r, s, height, mix(s.position, onLight, share)) > 0.0 ||
             blockerAt(firstView, r, s, height, mix(s.position, onLight, kNearer * share)) > 0.0))
            hidden += pointIrradiance(r, onLight - s.position, s.detailNormal);
    }
    return vec2(sum - hidden, sum);
}

// Fraction of the rectangle's light that arrives. `noise` in [0, 1) differs between receivers. Loops replace branches,
// because software rasterisers skip nothing else.
float rectangleVisibility(GpuLight light, Rectangle whole, PackedSurface s, float noise, bool lit) {
    const float height = dot(s.position - whole.centre, whole.normal);
    const int quarters = lit ? 4 : 0;
    vec2 sum = vec2(0);
    for (int k = 0; k < quarters; ++k)
        sum += quarterVisibility(light.firstView + uint(k) * SHADOW_CUBE, quarter(whole, k), s,
                                 height, fract(noise + 0.25 * float(k)));
    return quarters == 0 ? 1.0 : sum.y > 0.0 ? max(sum.x / sum.y, 0.0) : 0.0;
}
