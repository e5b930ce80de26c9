// SPDX-License-Identifier: MIT
#pragma once

#include "engine/files/enum_names.h"
#include "engine/scene/light/light.h"
#include "engine/scene/surface/material.h"

#include <limits>

namespace limn {

/// Range of a number in a file. Every number must also be finite.
struct FieldRange {
    double lower = std::numeric_limits<double>::lowest();
    double upper = std::numeric_limits<double>::max();
};
inline constexpr FieldRange kNotNegative{0};
inline constexpr FieldRange kLightRange{0, kMaxLight};
inline constexpr FieldRange kUnitRange{0, 1};
inline constexpr FieldRange kFlipbookFrames{1, 256};

// Lists the fields of materials; document_fields.h lists those of other objects.

template <class Fields, class T>
void describeTexture(Fields& fields, T& t) {
    fields("image", t.image, FieldRange{-1});
    fields("texCoord", t.texCoord, FieldRange{0, kMaxUvSets - 1});
    fields("offset", t.offset);
    fields("scale", t.scale);
    fields("rotation", t.rotation);
    fields("wrapU", t.wrapU, kWrapNames);
    fields("wrapV", t.wrapV, kWrapNames);
    fields("nearest", t.nearest);
}

template <class Fields, class T>
void describeFlipbook(Fields& fields, T& f) {
    fields("columns", f.columns, kFlipbookFrames);
    fields("rows", f.rows, kFlipbookFrames);
    fields("framesPerSecond", f.framesPerSecond, FieldRange{0, 1000});
}

template <class Fields, class T>
void describeMaterial(Fields& fields, T& m) {
    const auto texture = [](auto& f, auto& t) { describeTexture(f, t); };
    fields("name", m.name);
    fields("baseColor", m.baseColor, kUnitRange);
    fields("metallic", m.metallic, kUnitRange);
    fields("roughness", m.roughness, kUnitRange);
    fields("emission", m.emission, kLightRange);
    fields("alphaMode", m.alphaMode, kAlphaNames);
    fields("alphaCutoff", m.alphaCutoff, kNotNegative);
    fields("doubleSided", m.doubleSided);
    fields("normalScale", m.normalScale);
    fields.unless(0.f, "transmission", m.transmission, kUnitRange);
    fields.unless(1.5f, "ior", m.ior, FieldRange{1});
    fields.unless(0.f, "thickness", m.thickness, kNotNegative);
    fields.object("baseColorTexture", m.baseColorTexture, texture);
    fields.object("metallicRoughnessTexture", m.metallicRoughnessTexture, texture);
    fields.object("normalTexture", m.normalTexture, texture);
    fields.object("emissiveTexture", m.emissiveTexture, texture);
    fields.object("emissiveFilm", m.emissiveFlipbook,
                  [](auto& f, auto& flipbook) { describeFlipbook(f, flipbook); });
}

} // namespace limn
