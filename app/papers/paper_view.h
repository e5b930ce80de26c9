// SPDX-License-Identifier: MIT
#pragma once

#include "app/papers/paper_run.h"

#include "engine/measure/compare.h"

namespace limn {

/// What the pictures of an experiment show.
struct PaperView {
    const PaperScene* scene;
    std::optional<float> roughness = {}; ///< as PaperRun::scene()
    float stops = 0; ///< over the exposure that makes the reference's mean 0.18 [EV]
};

/// Samples per pixel of pictures that are not references.
inline constexpr std::uint32_t kPaperPictureSamples = 16;

Result<const FrontScene*> openView(PaperRun& run, const PaperView& view);

/// A line with a picture, which is kept under the names of the experiment and the line.
Result<PaperLine> withPicture(PaperRun& run, const PaperView& view, const std::string& experiment,
                              const std::string& name, const ImageF& picture,
                              std::vector<PaperFigure> figures);

/// Adds the reference as a line of an experiment.
Result<void> addReference(PaperRun& run, const PaperView& view, const std::string& experiment);

/// Median of times [ms], with their 95th percentile over it as the noise.
PaperFigure timeFigure(const char* column, const std::vector<double>& ms,
                       std::optional<double> printed = {});

/// Of a sum of steps over runs.
template <class Run>
PaperFigure timeOf(const char* column, const std::vector<Run>& runs,
                   std::initializer_list<double Run::*> steps, std::optional<double> printed = {}) {
    std::vector<double> ms;
    for (const Run& run : runs) {
        ms.push_back(0);
        for (double Run::*step : steps)
            ms.back() += run.*step;
    }
    return timeFigure(column, ms, printed);
}

PaperFigure errorFigure(const Comparison& error);
PaperFigure biasFigure(const Comparison& error);

} // namespace limn
