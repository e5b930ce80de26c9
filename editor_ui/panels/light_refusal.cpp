// SPDX-License-Identifier: MIT
#include "editor_ui/panels/light_refusal.h"

#include "editor_ui/panels/statistics.h"

namespace limn {

std::string lightRefusal(const BakeStatus& bake) {
    switch (bake.freshness) {
    case BakeFreshness::NotUsed:
    case BakeFreshness::UpToDate:
        return bake.preview ? "The picture shows a preview; the full bake is running" : "";
    case BakeFreshness::None:
        return "Nothing is baked yet: bake first";
    case BakeFreshness::Checking:
        return "The bake is being checked";
    case BakeFreshness::Needed:
        return "The bake is older than the scene: bake first";
    }
    return "";
}

} // namespace limn
