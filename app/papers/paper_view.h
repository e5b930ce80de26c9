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

PaperFigure errorFigure(const Comparison& error);
PaperFigure biasFigure(const Comparison& error);

} // namespace limn
