// SPDX-License-Identifier: MIT
#include "app/papers/paper_view.h"

#include "app/bench/spread.h"

#include <cmath>
#include <utility>

namespace limn {

Result<const FrontScene*> openView(PaperRun& run, const PaperView& view) {
    return run.scene(*view.scene, view.roughness);
}

Result<PaperLine> withPicture(PaperRun& run, const PaperView& view, const std::string& experiment,
                              const std::string& name, const ImageF& picture,
                              std::vector<PaperFigure> figures) {
    const Result<const FrontScene*> front = openView(run, view);
    if (!front)
        return tl::make_unexpected(front.error());
    const auto exposure = float(std::log2(0.18 / meanOf((*front)->truth.first())));
    Result<std::string> file = run.keepPicture(experiment, name, picture, exposure + view.stops);
    if (!file)
        return tl::make_unexpected(file.error());
    return PaperLine{{}, std::move(figures), std::move(*file)};
}

Result<void> addReference(PaperRun& run, const PaperView& view, const std::string& experiment) {
    return run.line(experiment, "reference", [&]() -> Result<PaperLine> {
        const Result<const FrontScene*> front = openView(run, view);
        if (!front)
            return tl::make_unexpected(front.error());
        const ImageF truth = meanImage((*front)->truth.first(), (*front)->truth.second());
        return withPicture(run, view, experiment, "reference", truth,
                           {{"noise of a pixel", noiseOf((*front)->truth), 0, {}}});
    });
}

PaperFigure timeFigure(const char* column, const std::vector<double>& ms,
                       std::optional<double> printed) {
    const Spread spread = spreadOf(ms);
    return {column, spread.median, spread.p95 - spread.median, printed};
}

PaperFigure errorFigure(const Comparison& error) {
    return {"nRMSE", error.nrmse, error.nrmseNoise, {}};
}

PaperFigure biasFigure(const Comparison& error) {
    return {"bias [%]", 100 * error.bias, 100 * error.biasNoise, {}};
}

} // namespace limn
