// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/mesh.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace limn {

/// Shapes that can be added to a scene without a file.
enum class Shape : std::uint8_t { Plane, Box, Sphere, Cylinder };

inline constexpr std::array<Shape, 4> kShapes = {Shape::Plane, Shape::Box, Shape::Sphere,
                                                 Shape::Cylinder};

/// "Plane", "Box", "Sphere" or "Cylinder"
const char* shapeName(Shape shape);

/// How AssetFile::path names the shape: "shape:box".
std::string shapePath(Shape shape);

/// The shape that AssetFile::path names; std::nullopt for a file.
std::optional<Shape> shapeOfPath(std::string_view path);

/// A shape 1 m wide, deep and high, which stands on the plane y = 0 with its axis on +Y; the plane
/// lies there and faces +Y. Smooth normals on what is round, TEXCOORD_0 on [0, 1] of every face.
Mesh shapeMesh(Shape shape);

} // namespace limn
