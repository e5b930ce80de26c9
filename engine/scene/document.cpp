// SPDX-License-Identifier: MIT
#include "engine/scene/document.h"

#include <glm/gtc/matrix_transform.hpp>

namespace limn {

glm::mat4 matrix(const Transform& t) {
    glm::mat4 m = glm::mat4_cast(t.rotation);
    m[0] *= t.scale.x;
    m[1] *= t.scale.y;
    m[2] *= t.scale.z;
    m[3] = glm::vec4(glm::vec3(t.translation), 1);
    return m;
}

glm::dmat4 preciseMatrix(const Transform& t) {
    // Normalised in double, too: quarter turns, such as from z-up to y-up, are then exact.
    glm::dmat4 m = glm::mat4_cast(glm::normalize(glm::dquat(t.rotation)));
    m[0] *= double(t.scale.x);
    m[1] *= double(t.scale.y);
    m[2] *= double(t.scale.z);
    m[3] = glm::dvec4(t.translation, 1);
    return m;
}

ObjectId addObject(Document& document, Object object) {
    const ObjectId id = document.nextId++;
    document.objects.emplace(id, std::move(object));
    return id;
}

std::string objectName(const Object& object) {
    struct {
        std::string operator()(const Node& o) const { return o.name; }
        std::string operator()(const Material& o) const { return o.name; }
        std::string operator()(const Light& o) const { return o.name; }
        std::string operator()(const Camera& o) const { return o.name; }
        std::string operator()(const Sky&) const { return "Sky"; }
        std::string operator()(const BakeSettings&) const { return "Bake settings"; }
        std::string operator()(const TechniqueChoice&) const { return "Technique"; }
        std::string operator()(const RelightSettings&) const { return "Relighting"; }
        std::string operator()(const ExportSettings&) const { return "Export"; }
    } name;
    return std::visit(name, object);
}

} // namespace limn
