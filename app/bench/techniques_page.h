// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/bench.h"
#include "engine/core/result.h"
#include "engine/scene/image.h"

#include <string>
#include <vector>

namespace limn {

/// A picture of the page, tone-mapped.
struct PagePicture {
    std::string caption;
    Image image;
};

/// A scene on the page.
struct PageScene {
    std::string name;
    std::string note;       ///< size of the pictures, noise of the reference
    std::vector<Json> rows; ///< of `limn bench techniques`
    std::vector<PagePicture> pictures;
};

/// A row of `rows` with the smallest error of those in which `key` is at most `budget`; null: none.
const Json* bestWithin(const std::vector<Json>& rows, const std::string& key, double budget);

/// A page of HTML that needs no other file: for each scene, and for each device that lights it,
/// error over time and over memory, and who has the smallest error at equal time and at equal
/// memory; then all rows, and the pictures. `leakRoom`:
/// what the rooms are in which leaks were measured. Fails if a picture cannot be encoded.
Result<std::string> techniquesPage(const std::vector<PageScene>& scenes,
                                   const std::string& leakRoom);

} // namespace limn
