// SPDX-License-Identifier: MIT
#include "app/commands/command.h"
#include "app/commands/output_file.h"

#include "engine/files/image_file.h"
#include "engine/json/json.h"
#include "engine/measure/compare.h"

#include <memory>

#include <fmt/format.h>

namespace limn {

namespace {

struct CompareCommand {
    std::string test, reference, reference2, heatmap;
    bool json = false;
};

Json report(const Comparison& c, bool twoReferences) {
    Json json;
    json["nrmse"] = c.nrmse; // null: the reference is black
    json["nrmse_without_worst_percent"] = c.nrmseTrimmed;
    json["relmse"] = c.relmse;
    json["bias"] = c.bias;
    json["ssim"] = c.ssim;
    json["flip"] = c.flip;
    if (twoReferences) {
        json["reference_noise"] = c.referenceNoise;
        json["nrmse_noise"] = c.nrmseNoise;
        json["bias_noise"] = c.biasNoise;
    }
    json["invalid_pixels"] = c.invalidPixels;
    return json;
}

Exit runCompare(const CompareCommand& o) {
    if (!o.heatmap.empty())
        if (const Result<void> writable =
                checkOutputFile(o.heatmap, {".png"}, {o.test, o.reference, o.reference2});
            !writable)
            return failed(writable.error().message);
    const Result<ImageF> test = readFloatImage(o.test);
    if (!test)
        return failed(test.error().message);
    const Result<ImageF> reference = readFloatImage(o.reference);
    if (!reference)
        return failed(reference.error().message);
    const bool two = !o.reference2.empty();
    const Result<ImageF> reference2 = two ? readFloatImage(o.reference2) : ImageF{};
    if (!reference2)
        return failed(reference2.error().message);
    const Result<Comparison> c =
        two ? compareImages(*test, *reference, *reference2) : compareImages(*test, *reference);
    if (!c)
        return failed(fmt::format("{}, {}: {}", o.test,
                                  two ? o.reference + ", " + o.reference2 : o.reference,
                                  c.error().message));
    if (!o.heatmap.empty()) {
        const ImageF truth = two ? meanImage(*reference, *reference2) : *reference;
        if (const Result<void> written = writePng(o.heatmap, errorHeatmap(*test, truth)); !written)
            return failed(written.error().message);
    }
    const Json json = report(*c, two);
    if (o.json)
        fmt::print("{}\n", json.dump());
    else
        for (const auto& [key, value] : json.members())
            fmt::print("{:<28} {}\n", key, value.dump());
    return Exit::Done;
}

} // namespace

void addCompareCommand(Command& app) {
    const auto o = std::make_shared<CompareCommand>();
    Command command =
        app.addCommand("compare", "Measure the error of a render against a reference");
    command.option("test", o->test, "Linear image to judge, .exr or .hdr").required();
    command.option("reference", o->reference, "Reference of the same size").required();
    command.option("--reference2", o->reference2,
                   "Second reference with another seed, so that the noise of both is not "
                   "counted as error");
    command.option("--heatmap", o->heatmap,
                   "Error map to write, .png: blue is too dark, orange too bright");
    command.flag("--json", o->json, "Print one JSON object to stdout");
    command.onRun([o] { return runCompare(*o); });
}

} // namespace limn
