// SPDX-License-Identifier: MIT
#include "editor_ui/document/object_rules.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

static bool finite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

static bool atLeastZero(float v) {
    return std::isfinite(v) && v >= 0;
}

static bool isLight(float v) {
    return v >= 0 && v <= kMaxLight;
}

static bool isLight(glm::vec3 v) {
    return isLight(v.x) && isLight(v.y) && isLight(v.z);
}

static bool inUnit(float v) {
    return v >= 0 && v <= 1;
}

static bool isUnit(float length) {
    return std::abs(length - 1) < 1e-3f;
}

static bool valid(const Node& n) {
    const Transform& t = n.transform;
    const glm::vec3 s = t.scale;
    return finite(t.translation) && finite(s) && s.x != 0 && s.y != 0 && s.z != 0 &&
           isUnit(glm::length(t.rotation)) && n.texelDensity >= kMinTexelDensity &&
           n.texelDensity <= kMaxTexelDensity;
}

static bool valid(const Flipbook& f) {
    const auto in = [](std::uint32_t frames) { return frames >= 1 && frames <= 256; };
    return in(f.columns) && in(f.rows) && f.framesPerSecond >= 0 && f.framesPerSecond <= 1000;
}

static bool valid(const Material& m) {
    const glm::vec4 c = m.baseColor;
    return inUnit(c.x) && inUnit(c.y) && inUnit(c.z) && inUnit(c.w) && inUnit(m.metallic) &&
           inUnit(m.roughness) && inUnit(m.alphaCutoff) && isLight(m.emission) &&
           inUnit(m.transmission) && std::isfinite(m.ior) && m.ior >= 1 &&
           atLeastZero(m.thickness) && valid(m.emissiveFlipbook) &&
           (m.emissiveTexture.rotation == 0 ||
            m.emissiveFlipbook.columns == m.emissiveFlipbook.rows);
}

static bool isLightSize(float edge) {
    return edge >= kMinLightSize && edge <= kMaxLightSize;
}

static bool valid(const Light& l) {
    return finite(l.position) && isUnit(glm::length(l.direction)) && isLight(l.color) &&
           isLight(l.strength) && atLeastZero(l.range) && l.innerAngle >= 0 &&
           l.innerAngle < l.outerAngle && l.outerAngle <= glm::half_pi<float>() + 1e-6f &&
           isLightSize(l.size.x) && isLightSize(l.size.y) && std::isfinite(l.roll) &&
           (!l.profile || profileDefect(*l.profile).empty());
}

static bool valid(const Camera& c) {
    return finite(c.eye) && finite(c.target) && c.eye != c.target && isUnit(glm::length(c.up)) &&
           c.fovY > 0 && c.fovY < glm::pi<float>();
}

static bool valid(const Sky& s) {
    return isLight(s.radiance) && isLight(s.horizon) && isLight(s.ground) && isLight(s.strength) &&
           std::isfinite(s.rotation);
}

static bool valid(const BakeSettings& b) {
    return settingsDefect(b).empty();
}

static bool valid(const TechniqueChoice& c) {
    return std::ranges::all_of(c.settings, [](const auto& s) { return std::isfinite(s.second); });
}

static bool valid(const RelightSettings& r) {
    return settingsDefect(r).empty();
}

static bool valid(const ExportSettings& e) {
    return settingsDefect(e).empty();
}

bool isValid(const Object& object) {
    return std::visit([](const auto& o) { return valid(o); }, object);
}

bool canDelete(const Object& object) {
    return std::holds_alternative<Node>(object) || std::holds_alternative<Light>(object) ||
           std::holds_alternative<Camera>(object);
}

std::string* nameOf(Object& object) {
    if (auto* n = std::get_if<Node>(&object))
        return &n->name;
    if (auto* m = std::get_if<Material>(&object))
        return &m->name;
    if (auto* l = std::get_if<Light>(&object))
        return &l->name;
    if (auto* c = std::get_if<Camera>(&object))
        return &c->name;
    return nullptr;
}

const char* lightKindName(LightKind kind) {
    switch (kind) {
    case LightKind::Directional:
        return "Sun light";
    case LightKind::Point:
        return "Point light";
    case LightKind::Spot:
        return "Spot light";
    case LightKind::Rectangle:
        return "Rectangle light";
    }
    return "Light";
}

const char* kindName(const Object& object) {
    if (const auto* n = std::get_if<Node>(&object))
        return n->meshes.empty() ? "Group" : n->dynamic ? "Dynamic object" : "Static object";
    if (const auto* l = std::get_if<Light>(&object))
        return lightKindName(l->kind);
    if (std::holds_alternative<Material>(object))
        return "Material";
    if (std::holds_alternative<Camera>(object))
        return "Camera";
    if (std::holds_alternative<Sky>(object))
        return "Sky";
    if (std::holds_alternative<TechniqueChoice>(object))
        return "Technique of bounced light";
    if (std::holds_alternative<RelightSettings>(object))
        return "Relighting";
    if (std::holds_alternative<ExportSettings>(object))
        return "Export";
    return "Bake settings";
}

} // namespace limn
