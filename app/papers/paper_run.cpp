// SPDX-License-Identifier: MIT
#include "app/papers/paper_run.h"

#include "app/commands/progress_line.h"
#include "app/program_version.h"

#include "engine/files/image_file.h"
#include "engine/scene/tone_map.h"

#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

Json jsonOf(const std::optional<double>& value) {
    return value ? Json(*value) : Json();
}

std::optional<double> numberIn(const Json& value) {
    return value.isNumber() ? std::optional(value.get<double>()) : std::nullopt;
}

Json jsonOf(const PaperLine& line) {
    Json figures = Json::array();
    for (const PaperFigure& f : line.figures)
        figures.push_back({{"column", f.column},
                           {"measured", jsonOf(f.measured)},
                           {"noise", f.noise},
                           {"printed", jsonOf(f.printed)}});
    return {{"name", line.name}, {"figures", figures}, {"picture", line.picture}};
}

PaperLine lineIn(const Json& row) {
    PaperLine line{row["name"].get<std::string>(), {}, row["picture"].get<std::string>()};
    for (const Json& f : row["figures"])
        line.figures.push_back({f["column"].get<std::string>(), numberIn(f["measured"]),
                                f["noise"].get<double>(), numberIn(f["printed"])});
    return line;
}

/// "surfels 16384, 32 links" as a part of a file's name.
std::string fileNameOf(std::string_view text) {
    std::string name;
    for (const char c : text)
        if ((c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'))
            name += c;
        else if (!name.empty() && name.back() != '-')
            name += '-';
    return name;
}

SceneOptions sceneOptionsOf(const PaperRun& run, const PaperScene& scene) {
    SceneOptions options;
    options.scene = run.pathOf(scene);
    if (scene.light)
        options.lights = {scene.light};
    return options;
}

CameraOptions cameraOptionsOf(const PaperRun& run, const PaperScene& scene) {
    CameraOptions camera{.width = run.options().width, .height = run.options().height};
    if (scene.view) {
        camera.eye.assign(scene.view->eye.begin(), scene.view->eye.end());
        camera.target.assign(scene.view->target.begin(), scene.view->target.end());
    }
    return camera;
}

} // namespace

Result<PaperRun> PaperRun::open(const PaperOptions& options) {
    Result<KeptRows> kept = KeptRows::open(options.output, "papers");
    if (!kept)
        return tl::make_unexpected(kept.error());
    PaperRun run;
    run.m_options = &options;
    run.m_kept = std::move(*kept);
    return run;
}

Result<void> PaperRun::line(const std::string& experiment, const std::string& name,
                            const std::function<Result<PaperLine>()>& measure) {
    const PaperOptions& o = *m_options;
    const std::string key =
        fmt::format("{}; {}; {}; {} x {}, {} samples, {} runs; device {}", programVersion(),
                    experiment, name, o.width, o.height, o.samplesPerPixel, o.runs, o.device);
    if (!m_kept.find(key)) {
        Result<PaperLine> measured = measure();
        endProgressLine();
        if (!measured)
            return fail(fmt::format("{}, {}: {}", experiment, name, measured.error().message));
        measured->name = name;
        if (const Result<void> kept = m_kept.keep(key, jsonOf(*measured)); !kept)
            return kept;
    }
    m_lines[experiment].push_back(lineIn(*m_kept.find(key)));
    return {};
}

std::string PaperRun::pathOf(const PaperScene& scene) const {
    return scene.file ? m_options->scenes + "/" + scene.file : scene.name;
}

Result<const FrontScene*> PaperRun::scene(const PaperScene& scene, std::optional<float> roughness) {
    std::unique_ptr<FrontScene>& front =
        m_scenes[fmt::format("{}, {}", scene.name, roughness.value_or(-1))];
    if (!front) {
        Result<FrontScene> opened =
            openFrontScene(sceneOptionsOf(*this, scene),
                           {cameraOptionsOf(*this, scene),
                            scene.referenceFactor * m_options->samplesPerPixel, roughness},
                           m_options->output, progressOnStderr());
        if (!opened)
            return tl::make_unexpected(opened.error());
        front = std::make_unique<FrontScene>(std::move(*opened));
    }
    return front.get();
}

Result<std::string> PaperRun::keepPicture(const std::string& experiment, const std::string& line,
                                          const ImageF& image, float exposureEv) {
    const std::string name = fileNameOf(experiment + " " + line) + ".png";
    const Result<void> written =
        writePng(m_options->output + "/" + name, toneMappedImage(image, Tonemap::Aces, exposureEv));
    if (!written)
        return tl::make_unexpected(written.error());
    return name;
}

const std::vector<PaperLine>& PaperRun::linesOf(const std::string& experiment) const {
    static const std::vector<PaperLine> none;
    const auto lines = m_lines.find(experiment);
    return lines == m_lines.end() ? none : lines->second;
}

} // namespace limn
