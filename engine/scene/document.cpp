// SPDX-License-Identifier: MIT
#include "engine/scene/document.h"

#include <glm/gtc/matrix_transform.hpp>

namespace limn {

glm::mat4 matrix(const Transform& t) {
    glm::mat4 m = glm::mat4_cast(t.rotation);
    m[0] *= t.scale.x;
    m[1] *= t.scale.y;
    m[2] *= t.scale.z;
    m[3] = glm::vec4(t.translation, 1);
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
    } name;
    return std::visit(name, object);
}

} // namespace limn
