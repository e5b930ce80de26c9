// SPDX-License-Identifier: MIT
#include "app/bench/leak_room.h"

#include "engine/gallery/gallery.h"
#include "engine/lightmap/atlas.h"
#include "engine/measure/compare.h"
#include "engine/reference/reference.h"

namespace limn {

namespace {

constexpr std::uint64_t kSeed = 1;
constexpr std::uint32_t kWidth = 80, kHeight = 45;

} // namespace

LeakRoom::LeakRoom(std::uint32_t samplesPerPixel) {
    const GeneratedScene generated = generateScene(SceneKind::TwoRooms, kSeed);
    m_description = generated.description;
    m_scene = flatten(generated.document, generated.assets);
    m_trace = std::make_unique<TraceScene>(m_scene);
    m_dark = *generated.darkCamera; // scenes of this kind have one
    m_outside = meanOf(renderReference(*m_trace, {.view = View::Irradiance,
                                                  .camera = m_scene.cameras.front(),
                                                  .width = kWidth,
                                                  .height = kHeight,
                                                  .samplesPerPixel = samplesPerPixel})
                           .image);
}

Result<double> LeakRoom::leak(const LightPlace& place, const Technique& technique,
                              const TechniqueChoice& choice, const BakeSettings& bake,
                              const Progress& progress) const {
    Scene scene = m_scene;
    scene.technique = choice;
    const Result<PreparedScene> made = prepareScene(technique, *m_trace, scene, bake, progress);
    if (!made)
        return tl::make_unexpected(made.error());
    const auto lighting = place.light(technique, made->prepared, scene, made->layout);
    if (!lighting)
        return tl::make_unexpected(lighting.error());
    const Viewpoint view = viewpointOf(m_dark, {kWidth, kHeight});
    (*lighting)->update({.scene = scene,
                         .trace = m_trace.get(),
                         .bounces = scene.relight.maxBounces,
                         .view = viewForAll(**lighting, view)},
                        {});
    return meanOf(renderLight(
               *m_trace, **lighting, *made->layout,
               {.view = View::Irradiance, .camera = m_dark, .width = kWidth, .height = kHeight})) /
           m_outside;
}

} // namespace limn
