// SPDX-License-Identifier: MIT
#include "app/commands/scene_options.h"
#include "app/resources.h"

#include "engine/core/log.h"
#include "engine/files/project_file.h"
#include "engine/files/sky_file.h"
#include "engine/gallery/coloured_street.h"
#include "engine/gallery/gallery.h"
#include "engine/scene/dynamic_spec.h"
#include "engine/scene/light/light_spec.h"
#include "engine/scene/origin.h"
#include "engine/scene/reach.h"
#include "engine/scene/sky_sun.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

namespace limn {

void addSceneOptions(Command& command, SceneOptions& options) {
    command
        .option("scene", options.scene,
                "Scene (.gltf, .glb), project (.limn), name of a sample project, or generated:SEED")
        .required();
    addLightOptions(command, options);
    addDynamicOption(command, options);
}

void addImportOptions(Command& command, ImportOptions& options) {
    command
        .numberOption(
            "--memory",
            [&options](double gib) {
                options.memory.maxBytes = std::uint64_t(gib * double(1 << 30));
            },
            "Maximum memory for scenes, pictures and bakes [GiB]; default: half of the machine's")
        .within(0.001, 1e6);
    command.flag(
        "--outside-files", [&options] { options.reach = FileReach::Anywhere; },
        "Allow a .gltf to name files outside its own folder");
}

void addDynamicOption(Command& command, SceneOptions& options) {
    command
        .option("--dynamic", options.dynamics,
                "Object that may move without a new bake, NAME or NAME@x,y,z to move it by "
                "x,y,z [m]: it is lit from the grid, casts shadows and sends no bounced "
                "light; may be repeated")
        .repeatable();
}

void addLightOptions(Command& command, SceneOptions& options) {
    command
        .option(
            "--light", options.lights,
            "Light to add: sun dir=x,y,z lux=E | point pos=x,y,z cd=I | spot pos= dir= cd= "
            "inner=DEG outer=DEG | rect pos= dir= size=w,h nits=L roll=DEG; each with "
            "color=r,g,b or kelvin=T and name= if wanted; strengths also as lm= (point, spot, "
            "rect), cd= (rect) and ev= (sun, rect); point and spot with ies=FILE dir= roll= for "
            "a photometric file; may be repeated")
        .repeatable();
    command.option("--sky", options.sky,
                   "Sky instead of the scene's: r,g,b [nits] | gradient up=r,g,b horizon=r,g,b "
                   "ground=r,g,b | FILE.hdr or FILE.exr, a panorama");
    command.option("--sky-strength", options.skyStrength, "Factor of the panorama's radiance")
        .within(0., double(kMaxLight));
    addImportOptions(command, options.import);
    command
        .option("--sky-rotation", options.skyRotation,
                "Rotation of the panorama about +Y, from +Z towards +X [degrees]")
        .within(-1e6, 1e6);
    command
        .option(
            "--sky-sun",
            [&options](const std::string& value) { options.extractsSun = value == "extract"; },
            "What becomes of a sun in the panorama: keep, or extract, which makes it a directional "
            "light with sharp shadows")
        .oneOf({"keep", "extract"});
}

void addTimeOption(Command& command, SceneOptions& options) {
    command
        .numberOption(
            "--time",
            [&options](double seconds) {
                options.seconds = seconds;
                options.import.seconds = seconds;
            },
            "Time at which animated textures, nodes, skins and lights are shown [s]; default: 0 "
            "for textures, and at rest for the others")
        .within(-1e6, 1e6);
}

void addTimeOption(Command& command, ImportOptions& options) {
    command
        .numberOption(
            "--time", [&options](double seconds) { options.seconds = seconds; },
            "Time at which animated nodes, skins and lights are read [s]; default: at rest")
        .within(-1e6, 1e6);
}

static Result<Sky> openSky(const std::string& spec, const MemoryBudget& memory) {
    if (!spec.ends_with(".hdr") && !spec.ends_with(".exr"))
        return parseSky(spec);
    Sky sky;
    sky.kind = SkyKind::Image;
    sky.image = spec;
    if (const Result<void> read = readSkyImage(sky, memory); !read)
        return tl::make_unexpected(read.error());
    return sky;
}

/// The document's sky, added if there is none.
static Sky& skyOf(Document& document) {
    for (auto& [id, object] : document.objects)
        if (Sky* known = std::get_if<Sky>(&object))
            return *known;
    return std::get<Sky>(document.objects.at(addObject(document, Sky{})));
}

static constexpr std::string_view kGenerated = "generated:", kStreet = "coloured-street";

static Result<ImportedScene> openGenerated(const std::string& name) {
    if (name.substr(kGenerated.size()) == kStreet)
        return importedScene(colouredStreet());
    std::uint64_t seed = 0;
    const char* const end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data() + kGenerated.size(), end, seed);
    if (error != std::errc() || rest != end)
        return fail(name + ": a generated scene is named by a seed, as in generated:17, or is "
                           "generated:coloured-street");
    return importedScene(generateScene(seed));
}

ImportedScene importedScene(const GeneratedScene& generated) {
    ImportedScene scene{generated.document, generated.assets, {}};
    if (generated.darkCamera)
        addObject(scene.document, *generated.darkCamera);
    return scene;
}

Result<ImportedScene> openScene(const SceneOptions& options) {
    for (const std::string& spec : options.lights) // a wrong flag should not cost an import
        if (const Result<Light> light = parseLight(spec); !light)
            return tl::make_unexpected(light.error());
    std::optional<Sky> sky;
    if (!options.sky.empty()) {
        const Result<Sky> parsed = openSky(options.sky, options.import.memory);
        if (!parsed)
            return tl::make_unexpected(parsed.error());
        sky = *parsed;
    }
    Result<ImportedScene> scene =
        options.scene.starts_with(kGenerated)
            ? openGenerated(options.scene)
            : openAny(options.scene, projectsFolder(), {}, options.import);
    if (!scene)
        return scene;
    for (const std::string& spec : options.lights)
        addObject(scene->document, *parseLight(spec, scene->document.origin));
    if (sky)
        skyOf(scene->document) = *sky;
    if (options.skyStrength)
        skyOf(scene->document).strength = *options.skyStrength;
    if (options.skyRotation)
        skyOf(scene->document).rotation = glm::radians(*options.skyRotation);
    if (options.extractsSun) {
        if (const std::optional<Light> sun = extractSun(skyOf(scene->document)))
            addObject(scene->document, *sun);
        else
            logWarning("--sky-sun: the sky has no sun to extract");
    }
    for (const std::string& spec : options.dynamics)
        if (const Result<void> made = makeDynamic(scene->document, spec); !made)
            return tl::make_unexpected(made.error());
    if (const std::string defect = reachDefect(flatten(scene->document, scene->assets));
        !defect.empty())
        return fail(fmt::format("{}: {}", options.scene, defect));
    for (const std::string& repair : scene->repairs)
        logWarning(fmt::format("{}: {}", options.scene, repair));
    return scene;
}

void addViewOptions(Command& command, CameraOptions& options) {
    Option name = command.option("--camera", options.name, "Name of the scene's camera to use");
    Option eye = command.option("--eye", options.eye, "Position of the camera, x,y,z [m]").list(3);
    Option target =
        command.option("--target", options.target, "Point that the camera looks at, x,y,z [m]")
            .list(3);
    eye.needs(target).excludes(name);
    target.needs(eye);
    command.option("--fov", options.fovDegrees, "Vertical field of view [degrees]")
        .within(0.1, 179.0);
}

void addCameraOptions(Command& command, CameraOptions& options) {
    addViewOptions(command, options);
    command.option("--width", options.width, "Width of the picture [pixels]").within(1, 16384);
    command.option("--height", options.height, "Height of the picture [pixels]").within(1, 16384);
}

Result<Camera> chooseCamera(const Scene& scene, const CameraOptions& options) {
    if (options.name && std::ranges::none_of(scene.cameras, [&](const Camera& c) {
            return c.name == *options.name;
        })) {
        std::string names;
        for (const Camera& c : scene.cameras)
            names += (names.empty() ? "" : ", ") + c.name;
        return fail(fmt::format("--camera: there is no '{}'; there is: {}", *options.name,
                                names.empty() ? "none" : names));
    }
    Camera camera = chooseCamera(scene, options.name);
    if (options.eye.size() == 3 && options.target.size() == 3) {
        camera = Camera{};
        const glm::dvec3 eye(options.eye[0], options.eye[1], options.eye[2]);
        const glm::dvec3 target(options.target[0], options.target[1], options.target[2]);
        camera.eye = toWorld(scene.origin, eye);
        camera.target = toWorld(scene.origin, target);
        if (!withinReach(glm::vec3(eye)) || !withinReach(glm::vec3(target)))
            return fail(
                fmt::format("--eye, --target: beyond {:g} m of the origin", kMaxCoordinate));
        if (camera.eye == camera.target)
            return fail("--target: may not be the eye");
    }
    if (options.fovDegrees)
        camera.fovY = glm::radians(*options.fovDegrees);
    return camera;
}

std::string projectsFolder() {
    const char* folder = std::getenv("LIMN_PROJECTS");
    return folder && *folder ? folder : dataFolder("projects");
}

} // namespace limn
