// SPDX-License-Identifier: MIT
#pragma once

#include "engine/json/json.h"

#include <string>
#include <vector>

namespace limn {

/// A scene on the page of `limn bench front`.
struct FrontPageScene {
    std::string name;
    std::string note;       ///< size of the pictures, noise of the reference
    std::vector<Json> rows; ///< one for each setting
};

/// Adds to each row whether it is on the Pareto lines of its scene: "time_front" and
/// "memory_front", of live light.
void markLines(std::vector<Json>& rows);

/// A page of HTML that needs no other file: for each scene, error over the time of an update and
/// over memory with the Pareto lines and the presets, of live light and of gathered pictures, the
/// best settings within some budgets, what the rows say about the paper's sentences, and all rows.
/// `note` names the program and the machine's share in the figures.
std::string frontPage(const std::vector<FrontPageScene>& scenes, const std::string& note);

} // namespace limn
