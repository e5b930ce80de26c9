// SPDX-License-Identifier: MIT
#pragma once

#include "engine/files/light_fields.h"
#include "engine/files/material_fields.h"
#include "engine/scene/bake_settings_fields.h"
#include "engine/scene/document.h"
#include "engine/scene/export_settings_fields.h"

#include <span>
#include <string_view>

namespace limn {

// Lists the fields of every object, once for both reading and writing: fields(name, value [, range
// or names]). fields.place() is for world positions, which files store in the scene file's
// coordinates.

template <class Fields, class T>
void describeTransform(Fields& fields, T& t) {
    fields("translation", t.translation);
    fields("rotation", t.rotation); // x, y, z, w as in glTF
    fields("scale", t.scale);
}

template <class Fields, class T>
void describeNode(Fields& fields, T& n) {
    fields("name", n.name);
    fields("parent", n.parent);
    fields.object("transform", n.transform, [](auto& f, auto& t) { describeTransform(f, t); });
    fields("meshes", n.meshes);
    fields.unlessEmpty("materials", n.materials);
    fields("visible", n.visible);
    fields("dynamic", n.dynamic);
    fields.unless(1.f, "texelDensity", n.texelDensity,
                  FieldRange{double(kMinTexelDensity), double(kMaxTexelDensity)});
}

template <class Fields, class T>
void describeAssetFile(Fields& fields, T& f) {
    fields("path", f.path);
    fields("firstMesh", f.firstMesh);
    fields("firstImage", f.firstImage);
}

template <class Fields, class T>
void describeCamera(Fields& fields, T& c) {
    fields("name", c.name);
    fields.place("eye", c.eye);
    fields.place("target", c.target);
    fields("up", c.up);
    fields("fovY", c.fovY, FieldRange{1e-3, 3.14});
}

template <class Fields, class T>
void describeSky(Fields& fields, T& s) {
    fields("kind", s.kind, kSkyNames);
    fields("radiance", s.radiance, kLightRange);
    fields("horizon", s.horizon, kLightRange);
    fields("ground", s.ground, kLightRange);
    fields("image", s.image);
    fields("strength", s.strength, kLightRange);
    fields("rotation", s.rotation);
}

inline FieldRange fieldLimits(const SettingRange& range) {
    return {range.lower, range.upper};
}
inline std::span<const std::string_view> fieldLimits(const SettingChoices& choices) {
    return choices.names;
}

template <class Fields, class T>
void describeBakeSettings(Fields& fields, T& b) {
    visitBakeSettings(b, [&](const Setting& setting, auto& value, const auto&... limits) {
        fields(setting.key, value, fieldLimits(limits)...);
    });
}

template <class Fields, class T>
void describeTechniqueChoice(Fields& fields, T& t) {
    fields("name", t.technique);
    fields("settings", t.settings);
}

template <class Fields, class T>
void describeRelightSettings(Fields& fields, T& r) {
    visitRelightSettings(r, [&](const Setting& setting, auto& value, const auto&... limits) {
        fields(setting.key, value, fieldLimits(limits)...);
    });
}

template <class Fields, class T>
void describeExportSettings(Fields& fields, T& e) {
    fields("format", e.format);
    visitExportSettings(e, [&](const Setting& setting, auto& value, const auto&... limits) {
        fields(setting.key, value, fieldLimits(limits)...);
    });
}

/// Calls use(name, object, describe) with the name that files use for the object's kind.
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
            else if constexpr (std::is_same_v<T, BakeSettings>)
                use("bakeSettings", o, [](auto& f, auto& b) { describeBakeSettings(f, b); });
            else if constexpr (std::is_same_v<T, TechniqueChoice>)
                use("technique", o, [](auto& f, auto& t) { describeTechniqueChoice(f, t); });
            else if constexpr (std::is_same_v<T, RelightSettings>)
                use("relighting", o, [](auto& f, auto& r) { describeRelightSettings(f, r); });
            else
                use("export", o, [](auto& f, auto& e) { describeExportSettings(f, e); });
        },
        object);
}

} // namespace limn
