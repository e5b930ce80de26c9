// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/front_scene.h"
#include "app/bench/kept_rows.h"
#include "app/papers/paper_figures.h"

#include "engine/core/result.h"
#include "engine/stages/stage_store.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace limn {

/// A scene that papers measure, with the lights and the camera that stand for theirs.
struct PaperScene {
    const char* name;
    const char* file;  ///< in the folder of scenes; null: a sample project of this name
    const char* light; ///< as --light has it; null: the scene's own
    struct View {
        std::array<double, 3> eye, target;
    };
    std::optional<View> view = {};     ///< in the file's coordinates [m]; none: its own camera
    std::uint32_t referenceFactor = 1; ///< times the samples of other scenes' references
};

struct PaperOptions {
    std::string scenes, output;
    std::string device;          ///< part of a Vulkan device's name; empty: the best one
    bool softwareDevice = false; ///< the device is a program on the CPU
    bool onDevice = true;        ///< else only what the CPU does is measured
    std::uint32_t width = 320, height = 180; ///< of pictures
    std::uint32_t samplesPerPixel = 64;      ///< of references
    int runs = 21;                           ///< timed updates of each line
};

/// Measures the lines of experiments, and keeps each as soon as it is finished, so that a run that
/// was stopped goes on where it ended.
class PaperRun {
public:
    /// `options` outlives the object. Fails as KeptRows::open().
    static Result<PaperRun> open(const PaperOptions& options);

    const PaperOptions& options() const { return *m_options; }

    /// Adds a line to the experiment's table: the kept one, or what `measure` finds.
    Result<void> line(const std::string& experiment, const std::string& name,
                      const std::function<Result<PaperLine>()>& measure);

    /// The scene with its reference, which are opened once; with `roughness`, half of each surface
    /// is metal of that roughness. Fails as openFrontScene().
    Result<const FrontScene*> scene(const PaperScene& scene, std::optional<float> roughness = {});

    /// Path of the scene's file, or its name where it is a sample project.
    std::string pathOf(const PaperScene& scene) const;

    /// Keeps a picture of a line, tone-mapped at an exposure [EV], and returns the file's name.
    Result<std::string> keepPicture(const std::string& experiment, const std::string& line,
                                    const ImageF& image, float exposureEv);

    StageStore& stages() { return *m_stages; }

    /// The lines of an experiment so far, in their order.
    const std::vector<PaperLine>& linesOf(const std::string& experiment) const;

private:
    const PaperOptions* m_options = nullptr;
    KeptRows m_kept;
    std::unique_ptr<StageStore> m_stages = std::make_unique<StageStore>(); ///< in memory
    std::map<std::string, std::unique_ptr<FrontScene>> m_scenes;
    std::map<std::string, std::vector<PaperLine>> m_lines;
};

} // namespace limn
