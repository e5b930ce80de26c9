// SPDX-License-Identifier: MIT
#include "app/techniques/photon_lattices/photon_program.h"

#include "app/bench/bench.h"
#include "app/commands/scene_options.h"

#include "engine/core/stopwatch.h"
#include "engine/field/sample_field.h"
#include "engine/lightmap/atlas.h"
#include "engine/techniques/lpv/blockers.h"
#include "engine/techniques/lpv/lpv.h"
#include "engine/techniques/photon_lattices/photon_injection.h"
#include "engine/techniques/photon_lattices/photon_lattices.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace limn {

namespace {

struct PhotonBench {
    SceneOptions scene;
    std::string output;
    std::uint32_t photons = 20000;
    int runs = 5;
    bool json = false;
};

constexpr Column kPhotonColumns[] = {{"scene", -14, "name"},
                                     {"technique", -36, "technique"},
                                     {"areas ms", 9, "areas_ms"},
                                     {"photons ms", 10, "photons_ms"},
                                     {"inject. ms", 10, "injection_ms"},
                                     {"lattices ms", 11, "field_ms"},
                                     {"update ms", 10, "update_ms"},
                                     {"lookup ns", 10, "lookup_ns", 1},
                                     {"jump [%]", 9, "jump", 2, 100}};

/// Two close points of a plane in different cells of the middle lattice.
struct Crossing {
    glm::vec3 from, to, normal;
};

/// Points in the middles of pieces of all surfaces, and pairs of points across faces of cells.
struct CellPoints {
    std::vector<SurfacePiece> pieces;
    std::vector<Crossing> crossings;
};

CellPoints cellPoints(const Scene& scene, const TraceScene& trace) {
    constexpr float kPiece = 1 / 12.f, kStep = 1 / 50.f; // over a cell's side
    const Lattice lattice = latticeOver(scene.bounds, 8);
    CellPoints points{surfacePieces(scene, kPiece * lattice.cell), {}};
    for (const SurfacePiece& piece : points.pieces) {
        const glm::vec3 n = piece.normal;
        const glm::vec3 side = glm::normalize(
            glm::cross(n, std::abs(n.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0)));
        for (const glm::vec3 along : {side, glm::cross(n, side)}) {
            const glm::vec3 to = piece.position + along * (kStep * lattice.cell);
            const Hit hit = trace.closestHit({trace.clearOf(to, 64.f * n), -n});
            if (hit && hit.instance == piece.instance && glm::distance(hit.position, to) < 1e-3f &&
                cellOf(lattice, piece.position, n) != cellOf(lattice, to, n))
                points.crossings.push_back({piece.position, to, n});
        }
    }
    return points;
}

/// A technique with its settings, by their keys without its name.
struct PhotonVariant {
    const Technique* technique;
    std::map<std::string, double> settings;
};

std::vector<PhotonVariant> photonVariants() {
    std::vector<PhotonVariant> all;
    for (const double lookup : {0., 1.})
        for (const double blur : {0., 1., 2., 3., 4., 5.})
            all.push_back({&kPhotonTechnique, {{"blur", blur}, {"lookup", lookup}}});
    all.push_back({&kPhotonTechnique, {{"high", 8}}});
    all.push_back({&kPhotonTechnique, {{"splat", 2}}});
    all.push_back({&kLpvTechnique, {}});
    return all;
}

std::string variantName(const PhotonVariant& variant) {
    std::string name = variant.technique->name;
    for (const auto& [key, value] : variant.settings)
        name += fmt::format(" {} {:g}", key, value);
    return name;
}

double medianOf(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

/// Measures a variant; the steps' times are the first update's for areas, else medians of updates
/// after all lights moved. `moves`: number of moves so far.
Json measureVariant(const PhotonBench& o, const PhotonVariant& variant, Scene scene,
                    const TraceScene& trace, const CellPoints& points, Lighting& lighting,
                    std::uint32_t& moves) {
    const std::string prefix = std::string(variant.technique->name) + ".";
    scene.technique = {variant.technique->name, {}};
    for (const auto& [key, value] : variant.settings)
        scene.technique.settings[prefix + key] = value;
    if (variant.technique == &kPhotonTechnique)
        scene.technique.settings[prefix + "photons"] = o.photons;
    const std::vector<Light> before = scene.lights;
    std::map<std::string, std::vector<double>> ms;
    for (int run = 0; run < o.runs; ++run) {
        ++moves;
        for (std::size_t i = 0; i < scene.lights.size(); ++i) // other lights, seen alike
            scene.lights[i].position =
                before[i].position + float(moves) * glm::vec3(1e-4f, -1e-4f, 0);
        const LightingReport report = lighting.update({.scene = scene, .trace = &trace}, {});
        ms["update"].push_back(report.totalMs);
        for (const LightingStep& step : report.steps)
            ms[step.id].push_back(step.ms);
    }
    const LightmapLayout layout = layoutWithoutLightmap(scene);
    const auto irradiance = [&](glm::vec3 p, glm::vec3 n) {
        const glm::vec3 e = sampleIrradiance({*lighting.field(), layout, scene, 0, 0, 0, 0, p, n});
        return double(e.x + e.y + e.z);
    };
    double jump = 0, sum = 0;
    for (const Crossing& c : points.crossings) {
        const double a = irradiance(c.from, c.normal), b = irradiance(c.to, c.normal);
        jump += std::abs(a - b);
        sum += (a + b) / 2;
    }
    std::vector<double> ns;
    double total = 0;
    for (int run = 0; run < o.runs; ++run) {
        Stopwatch clock;
        for (const SurfacePiece& piece : points.pieces)
            total += irradiance(piece.position, piece.normal);
        ns.push_back(1e6 * clock.lap() / double(std::max<std::size_t>(points.pieces.size(), 1)));
    }
    const auto step = [&](const char* id) {
        return ms.contains(id) ? Json(medianOf(ms[id])) : Json();
    };
    return {
        {"technique", variantName(variant)},
        {"areas_ms", ms.contains("areas") ? Json(ms["areas"][0]) : Json()},
        {"photons_ms", step("photons")},
        {"injection_ms", step("injection")},
        {"field_ms", ms.contains("areas") ? step("field") : Json()},
        {"update_ms", medianOf(ms["update"])},
        {"lookup_ns", *std::ranges::min_element(ns)},
        {"jump", sum > 0 ? jump / sum : 0},
        {"crossings", points.crossings.size()},
        {"mean", total / double(o.runs) / double(std::max<std::size_t>(points.pieces.size(), 1))}};
}

Exit runPhotonBench(const PhotonBench& o) {
    const Result<ImportedScene> imported = openScene(o.scene);
    if (!imported)
        return failed(imported.error().message);
    const Scene scene = flatten(imported->document, imported->assets);
    const TraceScene trace(scene);
    const CellPoints points = cellPoints(scene, trace);
    if (!o.json)
        printTitles(kPhotonColumns);
    Json rows = Json::array();
    std::map<const Technique*, std::unique_ptr<Lighting>>
        lightings; // keep areas from one to the next
    std::uint32_t moves = 0;
    for (const PhotonVariant& variant : photonVariants()) {
        std::unique_ptr<Lighting>& lighting = lightings[variant.technique];
        if (!lighting)
            lighting = variant.technique->light({});
        Json row = measureVariant(o, variant, scene, trace, points, *lighting, moves);
        row["name"] = std::filesystem::path(o.scene.scene).stem().string();
        if (!o.json)
            printRow(kPhotonColumns, row);
        rows.push_back(std::move(row));
    }
    return writeRows(rows, o.output, "photons", o.json);
}

} // namespace

void addPhotonBench(Command& bench) {
    const auto o = std::make_shared<PhotonBench>();
    Command command = bench.addCommand(
        "photons", "Photon lattices: steps of an update, lookups, and jumps of irradiance across "
                   "faces of cells, for each blur, beside splats and light propagation volumes");
    addSceneOptions(command, o->scene);
    command.option("-o,--output", o->output, "Folder for photons.csv and photons.json").required();
    command.option("--photons", o->photons, "Photons of a light").within(16, 10000000);
    command.option("--runs", o->runs, "Updates and rounds of lookups of each variant")
        .within(1, 1000);
    command.flag("--json", o->json, "Print one JSON object to stdout");
    command.onRun([o] { return runPhotonBench(*o); });
}

} // namespace limn
