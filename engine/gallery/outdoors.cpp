// SPDX-License-Identifier: MIT
#include "engine/gallery/mesh_builder.h"
#include "engine/gallery/scene_maker.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

using glm::dvec2, glm::dvec3;

/// Adds a sun at an elevation of 30 to 65 degrees, in the quadrant of the horizontal direction
/// `from`.
static void addSun(SceneMaker& m, dvec2 from) {
    const dvec3 to{from.x + m.random.between(-0.5, 0.5), m.random.between(0.6, 1.8),
                   from.y + m.random.between(-0.5, 0.5)};
    Light sun;
    sun.kind = LightKind::Directional;
    sun.direction = glm::vec3(-glm::normalize(to));
    sun.color = m.lightColor();
    sun.strength = float(m.random.between(30, 120));
    m.addLight(sun);
}

static void addOpenSky(SceneMaker& m) {
    Sky sky;
    const float nits = float(m.random.between(2, 12));
    sky.radiance = nits * glm::vec3(0.6f, 0.8f, 1);
    if (m.random.chance(0.6)) {
        sky.kind = SkyKind::Gradient;
        sky.horizon = glm::vec3(nits * float(m.random.between(0.5, 1.5)));
        sky.ground = glm::vec3(nits * float(m.random.between(0, 0.4)));
    }
    m.setSky(sky);
}

void lightFromOutside(SceneMaker& m) {
    const double draw = m.random.number();
    if (draw < 0.8) {
        const dvec2 from{m.random.between(-1, 1), m.random.between(-1, 1)};
        addSun(m, from);
    }
    if (draw > 0.4)
        addOpenSky(m);
}

void makeCourt(SceneMaker& m) {
    const dvec3 size{m.random.between(6, 18), m.random.between(4, 12), m.random.between(6, 18)};
    const double wall = m.random.between(0.5, 3);
    Blocks blocks;
    const bool sheets = m.traits.walls != WallStyle::Solid;
    if (!sheets)
        blocks.fill({-wall, -0.5, -wall}, size + dvec3(wall, 0, wall), kSolid);
    blocks.fill(dvec3(0), size, kFirstRoom);
    blocks.open({0, size.y - 0.01, 0}, {size.x, size.y + 0.01, size.z});
    // A protruding storey, or niches.
    if (m.random.chance(0.5)) {
        const double deep = m.random.between(0.5, 1.5), y = size.y * m.random.between(0.4, 0.7);
        blocks.fill({0, y, 0}, {size.x, y + m.random.between(0.2, 1), deep}, kSolid);
    }
    for (int n = m.random.whole(0, 4); n > 0 && !sheets; --n) {
        const double x = size.x * m.random.between(0.1, 0.8),
                     deep = wall * m.random.between(0.2, 0.9);
        blocks.fill({x, 0, size.z},
                    {x + m.random.between(0.5, 1.5), m.random.between(1, 2.5), size.z + deep},
                    kFirstRoom);
    }
    m.addBlocks(blocks);
    lightFromOutside(m);
    const double x = m.random.between(0.35, 0.65);
    m.setCamera(dvec3(x, 0, 0.8) * size + dvec3(0, 1.6, 0),
                dvec3(1 - x, 0.1, 0.2) * size + dvec3(0, 1, 0));
}

void makeColonnade(SceneMaker& m) {
    const int columns = m.random.whole(4, 9);
    const double bay = m.random.between(1.5, 3.5), deep = m.random.between(2, 5);
    const double height = m.random.between(2.5, 5), radius = m.random.between(0.12, 0.35);
    const double length = columns * bay;
    Blocks blocks; // the open side is at the lower z
    blocks.fill({0, 0, deep}, {length, height, deep + std::max(m.traits.thickness, 0.1)}, kSolid);
    blocks.fill({0, height, -0.3}, {length, height + m.random.between(0.1, 0.6), deep + 0.1},
                kSolid);
    m.addBlocks(blocks);
    m.addGround(0, {-4, -8}, {length + 4, deep + 0.05});
    const int sides = m.random.whole(6, 28);
    for (int k = 0; k < columns; ++k) {
        Mesh column;
        addTurned(column, dvec3(0),
                  {{{radius, -0.01}, {radius, height / 2}, {radius, height + 0.01}}}, sides);
        Transform transform;
        transform.translation = glm::vec3(dvec3((k + 0.5) * bay, 0, 0));
        m.add(std::move(column), FirstThing, transform);
    }
    addSun(m, {m.random.between(-0.7, 0.7), -1});
    if (m.random.chance(0.6))
        addOpenSky(m);
    const dvec3 eye{0.4 * bay, 1.6, deep * m.random.between(0.5, 0.7)};
    const dvec3 target{length, m.random.between(0.8, 1.6), deep * m.random.between(0.2, 0.6)};
    m.setCamera(eye, target);
}

void makeStreet(SceneMaker& m) {
    const double width = m.random.between(4, 14);
    Blocks blocks;
    double length = 0;
    const int houses = m.random.whole(2, 5);
    for (int k = 0; k < houses; ++k) {
        const double front = m.random.between(5, 12), alley = m.random.chance(0.3) ? 1.5 : 0;
        const dvec2 back{m.random.between(4, 10), m.random.between(4, 10)};
        const dvec2 top{m.random.between(4, 15), m.random.between(4, 15)};
        blocks.fill({length, -0.05, -width / 2 - back.x}, {length + front, top.x, -width / 2},
                    kSolid);
        blocks.fill({length, -0.05, width / 2}, {length + front, top.y, width / 2 + back.y},
                    kSolid);
        length += front + alley;
    }
    m.addBlocks(blocks);
    const double margin = m.random.between(5, 40);
    m.addGround(0, {-margin, -width / 2 - margin}, {length + margin, width / 2 + margin});
    lightFromOutside(m);
    const double side = m.random.between(-0.3, 0.3);
    m.setCamera({0.1 * length, 1.6, side * width},
                {0.7 * length, m.random.between(1, 3), -side * width});
}

/// Hash in [0, 1) of a lattice point.
static double latticeNoise(std::uint64_t seed, int x, int y, int z) {
    const auto part = [](int i, std::uint64_t factor) { return std::uint64_t(i + 1000) * factor; };
    return RandomStream(seed ^ part(x, 0x8da6b343U) ^ part(y, 0xd8163841U) ^ part(z, 0xcb1ab31fU))
        .number();
}

/// Noise in [0, 1), interpolated smoothly between lattice points.
static double valueNoise(std::uint64_t seed, dvec3 p) {
    const dvec3 cell = glm::floor(p), t = p - cell, s = t * t * (3.0 - 2.0 * t);
    double sum = 0;
    for (int k = 0; k < 8; ++k) {
        const int x = k & 1, y = k >> 1 & 1, z = k >> 2;
        const double weight = (x ? s.x : 1 - s.x) * (y ? s.y : 1 - s.y) * (z ? s.z : 1 - s.z);
        sum += weight * latticeNoise(seed, int(cell.x) + x, int(cell.y) + y, int(cell.z) + z);
    }
    return sum;
}

void makeCave(SceneMaker& m) {
    const dvec3 radii{m.random.between(3, 8), m.random.between(2, 4), m.random.between(3, 8)};
    const double depth = m.random.between(0.1, 0.4), frequency = m.random.between(1, 4);
    const std::uint64_t noise = m.random.bits();
    const bool opens = m.random.chance(0.5);
    const double end = opens ? m.random.between(0.75, 0.88) : 1; // of the way from below to above
    const int around = m.random.whole(16, 64), up = around / 2;
    // Star-shaped about the origin: no point is nearer than (1 - depth) of the smallest radius.
    const auto point = [&](double u, double v, double grown) {
        const double polar = std::numbers::pi * v * end, angle = 2 * std::numbers::pi * u;
        const dvec3 d(std::sin(polar) * std::cos(angle), -std::cos(polar),
                      std::sin(polar) * std::sin(angle));
        const double r = 1 - depth * valueNoise(noise, d * frequency);
        return d * radii * r + d * grown;
    };
    Mesh inner;
    addSheet(inner, around, up, true, [&](double u, double v) { return point(u, v, 0); });
    m.add(std::move(inner), WallPart);
    if (m.traits.walls == WallStyle::Solid) {
        const double t = m.traits.thickness;
        Mesh outer, rim;
        addSheet(outer, around, up, true, [&](double u, double v) { return point(1 - u, v, t); });
        m.add(std::move(outer), WallPart);
        if (opens) {
            addSheet(rim, around, 1, true, [&](double u, double v) { return point(u, 1, v * t); });
            m.add(std::move(rim), WallPart);
        }
    }
    if (opens) {
        lightFromOutside(m);
    } else {
        Light lamp;
        lamp.color = m.lightColor();
        const double side = m.random.between(-0.3, 0.3);
        lamp.position = glm::vec3(dvec3(side, 0.3, -side) * radii);
        lamp.strength = float(m.random.between(50, 300));
        m.addLight(lamp);
    }
    const dvec3 eye{0.35, -0.1, m.random.between(-0.2, 0.2)};
    const dvec3 target{-0.5, -0.2, m.random.between(-0.3, 0.3)};
    m.setCamera(eye * radii, target * radii);
}

} // namespace limn
