// SPDX-License-Identifier: MIT
#include "app/bench/measured_scene.h"

#include "app/bench/moving_lights.h"
#include "app/commands/progress_line.h"

#include <algorithm>
#include <filesystem>

namespace limn {

Result<MeasuredScene> openMeasured(const SceneOptions& options, const CameraOptions& camera,
                                   std::uint32_t samplesPerPixel, std::uint32_t points) {
    const Result<ImportedScene> imported = openScene(options);
    if (!imported)
        return tl::make_unexpected(imported.error());
    MeasuredScene m{.name = std::filesystem::path(options.scene).stem().string(),
                    .scene = flatten(imported->document, imported->assets)};
    const Result<Camera> from = chooseCamera(m.scene, camera);
    if (!from)
        return tl::make_unexpected(from.error());
    if (points > 0) {
        const SurfacePoints spread = spreadPoints(m.scene, points);
        if (spread.positions.empty())
            return fail("--lights: the scene has no static surfaces for lights to stand over");
        m.scene.lights = pointsOver(m.scene, spread.positions, spread.normals, points);
    }
    m.trace = std::make_unique<TraceScene>(m.scene);
    m.view = {.view = View::Irradiance,
              .camera = *from,
              .width = camera.width,
              .height = camera.height,
              .samplesPerPixel = std::max(samplesPerPixel / 4, 1U)};
    m.all = *renderReferenceSet(*m.trace, m.view, progressOnStderr()); // never cancelled
    ReferenceOptions once = m.view;
    once.maxBounces = 1;
    m.one = *renderReferenceSet(*m.trace, once, progressOnStderr());
    ReferenceOptions lit = m.view;
    lit.view = View::Lit;
    lit.samplesPerPixel = samplesPerPixel;
    m.lit = renderReference(*m.trace, lit, progressOnStderr()).image;
    std::vector<Motion> motions = {Motion::Lights, Motion::Camera};
    if (std::ranges::any_of(m.scene.instances, &Instance::dynamic))
        motions.push_back(Motion::Objects);
    for (const Motion motion : motions)
        m.motions.push_back(renderMotion(motion, *m.trace, m.view, m.all));
    endProgressLine();
    return m;
}

} // namespace limn
