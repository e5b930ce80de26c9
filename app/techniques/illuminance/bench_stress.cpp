// SPDX-License-Identifier: MIT
#include "app/techniques/illuminance/bench_oracles.h"
#include "app/techniques/illuminance/illuminance_program.h"
#ifdef LIMN_HAS_VIEWPORT
#include "app/techniques/illuminance/bench_shake.h"
#endif

#include <memory>

namespace limn {

namespace {

struct StressBench {
    OracleBench oracles;
#ifdef LIMN_HAS_VIEWPORT
    ShakeBench shake;
#endif
};

} // namespace

void addStressBench(CLI::App& bench, Run& run) {
    const auto o = std::make_shared<StressBench>();
    CLI::App* command = bench.add_subcommand(
        "stress",
        "Change lights, materials and objects at random under Vulkan validation; fail on a "
        "validation message, a number that is not finite, or growing memory. With "
        "--generated, oracles judge hostile scenes instead");
    addOracleOptions(*command, o->oracles);
    command->add_option("-o,--output", o->oracles.output, "Folder for stress.csv and stress.json")
        ->required();
    command->add_flag("--json", o->oracles.json, "Print one JSON object to stdout");
#ifdef LIMN_HAS_VIEWPORT
    addShakeOptions(*command, o->shake);
    command->add_option("--device", o->oracles.device, "Part of the Vulkan device's name");
#endif
    command->callback([o, &run] {
        const bool judge = o->oracles.scenes > 0 || !o->oracles.caseFile.empty();
#ifdef LIMN_HAS_VIEWPORT
        if (o->shake.bakes.scenes.empty() != judge)
            throw CLI::ValidationError("scenes", "give either scenes, --generated or --case");
        o->shake.output = o->oracles.output;
        o->shake.device = o->oracles.device;
        o->shake.json = o->oracles.json;
        run = [o, judge] { return judge ? runOracleBench(o->oracles) : runShakeBench(o->shake); };
#else
        if (!judge)
            throw CLI::ValidationError("--generated", "give that or --case");
        run = [o] { return runOracleBench(o->oracles); };
#endif
    });
}

} // namespace limn
