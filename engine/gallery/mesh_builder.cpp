// SPDX-License-Identifier: MIT
#include "engine/gallery/mesh_builder.h"

#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {
namespace {

using glm::dvec2;
using glm::dvec3;

dvec3 rounded(dvec3 p) {
    return glm::floor(p * 8192.0 + 0.5) / 8192.0;
}

void addVertex(Mesh& mesh, dvec3 position, dvec3 normal) {
    mesh.positions.push_back(glm::vec3(position));
    mesh.normals.push_back(glm::vec3(glm::normalize(normal)));
}

void addTriangles(Mesh& mesh, std::initializer_list<std::uint32_t> corners) {
    mesh.indices.insert(mesh.indices.end(), corners);
}

// A quad strip between two curves of equal length; each quad flat when `smooth` is false.
void addStrip(Mesh& mesh, const std::vector<dvec3>& right, const std::vector<dvec3>& left) {
    for (std::size_t i = 0; i + 1 < right.size(); ++i)
        addQuad(mesh, right[i], right[i + 1], left[i + 1], left[i]);
}

} // namespace

void addQuad(Mesh& mesh, dvec3 a, dvec3 b, dvec3 c, dvec3 d) {
    const dvec3 p[4] = {rounded(a), rounded(b), rounded(c), rounded(d)};
    const dvec3 normal = glm::cross(p[2] - p[0], p[3] - p[1]);
    if (glm::length(normal) < 1e-9)
        return;
    const auto first = std::uint32_t(mesh.positions.size());
    for (dvec3 corner : p)
        addVertex(mesh, corner, normal);
    if (glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) > 1e-9)
        addTriangles(mesh, {first, first + 1, first + 2});
    if (glm::length(glm::cross(p[2] - p[0], p[3] - p[0])) > 1e-9)
        addTriangles(mesh, {first, first + 2, first + 3});
}

void addBox(Mesh& mesh, dvec3 l, dvec3 u, unsigned faces) {
    if (faces & NegativeX)
        addQuad(mesh, {l.x, l.y, l.z}, {l.x, l.y, u.z}, {l.x, u.y, u.z}, {l.x, u.y, l.z});
    if (faces & PositiveX)
        addQuad(mesh, {u.x, l.y, u.z}, {u.x, l.y, l.z}, {u.x, u.y, l.z}, {u.x, u.y, u.z});
    if (faces & NegativeY)
        addQuad(mesh, {l.x, l.y, l.z}, {u.x, l.y, l.z}, {u.x, l.y, u.z}, {l.x, l.y, u.z});
    if (faces & PositiveY)
        addQuad(mesh, {l.x, u.y, u.z}, {u.x, u.y, u.z}, {u.x, u.y, l.z}, {l.x, u.y, l.z});
    if (faces & NegativeZ)
        addQuad(mesh, {u.x, l.y, l.z}, {l.x, l.y, l.z}, {l.x, u.y, l.z}, {u.x, u.y, l.z});
    if (faces & PositiveZ)
        addQuad(mesh, {l.x, l.y, u.z}, {u.x, l.y, u.z}, {u.x, u.y, u.z}, {l.x, u.y, u.z});
}

void addRing(Mesh& mesh, dvec2 inner, dvec2 outer, double y0, double y1, unsigned faces) {
    // Corners counter-clockwise seen from above (+y), starting at (+x, +z).
    const dvec2 sign[4] = {{1, 1}, {1, -1}, {-1, -1}, {-1, 1}};
    for (int i = 0; i < 4; ++i) {
        const dvec2 i0 = inner * sign[i], i1 = inner * sign[(i + 1) % 4];
        const dvec2 o0 = outer * sign[i], o1 = outer * sign[(i + 1) % 4];
        const bool alongZ = i % 2 == 0; // this side's normal is along x
        if (faces & (alongZ ? PositiveX : PositiveZ))
            addQuad(mesh, {o0.x, y0, o0.y}, {o1.x, y0, o1.y}, {o1.x, y1, o1.y}, {o0.x, y1, o0.y});
        if (faces & (alongZ ? NegativeX : NegativeZ))
            addQuad(mesh, {i1.x, y0, i1.y}, {i0.x, y0, i0.y}, {i0.x, y1, i0.y}, {i1.x, y1, i1.y});
        if (faces & PositiveY)
            addQuad(mesh, {i0.x, y1, i0.y}, {o0.x, y1, o0.y}, {o1.x, y1, o1.y}, {i1.x, y1, i1.y});
        if (faces & NegativeY)
            addQuad(mesh, {i1.x, y0, i1.y}, {o1.x, y0, o1.y}, {o0.x, y0, o0.y}, {i0.x, y0, i0.y});
    }
}

void addSheet(Mesh& mesh, int nu, int nv, bool closed,
              const std::function<dvec3(double, double)>& point) {
    const int columns = nu + 1, rows = nv + 1;
    const auto index = [&](int i, int j) { return std::size_t(j * columns + i); };
    std::vector<dvec3> positions(std::size_t(columns * rows)), normals(positions.size(), dvec3(0));
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const double u = closed && i == nu ? 0 : double(i) / nu;
            positions[index(i, j)] = rounded(point(u, double(j) / nv));
        }
    const auto first = std::uint32_t(mesh.positions.size());
    const auto addTriangle = [&](std::size_t a, std::size_t b, std::size_t c) {
        const dvec3 normal = glm::cross(positions[b] - positions[a], positions[c] - positions[a]);
        if (glm::length(normal) < 1e-9) // at a pole
            return;
        for (std::size_t corner : {a, b, c}) {
            normals[corner] += normal;
            mesh.indices.push_back(first + std::uint32_t(corner));
        }
    };
    for (int j = 0; j < nv; ++j)
        for (int i = 0; i < nu; ++i) {
            addTriangle(index(i, j), index(i + 1, j), index(i + 1, j + 1));
            addTriangle(index(i, j), index(i + 1, j + 1), index(i, j + 1));
        }
    for (int j = 0; closed && j < rows; ++j)
        normals[index(0, j)] = normals[index(nu, j)] = normals[index(0, j)] + normals[index(nu, j)];
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const bool used =
            glm::length(normals[i]) > 0; // a pole keeps vertices that no triangle uses
        addVertex(mesh, positions[i], used ? normals[i] : dvec3(0, 1, 0));
    }
}

void addTurned(Mesh& mesh, dvec3 centre, const Profile& profile, int sides, int flutes,
               double depth) {
    Profile whole; // the pieces, and between two that do not meet the flat that joins them
    for (const std::vector<dvec2>& piece : profile) {
        if (!whole.empty() && whole.back().back() != piece.front())
            whole.push_back({whole.back().back(), piece.front()});
        whole.push_back(piece);
    }
    for (const std::vector<dvec2>& piece : whole) {
        addSheet(mesh, sides, int(piece.size()) - 1, true, [&](double u, double v) {
            const dvec2 p = piece[std::size_t(std::lround(v * double(piece.size() - 1)))];
            const double angle = -2 * std::numbers::pi * u;
            const double groove =
                flutes > 0 ? depth * std::pow(std::abs(std::sin(angle * flutes / 2)), 0.7) : 0;
            const double radius = std::max(p.x - groove, 0.0);
            return centre + dvec3(radius * std::cos(angle), p.y, radius * std::sin(angle));
        });
    }
}

void addArch(Mesh& mesh, dvec3 centre, dvec2 radii, const std::vector<dvec2>& section,
             int segments) {
    for (std::size_t k = 0; k + 1 < section.size(); ++k) {
        addSheet(mesh, segments, 1, false, [&](double u, double v) {
            const dvec2 s = v < 0.5 ? section[k] : section[k + 1];
            const double angle = std::numbers::pi * u;
            return centre +
                   dvec3((radii.x + s.x) * std::cos(angle), (radii.y + s.x) * std::sin(angle), s.y);
        });
    }
}

void addArcadeWall(Mesh& mesh, double halfLength, double springing, double top, double thickness,
                   const std::vector<Opening>& openings, int segments) {
    const double z = thickness / 2;
    std::vector<dvec2> edge = {{-halfLength, springing}}; // the lower edge, left to right
    for (const Opening& opening : openings) {
        for (int i = 0; i <= segments; ++i) {
            const double angle = std::numbers::pi * (1 - double(i) / segments);
            edge.push_back({opening.x + opening.radius * std::cos(angle),
                            springing + opening.radius * std::sin(angle)});
        }
        const double crown = opening.radius, middle = opening.x;
        addSheet(mesh, segments, 1, false, [=](double u, double v) {
            const double angle = std::numbers::pi * (1 - u);
            return dvec3(middle + crown * std::cos(angle), springing + crown * std::sin(angle),
                         v < 0.5 ? -z : z);
        });
    }
    edge.push_back({halfLength, springing});
    std::vector<dvec3> frontLow, frontTop, backLow, backTop;
    for (dvec2 p : edge) {
        frontLow.push_back({p.x, p.y, z});
        frontTop.push_back({p.x, top, z});
        backLow.push_back({p.x, p.y, -z});
        backTop.push_back({p.x, top, -z});
    }
    addStrip(mesh, frontLow, frontTop);
    addStrip(mesh, backTop, backLow);
    for (std::size_t i = 0; i < edge.size();
         i += std::size_t(segments) + 1) // the flats between the openings
        if (i + 1 < edge.size())
            addQuad(mesh, backLow[i], backLow[i + 1], frontLow[i + 1], frontLow[i]);
}

void projectUvs(Mesh& mesh, double size) {
    mesh.uv0.clear();
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const dvec3 p = mesh.positions[i], n = glm::abs(dvec3(mesh.normals[i]));
        const dvec2 uv = n.y >= n.x && n.y >= n.z ? dvec2(p.x, p.z)
                         : n.x > n.z              ? dvec2(p.z, -p.y)
                                                  : dvec2(p.x, -p.y);
        mesh.uv0.push_back(glm::vec2(uv / size));
    }
}

} // namespace limn
