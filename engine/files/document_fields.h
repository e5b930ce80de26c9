// SPDX-License-Identifier: MIT
#pragma once

#include "engine/files/enum_names.h"
#include "engine/scene/document.h"

#include <limits>
#include <string_view>

#include <glm/gtc/constants.hpp>

namespace limn {

/// What a number may be. Every number must be finite besides.
struct FieldRange {
    double lower = std::numeric_limits<double>::lowest();
    double upper = std::numeric_limits<double>::max();
};
inline constexpr FieldRange kNotNegative{0};
inline constexpr FieldRange kUnitRange{0, 1};
inline constexpr FieldRange kFilmFrames{1, 256};

// The fields of every object, once for reading and writing: fields(name, value [, range or names]).

template <class Fields, class T>
void describeTransform(Fields& fields, T& t) {
    fields("translation", t.translation);
    fields("rotation", t.rotation); // x, y, z, w as in glTF
    fields("scale", t.scale);
}

template <class Fields, class T>
void describeTexture(Fields& fields, T& t) {
    fields("image", t.image, FieldRange{-1});
    fields("texCoord", t.texCoord, kUnitRange);
    fields("offset", t.offset);
    fields("scale", t.scale);
    fields("rotation", t.rotation);
    fields("wrapU", t.wrapU, kWrapNames);
    fields("wrapV", t.wrapV, kWrapNames);
    fields("nearest", t.nearest);
}

template <class Fields, class T>
void describeNode(Fields& fields, T& n) {
    fields("name", n.name);
    fields("parent", n.parent);
    fields.object("transform", n.transform, [](auto& f, auto& t) { describeTransform(f, t); });
    fields("meshes", n.meshes);
    fields("visible", n.visible);
    fields("dynamic", n.dynamic);
}

template <class Fields, class T>
void describeFilm(Fields& fields, T& f) {
    fields("columns", f.columns, kFilmFrames);
    fields("rows", f.rows, kFilmFrames);
    fields("framesPerSecond", f.framesPerSecond, FieldRange{0, 1000});
}

template <class Fields, class T>
void describeMaterial(Fields& fields, T& m) {
    const auto texture = [](auto& f, auto& t) { describeTexture(f, t); };
    fields("name", m.name);
    fields("baseColor", m.baseColor, kUnitRange);
    fields("metallic", m.metallic, kUnitRange);
    fields("roughness", m.roughness, kUnitRange);
    fields("emission", m.emission, kNotNegative);
    fields("alphaMode", m.alphaMode, kAlphaNames);
    fields("alphaCutoff", m.alphaCutoff, kNotNegative);
    fields("doubleSided", m.doubleSided);
    fields("normalScale", m.normalScale);
    fields.object("baseColorTexture", m.baseColorTexture, texture);
    fields.object("metallicRoughnessTexture", m.metallicRoughnessTexture, texture);
    fields.object("normalTexture", m.normalTexture, texture);
    fields.object("emissiveTexture", m.emissiveTexture, texture);
    fields.object("emissiveFilm", m.emissiveFilm,
                  [](auto& f, auto& film) { describeFilm(f, film); });
}

template <class Fields, class T>
void describeLight(Fields& fields, T& l) {
    fields("name", l.name);
    fields("kind", l.kind, kLightNames);
    fields("enabled", l.enabled);
    fields("position", l.position);
    fields("direction", l.direction);
    fields("color", l.color, kNotNegative);
    fields("strength", l.strength, kNotNegative);
    fields("range", l.range, kNotNegative);
    fields("innerAngle", l.innerAngle, FieldRange{0, glm::half_pi<double>()});
    // One float above pi/2 is as near as floats come to it.
    fields("outerAngle", l.outerAngle, FieldRange{0, double(glm::half_pi<float>())});
    fields("size", l.size, FieldRange{kMinLightSize, kMaxLightSize});
    fields("roll", l.roll);
}

template <class Fields, class T>
void describeCamera(Fields& fields, T& c) {
    fields("name", c.name);
    fields("eye", c.eye);
    fields("target", c.target);
    fields("up", c.up);
    fields("fovY", c.fovY, FieldRange{1e-3, 3.14});
}

template <class Fields, class T>
void describeSky(Fields& fields, T& s) {
    fields("kind", s.kind, kSkyNames);
    fields("radiance", s.radiance, kNotNegative);
    fields("horizon", s.horizon, kNotNegative);
    fields("ground", s.ground, kNotNegative);
    fields("image", s.image);
    fields("strength", s.strength, kNotNegative);
    fields("rotation", s.rotation);
}

template <class Fields, class T>
void describeBakeSettings(Fields& fields, T& b) {
    fields("surfels", b.surfels, FieldRange{64, 1 << 20});
    fields("links", b.links, FieldRange{1, 4096});
    fields("bands", b.bands, FieldRange{2, 8});
    fields("rays", b.rays, FieldRange{16, 65536});
    fields("lightmapCaches", b.lightmapCaches);
    fields("texelsPerMetre", b.texelsPerMetre, kNotNegative);
    fields("grid", b.grid);
    fields("maxBounces", b.maxBounces);
    fields("dimming", b.dimming);
    fields("placement", b.placement, kPlacementNames);
    fields("linker", b.linker, kLinkerNames);
    fields("cut", b.cut, kCutNames);
    fields("storage", b.storage, kStorageNames);
    fields("chromaBands", b.chromaBands, FieldRange{0, 8});
    fields("clustering", b.clustering, kClusteringNames);
    fields("clusterNormalWeight", b.clusterNormalWeight, FieldRange{0, 100});
    fields("clusterBalanceWeight", b.clusterBalanceWeight, FieldRange{0, 100});
}

/// Calls use(name, object, describe) with the kind's name in files.
template <class Use>
void describeObject(const Object& object, const Use& use) {
    std::visit(
        [&](const auto& o) {
            using T = std::decay_t<decltype(o)>;
            if constexpr (std::is_same_v<T, Node>)
                use("node", o, [](auto& f, auto& n) { describeNode(f, n); });
            else if constexpr (std::is_same_v<T, Material>)
                use("material", o, [](auto& f, auto& m) { describeMaterial(f, m); });
            else if constexpr (std::is_same_v<T, Light>)
                use("light", o, [](auto& f, auto& l) { describeLight(f, l); });
            else if constexpr (std::is_same_v<T, Camera>)
                use("camera", o, [](auto& f, auto& c) { describeCamera(f, c); });
            else if constexpr (std::is_same_v<T, Sky>)
                use("sky", o, [](auto& f, auto& s) { describeSky(f, s); });
            else
                use("bakeSettings", o, [](auto& f, auto& b) { describeBakeSettings(f, b); });
        },
        object);
}

} // namespace limn
