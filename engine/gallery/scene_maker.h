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

/// Materials that every scene has; those of lamps follow them.
enum Part : std::uint32_t {
    FloorPart,
    WallPart,
    CeilingPart,
    FirstThing,
    LastThing = 5,
    PartCount
};

/// Properties that hold throughout a scene.
struct Traits {
    WallStyle walls = WallStyle::Solid;
    double thickness = 0; ///< of walls [m], before scaling; 0 unless they are solid
    double spacing = 1e9; ///< largest edge of walls [m]
    double scale = 1;     ///< of the whole scene, applied to the vertices or to the root node
    bool scaledByNode = false;
    bool joined = false;      ///< one mesh per material
    bool doubleSided = false; ///< every material
    bool textured = false;
};

/// An axis-aligned box [m].
struct Box {
    glm::dvec3 lower, upper;

    glm::dvec3 size() const { return upper - lower; }
    /// Point at these fractions of its size.
    glm::dvec3 at(double x, double y, double z) const {
        return lower + glm::dvec3(x, y, z) * size();
    }
};

/// Collects the parts of a scene in metres, upright and unscaled. The constructor draws the seed's
/// traits.
class SceneMaker {
public:
    explicit SceneMaker(std::uint64_t seed);

    RandomStream random;
    Traits traits;

    /// Draws the walls again until their style is not `style`.
    void avoid(WallStyle style);

    /// Adds a mesh of a part or lamp, placed by a rotation and then a translation.
    void add(Mesh mesh, std::uint32_t part, const Transform& placement = {});
    void addBlocks(const Blocks& blocks, bool withFloor = true);
    /// Adds a horizontal rectangle that faces up, in quads of the traits' spacing, at most 64 per
    /// side.
    void addGround(double y, glm::dvec2 lower, glm::dvec2 upper);
    /// Adds a free-standing box, rotated about the vertical axis through its centre.
    void addThing(const Box& box, double turn = 0);

    /// Adds an emissive material, textured if `picture`, and returns its part number.
    std::uint32_t addLamp(glm::vec3 nits, bool picture);
    void addLight(Light light);
    void setSky(const Sky& sky) { m_sky = sky; }
    void setCamera(glm::dvec3 eye, glm::dvec3 target);
    void setDarkCamera(glm::dvec3 eye, glm::dvec3 target);

    glm::vec3 lightColor(); ///< near white, with a largest channel of 1
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

/// Rotation by the angle 2 atan(t) about a unit axis, computed with a square root only.
glm::quat turnBy(double t, glm::vec3 axis = {0, 1, 0});

/// Functions that each build one kind of scene by calling add... and set....
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

/// Adds a sun, a sky or both, as for outdoor scenes.
void lightFromOutside(SceneMaker& maker);

} // namespace limn
