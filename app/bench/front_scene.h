// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/scene_options.h"

#include "engine/core/progress.h"
#include "engine/measure/reference_set.h"
#include "engine/reference/reference.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace limn {

/// How scenes of `limn bench front` are looked at.
struct FrontView {
    CameraOptions camera{.width = 320, .height = 180};
    std::uint32_t samplesPerPixel = 64; ///< of each of a scene's two references
    /// Roughness of the metal that half of each surface becomes, [0, 1]; none: they stay as they
    /// are, and errors are those of irradiance. Else they are those of the lit picture.
    std::optional<float> glossy;
};

/// A scene of `limn bench front` with its reference.
struct FrontScene {
    std::string name; ///< of its file
    std::string key;  ///< holds all that its reference depends on
    Scene scene;
    std::unique_ptr<TraceScene> trace; ///< of `scene`
    ReferenceOptions view;
    ReferenceSet truth;
};

/// Opens a scene and renders its reference, or reads it from `folder`, where it is kept. Fails as
/// openScene() and chooseCamera(), where the camera sees no light, and where the folder cannot be
/// written.
Result<FrontScene> openFrontScene(const SceneOptions& options, const FrontView& view,
                                  const std::string& folder, const Progress& progress);

} // namespace limn
