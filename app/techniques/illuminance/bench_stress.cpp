// SPDX-License-Identifier: MIT
#include "app/techniques/illuminance/bench_oracles.h"
#include "app/techniques/illuminance/bench_shake.h"
#include "app/techniques/illuminance/illuminance_program.h"

#include <memory>

namespace limn {

namespace {

struct StressBench {
    OracleBench oracles;
    ShakeBench shake;
};

} // namespace

void addStressBench(Command& bench) {
    const auto o = std::make_shared<StressBench>();
    Command command = bench.addCommand(
        "stress",
        "Change lights, materials and objects at random under Vulkan validation; fail on a "
        "validation message, a number that is not finite, or growing memory. With "
        "--generated, oracles judge hostile scenes instead");
    addOracleOptions(command, o->oracles);
    command.option("-o,--output", o->oracles.output, "Folder for stress.csv and stress.json")
        .required();
    command.flag("--json", o->oracles.json, "Print one JSON object to stdout");
    addShakeOptions(command, o->shake);
    command.option("--device", o->oracles.device, "Part of the Vulkan device's name");
    const auto judges = [o] { return o->oracles.scenes > 0 || !o->oracles.caseFile.empty(); };
    command.onRun(
        [o, judges] {
            o->shake.output = o->oracles.output;
            o->shake.device = o->oracles.device;
            o->shake.json = o->oracles.json;
            return judges() ? runOracleBench(o->oracles) : runShakeBench(o->shake);
        },
        [o, judges] {
            return o->shake.bakes.scenes.empty() == judges()
                       ? std::string()
                       : "scenes: give either scenes, --generated or --case";
        });
}

} // namespace limn
