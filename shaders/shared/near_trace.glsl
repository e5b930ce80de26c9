// SPDX-License-Identifier: MIT
// Short rays through the triangles of engine/render/near/near_geometry.h.

layout(set = 1, binding = 0, std430) readonly buffer NearNodes { GpuNearNode nearNodes[]; };
layout(set = 1, binding = 1, std430) readonly buffer NearTriangles { GpuNearTriangle nearTriangles[]; };

struct NearHit {
    float t; // m
    uint triangle;
    vec2 at; // barycentrics of the second and third vertex
    bool front;
};

// Moller, Trumbore. Fast, Minimum Storage Ray/Triangle Intersection. 1997. Keeps the nearer of `hit` and the triangle.
void meetTriangle(uint k, vec3 origin, vec3 direction, inout NearHit hit) {
    const vec3 e1 = nearTriangles[k].edge1, e2 = nearTriangles[k].edge2;
    const vec3 p = cross(direction, e2);
    const float det = dot(e1, p);
    const vec3 s = origin - nearTriangles[k].origin;
    const vec3 q = cross(s, e1);
    const float inverse = 1.0 / det; // a ray along the plane fails all comparisons
    const float u = dot(s, p) * inverse, v = dot(direction, q) * inverse, t = dot(e2, q) * inverse;
    if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < hit.t)
        hit = NearHit(t, k, vec2(u, v), det > 0.0);
}

// The nearest triangle within `reach`; none: t = reach. The number of nodes is that of the root's `next`: invocations of
// pixels that are not covered may read 0 from every buffer, so that a loop up to a number from elsewhere would not end.
NearHit traceNear(vec3 origin, vec3 direction, float reach) {
    const uint nodes = reach > 0.0 ? nearNodes[0].next : 0u;
    NearHit hit = NearHit(reach, 0u, vec2(0), true);
    const vec3 inverse = 1.0 / mix(direction, vec3(1e-20), lessThan(abs(direction), vec3(1e-20)));
    uint node = 0u;
    while (node < nodes) {
        const vec3 a = (nearNodes[node].lower - origin) * inverse, b = (nearNodes[node].upper - origin) * inverse;
        const vec3 enter = min(a, b), leave = max(a, b);
        const float from = max(max(enter.x, enter.y), max(enter.z, 0.0)),
                    to = min(min(leave.x, leave.y), min(leave.z, hit.t));
        const uint triangles = nearNodes[node].triangles;
        if (from > to) {
            node = max(nearNodes[node].next, node + 1u); // node increases, so that the loop ends whatever is read
            continue;
        }
        for (uint k = triangles >> 3, end = k + (triangles & 7u); k < end; ++k)
            meetTriangle(k, origin, direction, hit);
        ++node;
    }
    return hit;
}
