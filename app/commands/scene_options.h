// SPDX-License-Identifier: MIT
#pragma once

#include "app/commands/command_line.h"
#include "engine/core/result.h"
#include "engine/gltf/gltf_import.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace limn {

struct GeneratedScene;

/// SCENE|PROJECT and the flags that bake, render and reference share for lights, sky and objects.
struct SceneOptions {
    std::string scene;
    std::vector<std::string> lights;
    std::string sky;
    std::optional<float> skyStrength, skyRotation; ///< factor, degrees
    bool extractsSun = false;                      ///< makes the panorama's sun a light
    double seconds = 0;                            ///< since the start of animated textures
    std::vector<std::string> dynamics;
    ImportOptions import;
};
void addSceneOptions(Command& command, SceneOptions& options);

/// Adds all flags except the scene.
void addLightOptions(Command& command, SceneOptions& options);

void addDynamicOption(Command& command, SceneOptions& options);

/// Adds --memory and --outside-files.
void addImportOptions(Command& command, ImportOptions& options);

/// Adds --time, for animated textures as well as for what the file animates.
void addTimeOption(Command& command, SceneOptions& options);
/// The same where textures have a time of their own.
void addTimeOption(Command& command, ImportOptions& options);

/// The generated scene as if it had been imported. The dark room's camera is the second one.
ImportedScene importedScene(const GeneratedScene& generated);

/// Imports the scene, or generates one named generated:SEED. Adds the lights and the sky and logs
/// the repairs.
Result<ImportedScene> openScene(const SceneOptions& options);

struct CameraOptions {
    std::optional<std::string> name;
    std::vector<double> eye, target; ///< x,y,z in the file's coordinates [m]
    std::optional<float> fovDegrees; ///< vertical
    std::uint32_t width = 1280, height = 720;
};
void addCameraOptions(Command& command, CameraOptions& options);
void addViewOptions(Command& command, CameraOptions& options); ///< all but the picture's size

/// Fails when the named camera does not exist.
Result<Camera> chooseCamera(const Scene& scene, const CameraOptions& options);

/// The folder of sample projects: $LIMN_PROJECTS, else beside the executable's source tree.
std::string projectsFolder();

} // namespace limn
