// SPDX-License-Identifier: MIT
// Rectangle lights: their irradiance and the position of their highlight. engine/scene/light/rectangle_light.h has the
// same in double precision.

struct Rectangle {
    vec3 centre, halfWidth, halfHeight, normal; // half edges [m]; it shines to the side of the unit normal
};

Rectangle rectangleOf(GpuLight light) {
    return Rectangle(light.position, light.halfWidth,
                     normalize(cross(light.halfWidth, light.direction)) * light.halfHeight,
                     light.direction);
}

// uv in [-1, 1]^2.
vec3 pointOn(Rectangle r, vec2 uv) {
    return r.centre + uv.x * r.halfWidth + uv.y * r.halfHeight;
}

// Coordinates of a point of the rectangle's plane, relative to its centre; [-1, 1]^2 within.
vec2 coordinates(Rectangle r, vec3 fromCentre) {
    return vec2(dot(fromCentre, r.halfWidth) / dot(r.halfWidth, r.halfWidth),
                dot(fromCentre, r.halfHeight) / dot(r.halfHeight, r.halfHeight));
}

float edgeIntegral(vec3 a, vec3 b, vec3 n) {
    const vec3 across = cross(a, b);
    const float size = length(across);
    return size > 0.0 ? atan(size, dot(a, b)) * dot(across, n) / size : 0.0;
}

// Irradiance per unit of the rectangle's area and unit of radiance.
float pointIrradiance(Rectangle r, vec3 way, vec3 n) {
    const float d2 = dot(way, way);
    return max(dot(way, n), 0.0) * max(-dot(way, r.normal), 0.0) / (d2 * d2);
}

// At this many times its size and beyond, a rectangle counts as a point: there the error of either formula is 1e-4.
const float kFarRectangle = 100.0;

// Irradiance per unit of radiance, without shadow. Lambert. Photometria. 1760; Baum, Rushmeier, Winget. Improving
// Radiosity Solutions Through the Use of Analytically Determined Form-Factors. 1989
float rectangleIrradiance(Rectangle r, vec3 p, vec3 n) {
    const vec3 c = r.centre - p;
    if (!(dot(c, r.normal) < 0.0))
        return 0.0;
    const float width = length(r.halfWidth), height = length(r.halfHeight);
    if (length(c) > kFarRectangle * (width + height))
        return min(4.0 * width * height * pointIrradiance(r, c, n), kPi);
    const vec3 corner[4] = vec3[4](c - r.halfWidth - r.halfHeight, c + r.halfWidth - r.halfHeight,
                                   c + r.halfWidth + r.halfHeight, c - r.halfWidth + r.halfHeight);
    float sum = 0.0;
    vec3 enter = vec3(0), leave = vec3(0); // where its outline crosses the horizon
    for (int i = 0; i < 4; ++i) {
        vec3 a = corner[i], b = corner[(i + 1) & 3];
        const float ha = dot(a, n), hb = dot(b, n);
        if (ha < 0.0 && hb < 0.0)
            continue;
        const vec3 cut = a + (b - a) * (ha / (ha - hb));
        if (ha < 0.0)
            enter = a = cut;
        if (hb < 0.0)
            leave = b = cut;
        sum += edgeIntegral(a, b, n);
    }
    return clamp(0.5 * abs(sum + edgeIntegral(leave, enter, n)), 0.0, kPi);
}

// The point of the rectangle nearest to where the mirrored ray meets its plane.
// Karis. Real Shading in Unreal Engine 4. 2013
vec3 representativePoint(Rectangle r, vec3 p, vec3 mirrored) {
    const float height = dot(p - r.centre, r.normal);
    const float slope = max(-dot(mirrored, r.normal), 1e-4); // never to the other side of the plane
    return pointOn(r, clamp(coordinates(r, p + mirrored * (height / slope) - r.centre), -1.0, 1.0));
}
