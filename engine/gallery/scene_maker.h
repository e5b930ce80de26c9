// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gallery/blocks.h"
#include "engine/gallery/gallery.h"
#include "engine/gallery/random_stream.h"

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace limn {

/// How walls are modelled.
enum class WallStyle { Solid, TwoSided, FacingIn };

/// Materials that every scene has; lamps come after them.
enum Part : std::uint32_t {
    FloorPart,
    WallPart,
    CeilingPart,
    FirstThing,
    LastThing = 5,
    PartCount
};

/// What is the same all over a scene.
struct Traits {
    WallStyle walls = WallStyle::Solid;
    double thickness = 0; ///< of walls [m], before scaling; 0 unless they are solid
    double spacing = 1e9; ///< largest edge of walls [m]
    double scale = 1;     ///< of the whole scene, vertices or root node
    bool scaledByNode = false;
    bool joined = false;      ///< one mesh per material
    bool doubleSided = false; ///< every material
    bool textured = false;
};

/// A box along the axes [m].
struct Box {
    glm::dvec3 lower, upper;

    glm::dvec3 size() const { return upper - lower; }
    /// The point at these shares of its size.
    glm::dvec3 at(double x, double y, double z) const {
        return lower + glm::dvec3(x, y, z) * size();
    }
};

/// Collects the parts of a scene in metres, upright and unscaled. The seed's traits are drawn when
/// it is made.
class SceneMaker {
public:
    explicit SceneMaker(std::uint64_t seed);

    RandomStream random;
    Traits traits;

    /// Draws walls again until they are not `style`.
    void avoid(WallStyle style);

    /// Adds a mesh of that part, or lamp, placed by a rotation and then a translation.
    void add(Mesh mesh, std::uint32_t part, const Transform& placement = {});
    void addBlocks(const Blocks& blocks, bool withFloor = true);
    /// A level rectangle that faces up, in quads of the traits' spacing, 64 a side at most.
    void addGround(double y, glm::dvec2 lower, glm::dvec2 upper);
    /// A box that stands alone, turned about the upright axis through its middle.
    void addThing(const Box& box, double turn = 0);

    /// A material of its own that glows, with a picture where asked for.
    std::uint32_t addLamp(glm::vec3 nits, bool picture);
    void addLight(Light light);
    void setSky(const Sky& sky) { m_sky = sky; }
    void setCamera(glm::dvec3 eye, glm::dvec3 target);
    void setDarkCamera(glm::dvec3 eye, glm::dvec3 target);

    glm::vec3 lightColor(); ///< near white, its largest channel 1
    GeneratedScene finish();

private:
    void drawWalls();
    void makeMaterials();
    std::int32_t addImage(int size, int cells, double darkest);
    Camera placed(glm::dvec3 eye, glm::dvec3 target, const char* name);
    glm::dvec3 toWorld(glm::dvec3 p) const;

    std::vector<Material> m_materials;
    std::vector<std::pair<Mesh, Transform>> m_meshes;
    std::map<std::uint32_t, std::size_t> m_meshOfPart; ///< of joined scenes
    std::vector<Image> m_images;
    std::vector<Light> m_lights;
    Sky m_sky;
    std::optional<Camera> m_camera, m_darkCamera;
    glm::quat m_turn{1, 0, 0, 0}; ///< of the whole scene about +Y
};

/// A turn by the angle 2 atan(t) about an axis (unit), from a square root alone.
glm::quat turnBy(double t, glm::vec3 axis = {0, 1, 0});

/// Each calls add... and set... until the scene is whole.
void makeRoom(SceneMaker& maker);
void makeTwoRooms(SceneMaker& maker);
void makeCourt(SceneMaker& maker);
void makeColonnade(SceneMaker& maker);
void makeStreet(SceneMaker& maker);
void makeCave(SceneMaker& maker);
void makeFurnishedBox(SceneMaker& maker);
void makeBlinds(SceneMaker& maker);
void makeDoorAjar(SceneMaker& maker);
void makeLamps(SceneMaker& maker);
void makeHouseOnPlane(SceneMaker& maker);

/// A sun, a sky, or both, as shine on what stands in the open.
void lightFromOutside(SceneMaker& maker);

} // namespace limn
