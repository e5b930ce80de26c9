// SPDX-License-Identifier: MIT
#include "engine/gallery/mesh_builder.h"
#include "engine/gallery/scene_maker.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

using glm::dvec2, glm::dvec3;

constexpr double kBelowGround = 0.05; ///< [m] that walls reach below a floor they stand on

/// A hole in a wall of a room.
struct WallHole {
    Box hole;
    dvec3 inward; ///< unit
};

/// A building of rooms under construction.
struct House {
    Blocks blocks;
    bool onGround = false; ///< the floor is a sheet that the walls stand on

    void addWallsOf(const Traits& t, Box room) {
        if (t.walls != WallStyle::Solid)
            return;
        const double below = onGround ? 0 : t.thickness;
        blocks.fill(room.lower - dvec3(t.thickness, below, t.thickness), room.upper + t.thickness,
                    kSolid);
    }
    void addRoom(Box room, int number) {
        blocks.fill(room.lower, room.upper, number);
        if (onGround)
            blocks.open({room.lower.x, room.lower.y - 0.01, room.lower.z},
                        {room.upper.x, room.lower.y + 0.01, room.upper.z});
    }
    /// Cuts a hole of `depth` through the wall of `room` at the lower or upper end of `axis`.
    WallHole cut(Box room, int axis, bool upper, Box hole, double depth) {
        const double wall = upper ? room.upper[axis] : room.lower[axis];
        hole.lower[axis] = upper ? wall : wall - depth;
        hole.upper[axis] = upper ? wall + depth : wall;
        if (depth > 0)
            blocks.fill(hole.lower, hole.upper, kOutside);
        dvec3 lower = hole.lower, top = hole.upper, inward(0);
        lower[axis] -= 0.01;
        top[axis] += 0.01;
        inward[axis] = upper ? -1 : 1;
        blocks.open(lower, top);
        return {hole, inward};
    }
};

Box drawnRoom(SceneMaker& m) {
    const dvec3 size{m.random.between(3, 8), m.random.between(2.4, 4), m.random.between(3, 8)};
    return {dvec3(0), size};
}

/// Adds a sun that shines through an opening onto the floor or the far wall.
void addSunThrough(SceneMaker& m, Box room, const WallHole& o) {
    const dvec3 from = (o.hole.lower + o.hole.upper) / 2.0;
    const dvec3 away{m.random.between(0.2, 0.8), m.random.between(0, 0.2),
                     m.random.between(0.2, 0.8)};
    dvec3 target = room.at(away.x, away.y, away.z);
    target.y = std::min(target.y, from.y - 0.3);
    Light sun;
    sun.kind = LightKind::Directional;
    sun.direction = glm::vec3(glm::normalize(target - from));
    sun.color = m.lightColor();
    sun.strength = float(m.random.between(50, 200));
    m.addLight(sun);
}

void addSky(SceneMaker& m, double strength) {
    Sky sky;
    sky.radiance = glm::vec3(float(strength)) * glm::vec3(0.6f, 0.8f, 1);
    if (m.random.chance(0.6)) {
        sky.kind = SkyKind::Gradient;
        sky.horizon = glm::vec3(float(strength * m.random.between(0.5, 1.5)));
        sky.ground = glm::vec3(float(strength * m.random.between(0, 0.4)));
    }
    m.setSky(sky);
}

/// Adds a point (0), spot (1) or rectangle light (2) below the ceiling.
void addLamp(SceneMaker& m, Box room, int kind) {
    Light light;
    light.color = m.lightColor();
    const dvec3 share{m.random.between(0.35, 0.65), m.random.between(0.72, 0.92),
                      m.random.between(0.35, 0.65)};
    light.position = glm::vec3(room.at(share.x, share.y, share.z));
    const dvec3 way{m.random.between(-0.6, 0.6), -1, m.random.between(-0.6, 0.6)};
    light.direction = glm::vec3(glm::normalize(way));
    light.strength = float(m.random.between(50, 300));
    if (kind == 1) {
        light.kind = LightKind::Spot;
        light.innerAngle = float(m.random.between(0.1, 0.4));
        light.outerAngle = light.innerAngle + float(m.random.between(0.1, 0.5));
        light.strength *= 4;
    } else if (kind == 2) {
        light.kind = LightKind::Rectangle;
        light.size = {float(m.random.between(0.2, 1.2)), float(m.random.between(0.2, 1.2))};
        light.strength /= light.size.x * light.size.y;
    }
    m.addLight(light);
}

/// Adds an emissive panel in the middle of the ceiling.
void addPanel(SceneMaker& m, Box room) {
    const dvec2 half{m.random.between(0.15, 0.6), m.random.between(0.15, 0.6)};
    const dvec3 c = room.at(0.5, 1, 0.5) - dvec3(0, m.random.between(0.02, 0.3), 0);
    Mesh mesh;
    addQuad(mesh, c + dvec3(-half.x, 0, -half.y), c + dvec3(half.x, 0, -half.y),
            c + dvec3(half.x, 0, half.y), c + dvec3(-half.x, 0, half.y));
    const double nits = m.random.between(20, 60) / (half.x * half.y);
    const glm::vec3 color = m.lightColor();
    m.add(std::move(mesh), m.addLamp(color * float(nits), false));
}

/// Adds light to a room without windows.
void lightFromInside(SceneMaker& m, Box room) {
    if (m.random.chance(0.35))
        addPanel(m, room);
    else
        for (int n = m.random.whole(1, 2); n > 0; --n)
            addLamp(m, room, m.random.whole(0, 2));
}

/// Adds light through openings: sun, sky or both, and sometimes a lamp.
void lightThrough(SceneMaker& m, Box room, const std::vector<WallHole>& openings) {
    const double draw = m.random.number();
    if (draw < 0.75)
        addSunThrough(m, room, openings.front());
    if (draw > 0.4)
        addSky(m, m.random.between(5, 30));
    if (m.random.chance(0.2))
        addLamp(m, room, m.random.whole(0, 2));
}

/// Adds windows to the walls that `allowed` permits (-x, +x, -z, +z).
std::vector<WallHole> addWindows(SceneMaker& m, House& house, Box room, int count,
                                 const std::array<bool, 4>& allowed) {
    std::vector<WallHole> openings;
    for (int side = m.random.whole(0, 3), tries = 0; tries < 4; ++tries, side = (side + 1) % 4) {
        if (int(openings.size()) == count || !allowed[std::size_t(side)])
            continue;
        const int axis = side < 2 ? 0 : 2, along = 2 - axis;
        Box hole = room;
        const double width = room.size()[along] * m.random.between(0.2, 0.6);
        hole.lower[along] += (room.size()[along] - width) * m.random.between(0.3, 0.7);
        hole.upper[along] = hole.lower[along] + width;
        hole.lower.y += room.size().y * m.random.between(0.25, 0.4);
        hole.upper.y -= room.size().y * m.random.between(0.1, 0.3);
        openings.push_back(house.cut(room, axis, side % 2 == 1, hole, m.traits.thickness));
    }
    return openings;
}

/// Sets a camera that looks from one end of the longer side towards the other.
void lookAlong(SceneMaker& m, Box room, bool dark = false) {
    const bool alongX = room.size().x >= room.size().z;
    const double end = m.random.chance(0.5) ? 0.22 : 0.78;
    const double across = m.random.between(0.35, 0.65), aim = m.random.between(0.3, 0.7);
    const double height = std::min(m.random.between(1.3, 1.7), 0.68 * room.size().y);
    dvec3 eye = alongX ? room.at(end, 0, across) : room.at(across, 0, end);
    dvec3 target = alongX ? room.at(1 - end, 0, aim) : room.at(aim, 0, 1 - end);
    eye.y = room.lower.y + height;
    target.y = room.lower.y + height * m.random.between(0.5, 1);
    if (dark)
        m.setDarkCamera(eye, target);
    else
        m.setCamera(eye, target);
}

/// Adds low boxes below and away from the camera.
void addFurniture(SceneMaker& m, Box room, int count, double floor) {
    for (int i = 0; i < count; ++i) {
        const dvec3 size{m.random.between(0.3, 1.2), m.random.between(0.3, 0.9),
                         m.random.between(0.3, 1.2)};
        const dvec3 fractions{m.random.between(0.2, 0.8), 0, m.random.between(0.2, 0.8)};
        dvec3 lower = room.at(fractions.x, 0, fractions.z) - size / 2.0;
        lower.y = floor;
        m.addThing({lower, lower + size}, m.random.chance(0.5) ? m.random.between(-1, 1) : 0);
    }
}

/// Adds the walls, and the ground if the house stands on one.
void addHouse(SceneMaker& m, const House& house, Box around, double margin) {
    m.addBlocks(house.blocks);
    if (house.onGround)
        m.addGround(around.lower.y + kBelowGround,
                    {around.lower.x - margin, around.lower.z - margin},
                    {around.upper.x + margin, around.upper.z + margin});
}

/// Extends the walls of a room below the ground that it stands on.
Box standing(Box room, bool onGround) {
    if (onGround)
        room.lower.y -= kBelowGround;
    return room;
}

/// Lights a room through its openings, or from inside if it has none.
void lightRoom(SceneMaker& m, const Box& room, const std::vector<WallHole>& openings) {
    if (openings.empty())
        lightFromInside(m, room);
    else
        lightThrough(m, room, openings);
}

} // namespace

void makeRoom(SceneMaker& m) {
    House house;
    house.onGround = m.random.chance(0.3);
    const Box room = standing(drawnRoom(m), house.onGround);
    house.addWallsOf(m.traits, room);
    house.addRoom(room, kFirstRoom);
    const int windows = m.random.whole(0, 3);
    const auto openings = addWindows(m, house, room, windows, {true, true, true, true});
    addHouse(m, house, room, 1 + m.traits.thickness);
    addFurniture(m, room, m.random.whole(0, 5), 0);
    lightRoom(m, room, openings);
    lookAlong(m, room);
}

void makeTwoRooms(SceneMaker& m) {
    House house;
    house.onGround = m.random.chance(0.5);
    const Box lit = standing(drawnRoom(m), house.onGround);
    // Inward-facing sheets cannot share a wall: where two meet, either may be hit from behind.
    const double gap = m.traits.walls == WallStyle::Solid      ? m.traits.thickness
                       : m.traits.walls == WallStyle::FacingIn ? m.random.between(0.05, 0.5)
                                                               : 0;
    Box dark = lit;
    dark.lower.x = lit.upper.x + gap;
    dark.upper.x = dark.lower.x + m.random.between(2.5, 6);
    house.addWallsOf(m.traits, lit);
    house.addWallsOf(m.traits, dark);
    house.addRoom(lit, kFirstRoom);
    house.addRoom(dark, kFirstRoom + 1);
    const auto openings =
        addWindows(m, house, lit, m.random.whole(0, 2), {true, false, true, true});
    addHouse(m, house, {lit.lower, dark.upper}, 1 + m.traits.thickness);
    addFurniture(m, lit, m.random.whole(0, 3), 0);
    addFurniture(m, dark, m.random.whole(0, 3), 0);
    lightRoom(m, lit, openings);
    lookAlong(m, lit);
    lookAlong(m, dark, true);
}

static void addShelf(SceneMaker& m, Box room, double side) {
    const double depth = m.random.between(0.15, 0.35), height = m.random.between(0.8, 1.9);
    const double thick = m.random.between(0.01, 0.04), width = m.random.between(0.6, 1.6);
    const double z = m.random.between(0.1, 0.9) * (room.size().z - width);
    const double x = side == 0 ? room.lower.x + 0.01 : room.upper.x - 0.01 - depth;
    const int boards = m.random.whole(3, 7);
    for (int k = 0; k < boards; ++k) {
        const double y = height * k / (boards - 1);
        m.addThing({{x, y + 0.002, z + thick}, {x + depth, y + thick, z + width - thick}});
    }
    m.addThing({{x, 0, z}, {x + depth, height + thick, z + thick}});
    m.addThing({{x, 0, z + width - thick}, {x + depth, height + thick, z + width}});
}

/// Adds a picture frame of four bars on the wall at the room's lower z, and the picture in it.
static void addFrame(SceneMaker& m, Box room) {
    const double w = m.random.between(0.3, 1), h = m.random.between(0.3, 0.8);
    const double bar = m.random.between(0.02, 0.06), deep = m.random.between(0.015, 0.05);
    const double x = m.random.between(0.1, 0.9) * (room.size().x - w);
    const double y = 0.4 * room.size().y, z = room.lower.z + 0.005;
    m.addThing({{x, y, z}, {x + w, y + bar, z + deep}});
    m.addThing({{x, y + h - bar, z}, {x + w, y + h, z + deep}});
    m.addThing({{x, y + bar, z}, {x + bar, y + h - bar, z + deep}});
    m.addThing({{x + w - bar, y + bar, z}, {x + w, y + h - bar, z + deep}});
    m.addThing({{x + bar, y + bar, z}, {x + w - bar, y + h - bar, z + deep / 3}});
}

static void addTable(SceneMaker& m, Box room) {
    const dvec3 size{m.random.between(0.5, 1.4), m.random.between(0.4, 0.8),
                     m.random.between(0.5, 1)};
    const double leg = m.random.between(0.02, 0.06), top = m.random.between(0.01, 0.05);
    const dvec3 share{m.random.between(0.1, 0.9), 0, m.random.between(0.1, 0.9)};
    const dvec3 corner = share * (room.size() - size);
    m.addThing({corner + dvec3(0, size.y - top, 0), corner + size});
    for (const double x : {0.0, size.x - leg})
        for (const double z : {0.0, size.z - leg})
            m.addThing({corner + dvec3(x, 0, z), corner + dvec3(x + leg, size.y - top, z + leg)});
}

void makeFurnishedBox(SceneMaker& m) {
    House house;
    const Box room = drawnRoom(m);
    house.addWallsOf(m.traits, room);
    house.addRoom(room, kFirstRoom);
    const auto openings =
        addWindows(m, house, room, m.random.whole(0, 2), {false, false, false, true});
    m.addBlocks(house.blocks);
    for (int n = m.random.whole(1, 4); n > 0; --n)
        addShelf(m, room, m.random.whole(0, 1));
    for (int n = m.random.whole(1, 5); n > 0; --n)
        addFrame(m, room);
    for (int n = m.random.whole(1, 5); n > 0; --n)
        addTable(m, room);
    lightRoom(m, room, openings);
    lookAlong(m, room);
}

void makeBlinds(SceneMaker& m) {
    House house;
    const Box room = drawnRoom(m);
    house.addWallsOf(m.traits, room);
    house.addRoom(room, kFirstRoom);
    Box hole = room;
    hole.lower.x += 0.12 * room.size().x;
    hole.upper.x -= 0.12 * room.size().x;
    hole.lower.y += 0.25 * room.size().y;
    hole.upper.y -= 0.1 * room.size().y;
    const WallHole window = house.cut(room, 2, true, hole, m.traits.thickness);
    m.addBlocks(house.blocks);
    const int count = m.random.whole(6, 24);
    const double pitch = hole.size().y / count, width = hole.size().x - 0.02;
    const double deep = pitch * m.random.between(0.5, 1), tilt = m.random.between(-0.4, 0.4);
    const bool thin = m.random.chance(0.3);
    for (int k = 0; k < count; ++k) {
        Transform transform;
        transform.translation = glm::vec3(room.at(0.5, 0, 1) - dvec3(0, 0, 0.02 + deep / 2));
        transform.translation.y = float(hole.lower.y + pitch * (k + 0.5));
        transform.rotation = turnBy(tilt, {1, 0, 0});
        const dvec3 half(width / 2, thin ? 0.001 : 0.004, deep / 2);
        Mesh slat;
        addBox(slat, -half, half);
        m.add(std::move(slat), FirstThing, transform);
    }
    addFurniture(m, room, m.random.whole(0, 3), 0);
    addSunThrough(m, room, window);
    if (m.random.chance(0.4))
        addSky(m, m.random.between(3, 15));
    lookAlong(m, room);
}

void makeDoorAjar(SceneMaker& m) {
    m.avoid(WallStyle::FacingIn); // the jambs of a gap between two sheets would be open
    m.traits.thickness = std::min(m.traits.thickness, 0.3); // else the gap is a tunnel
    House house;
    const Box dark = drawnRoom(m);
    Box lit = dark;
    const double t = m.traits.thickness;
    lit.lower.z = dark.upper.z + t;
    lit.upper.z = lit.lower.z + m.random.between(3, 6);
    house.addWallsOf(m.traits, dark);
    house.addWallsOf(m.traits, lit);
    house.addRoom(dark, kFirstRoom);
    house.addRoom(lit, kFirstRoom + 1);
    const double width = 0.9, x = dark.at(m.random.between(0.3, 0.6), 0, 0).x;
    house.cut(dark, 2, true, {{x, 0, 0}, {x + width, 2, 0}}, t);
    const auto openings =
        addWindows(m, house, lit, m.random.whole(0, 1), {true, true, false, true});
    m.addBlocks(house.blocks);
    // The door turns around the jamb at the upper x, into the dark room.
    Mesh door;
    addBox(door, {-width + 0.005, 0.01, -0.04}, {0, 1.99, 0});
    Transform hinge;
    hinge.translation = glm::vec3(glm::dvec3(x + width - 0.002, 0, dark.upper.z - 0.002));
    hinge.rotation = turnBy(-m.random.between(0.3, 1));
    m.add(std::move(door), FirstThing, hinge);
    addLamp(m, lit, 0); // all round, so that some of it meets the gap
    if (!openings.empty())
        addSunThrough(m, lit, openings.front());
    const dvec3 eye = dark.at(m.random.between(0.3, 0.7), 0.5, 0.15);
    m.setCamera(eye, {x + width / 2, 1, dark.upper.z});
}

/// Adds a lamp of one of four shapes at a position in the room.
static void addShapedLamp(SceneMaker& m, Box room, int shape) {
    const dvec3 share{m.random.between(0.35, 0.65), m.random.between(0.74, 0.86),
                      m.random.between(0.35, 0.65)}; // clear of the camera
    Transform transform;
    transform.translation = glm::vec3(room.at(share.x, share.y, share.z));
    Mesh mesh;
    double area = 1;
    if (shape == 0) { // sphere
        const double r = m.random.between(0.05, 0.25);
        std::vector<dvec2> arc;
        for (int k = 0; k <= 8; ++k)
            arc.push_back(
                {r * std::sin(std::numbers::pi * k / 8), -r * std::cos(std::numbers::pi * k / 8)});
        addTurned(mesh, dvec3(0), {arc}, 12);
        area = 4 * std::numbers::pi * r * r;
    } else if (shape == 1) { // tube
        const double r = m.random.between(0.01, 0.05), half = m.random.between(0.3, 0.8);
        addTurned(mesh, dvec3(0),
                  {{{0, -half}, {r, -half}}, {{r, -half}, {r, half}}, {{r, half}, {0, half}}}, 10);
        transform.rotation = turnBy(1, {0, 0, 1});
        area = 4 * std::numbers::pi * r * half;
    } else { // panel that hangs, or a sign on the wall at the lower z
        const dvec2 half{m.random.between(0.1, 0.6), m.random.between(0.05, 0.4)};
        addQuad(mesh, {-half.x, -half.y, 0}, {half.x, -half.y, 0}, {half.x, half.y, 0},
                {-half.x, half.y, 0});
        mesh.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
        if (shape == 2)
            transform.rotation = turnBy(1, {1, 0, 0}); // its front looks down
        else
            transform.translation.z = float(room.lower.z + 0.02);
        area = 4 * half.x * half.y;
    }
    const double nits = m.random.between(10, 60) / area;
    const glm::vec3 color = m.lightColor();
    m.add(std::move(mesh), m.addLamp(color * float(nits), shape == 3), transform);
}

void makeLamps(SceneMaker& m) {
    House house;
    const Box room = drawnRoom(m);
    house.addWallsOf(m.traits, room);
    house.addRoom(room, kFirstRoom);
    m.addBlocks(house.blocks);
    addFurniture(m, room, m.random.whole(0, 4), 0);
    for (int n = m.random.whole(1, 5); n > 0; --n)
        addShapedLamp(m, room, m.random.whole(0, 3));
    lookAlong(m, room);
}

void makeHouseOnPlane(SceneMaker& m) {
    House house;
    house.onGround = true;
    const Box room = standing(drawnRoom(m), true);
    house.addWallsOf(m.traits, room);
    house.addRoom(room, kFirstRoom);
    const auto openings =
        addWindows(m, house, room, m.random.whole(1, 3), {true, true, true, true});
    addHouse(m, house, room, m.random.between(30, 200));
    addFurniture(m, room, m.random.whole(0, 3), 0);
    lightThrough(m, room, openings);
    lookAlong(m, room);
}

} // namespace limn
