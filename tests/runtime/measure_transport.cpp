// SPDX-License-Identifier: MIT
// measure_transport SCENE BAKE [OUT.limnrt]: what a transport file takes and how close its light
// is. Prints a line with the file's bytes, the time to open it and the time of a bounce, beside the
// Relighter's on one thread in the same minute, and one with the errors for each of three
// lightings: of the surfels, of the lightmap and of a picture by `limn render --device cpu`.
#include "engine/core/parallel.h"
#include "engine/core/replace_file.h"
#include "engine/files/project_file.h"
#include "engine/measure/compare.h"
#include "engine/picture/field_render.h"
#include "engine/techniques/illuminance/format/bake_file.h"
#include "engine/trace/trace_scene.h"
#include "tests/core/source_path.h"
#include "tests/runtime/open_file.h"

#include <algorithm>
#include <ctime>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {
namespace {

/// Of this thread's own work, which other programs do not lengthen.
double milliseconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
}
double median(std::vector<double> v) {
    std::ranges::sort(v);
    return v.at(v.size() / 2);
}

void setLights(limnrt_scene* file, const std::vector<Light>& lights) {
    std::vector<limnrt_light> out;
    for (const Light& light : lights)
        out.push_back(runtimeLight(light));
    limnrt_set_lights(file, out.data(), std::uint32_t(out.size()));
}

/// Lightings that the file did not begin with, by the size of the scene.
std::vector<std::vector<Light>> lightings(const Scene& scene) {
    const Bounds b = staticBounds(scene);
    const float size = glm::length(b.size());
    Light point, spot, rectangle;
    point.position = b.centre() + b.size() * glm::vec3(0.05f, 0.12f, 0.08f);
    point.color = {0.3f, 0.5f, 1};
    point.strength = size * size;
    spot.kind = LightKind::Spot;
    spot.position = b.centre() + b.size() * glm::vec3(-0.1f, 0.2f, 0.05f);
    spot.direction = glm::normalize(glm::vec3(0.4f, -1, 0.3f));
    spot.color = {1, 0.9f, 0.7f};
    spot.strength = 2 * size * size;
    rectangle.kind = LightKind::Rectangle;
    rectangle.position = b.centre() + b.size() * glm::vec3(0.05f, 0.15f, 0.1f);
    rectangle.direction = glm::normalize(glm::vec3(-0.2f, -1, 0.1f));
    rectangle.size = glm::vec2(size / 12);
    rectangle.strength = 100;
    return {{point}, {spot}, {rectangle, point}};
}

struct Times {
    std::vector<double> bounce, moved, relighter;
};

/// A bounce with all results, by turns; then with a moved light.
Times timesOf(limnrt_scene* file, Relighter& relighter, Scene scene, const TraceScene& trace) {
    limnrt_counts counts;
    limnrt_get_counts(file, &counts);
    std::vector<float> rgba(std::size_t(4) * counts.lightmap_width * counts.lightmap_height *
                            counts.bands * counts.bands);
    scene.lights = lightings(scene)[0];
    setLights(file, scene.lights);
    relighter.relight(scene, trace, 1000);
    Times times;
    for (int k = 0; k < 31; ++k) {
        scene.lights[0].position.x += 1e-3f;
        const double start = milliseconds();
        setLights(file, scene.lights);
        const double moved = milliseconds();
        limnrt_step(file);
        limnrt_lightmap_sh(file, rgba.data());
        times.moved.push_back(moved - start);
        times.bounce.push_back(milliseconds() - moved);
        // Its direct light is taken by a call without bounces.
        relighter.relight(scene, trace, 0);
        const double direct = milliseconds();
        relighter.relight(scene, trace, 1);
        times.relighter.push_back(milliseconds() - direct);
    }
    return times;
}

/// The scene's first camera, or one in its middle that looks along its longest side.
Camera cameraOf(const Scene& scene) {
    if (!scene.cameras.empty())
        return scene.cameras.front();
    const Bounds b = staticBounds(scene);
    const glm::vec3 along =
        b.size().x > b.size().z ? glm::vec3(b.size().x, 0, 0) : glm::vec3(0, 0, b.size().z);
    Camera camera;
    camera.eye = b.centre() - 0.3f * along;
    camera.target = b.centre() + 0.2f * along - glm::vec3(0, 0.2f * b.size().y, 0);
    return camera;
}

/// Irradiance of bounced light, as `limn render --device cpu` shows it.
ImageF pictureOf(const TraceScene& trace, const IndirectField& field, const Bake& bake) {
    FieldRenderOptions options;
    options.view = View::Irradiance;
    options.camera = cameraOf(trace.scene());
    options.width = 512;
    options.height = 384;
    options.samplesPerPixel = 4;
    return renderField(trace, field, bake.lightmap, options);
}

void printErrors(limnrt_scene* file, const std::shared_ptr<const Bake>& bake, Scene scene,
                 const TraceScene& trace) {
    int number = 0;
    for (const std::vector<Light>& lights : lightings(scene)) {
        scene.lights = lights;
        Relighter relighter(bake, LitBands::All);
        relighter.relight(scene, trace, 1000);
        setLights(file, lights);
        limnrt_reset(file);
        std::uint32_t bounces = 0; // one by one, which end where the Relighter's do
        for (; bounces < 1000 && limnrt_converged(file) == 0; ++bounces)
            limnrt_step(file);
        const IndirectField& field = relighter.field();
        std::vector<float> rgba(4 * field.lightmap.size());
        limnrt_lightmap_sh(file, rgba.data());
        IndirectField read = field;
        std::memcpy(read.lightmap.data(), rgba.data(), rgba.size() * sizeof(float));
        const ImageF picture = pictureOf(trace, read, *bake);
        const Result<Comparison> compared = compareImages(picture, pictureOf(trace, field, *bake));
        fmt::print("lighting {}: {} bounces, nRMSE of radiosity {:.2e}, of the lightmap {:.2e}, of "
                   "a picture {:.2e}\n",
                   ++number, bounces,
                   nrmse(limnrt_radiosity(file), relighter.radiosity().data(),
                         relighter.radiosity().size()),
                   nrmse(rgba.data(), field.lightmap.data(), field.lightmap.size()),
                   compared ? compared->nrmse : 1);
    }
}

int measure(int count, char** arguments) {
    const Result<ImportedScene> imported = openAny(arguments[1], sourcePath("projects"));
    Result<Bake> read = readBake(arguments[2]);
    if (!imported || !read) {
        fmt::print(stderr, "{}\n", imported ? read.error().message : imported.error().message);
        return 1;
    }
    const auto bake = std::make_shared<const Bake>(std::move(*read));
    Scene scene = flatten(imported->document, imported->assets);
    scene.bake = bake->settings;
    const TraceScene trace(scene);
    const double start = milliseconds();
    const Result<std::string> bytes = transportFile({*bake, scene, nullptr, "measure_transport"});
    if (!bytes) {
        fmt::print(stderr, "{}\n", bytes.error().message);
        return 1;
    }
    const double written = milliseconds() - start;
    if (count > 3)
        if (const Result<void> saved = replaceFile(arguments[3], *bytes); !saved)
            return 1;
    const double before = milliseconds();
    const OpenFile file(*bytes);
    const double opened = milliseconds() - before;
    if (!file) {
        fmt::print(stderr, "{}\n", file.message);
        return 1;
    }
    const ThreadLimit one(1);
    Relighter relighter(bake, LitBands::All);
    const Times times = timesOf(file, relighter, scene, trace);
    const double bounce = median(times.bounce), theirs = median(times.relighter);
    fmt::print("{} bytes, {} surfels, {} links; made in {:.0f} ms, opened in {:.1f} ms with {} "
               "bytes of memory; bounce and lightmap {:.2f} ms, Relighter {:.2f} ms, ratio {:.2f}; "
               "moved light {:.2f} ms\n",
               bytes->size(), file.counts().surfels, file.counts().links, written, opened,
               file.counts().memory, bounce, theirs, bounce / theirs, median(times.moved));
    printErrors(file, bake, scene, trace);
    return 0;
}

} // namespace
} // namespace limn

int main(int count, char** arguments) {
    if (count < 3) {
        fmt::print(stderr, "usage: measure_transport SCENE BAKE [OUT.limnrt]\n");
        return 2;
    }
    return limn::measure(count, arguments);
}
