// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/panels/frame_record.h"
#include "editor_ui/panels/time_history.h"
#include "engine/files/relight_choice.h"
#include "engine/lighting/lighting_report.h"
#include "engine/lighting/precomputed.h"

#include <cstdint>
#include <optional>
#include <string>

namespace limn {

/// Whether the bake is up to date with the document.
enum class BakeFreshness {
    NotUsed,  ///< the technique that lights the document needs no bake
    None,     ///< nothing baked yet
    Checking, ///< the document changed; its hash is being computed
    UpToDate,
    Needed, ///< what it depends on changed since: BakeStatus::changes
};

/// State of the baker as shown in the panels.
struct BakeStatus {
    bool running = false;
    std::string stage;       ///< of the running bake
    float stageFraction = 0; ///< [0, 1]
    float fraction = 0;      ///< of the whole bake, estimated [0, 1]
    double elapsedSeconds = 0;
    double secondsLeft = -1; ///< < 0: not known yet
    BakeFreshness freshness = BakeFreshness::None;
    std::string changes;      ///< why a bake is needed, by name: "Door moved"; empty: not known
    PrecomputedReport last;   ///< of the last successful bake
    PrecomputedCost measured; ///< of that bake; stages that were kept cost what they did before, or
                              ///< nothing where that is not known
    PrecomputedCost expected; ///< of a bake with the settings of the document
    bool preview = false;     ///< it is a preview; the full bake is running
    bool selection = false;   ///< only a selection has all of its texels
    bool lightEdited = false; ///< since the scene was opened
    double secondsSinceLightEdit =
        0; ///< spent baking since a light, material or sky was last edited
    /// Of a running bake to an error or to a budget: "20 000 texels, after an error of 0.31".
    std::string step;
    bool fitting = false; ///< it is one to a budget
    std::string goal; ///< what the last bake, made to an error or a budget, came to; empty: neither
    std::string error; ///< why the last bake has no result; empty: it has one
};

/// What changed since the last bake, in words, if a new one is needed.
inline std::string bakeReason(const BakeStatus& bake) {
    if (!bake.changes.empty())
        return bake.changes;
    return bake.selection ? "only a selection has all of its texels"
                          : "what it was made from changed";
}

/// State of bounced light and its updates as shown in the panels.
struct LightingStatus {
    LightingReport last; ///< of the last update that bounced light
    TimeHistory history;
    std::uint64_t calls = 0;   ///< updates since the scene was opened
    std::uint32_t bounces = 0; ///< since the last edit
    bool running = false;
    bool converged = false;
};

/// Where bounced light is computed: by RelightJob, or by whoever draws the viewport on its device.
struct RelightPlace {
    RelightOn wanted = RelightOn::Auto;
    bool gpuCan = false;               ///< there is a device that draws, and it can light the bake
    std::string refusal;               ///< why it cannot; empty: it can, or there is none
    std::optional<RelightTimes> times; ///< of bakes like this one; not known until measured

    /// The place in use; never Auto.
    RelightOn used() const { return chooseRelight(wanted, gpuCan, times); }
};

/// State of the window and its viewport as shown in the panels.
struct FrameStatus {
    /// Times of the last picture.
    double uploadMs = 0, shadowMs = 0, surfacesMs = 0, shadeMs = 0, viewportMs = 0;
    std::uint32_t shadowMapsDrawn = 0;
    std::uint64_t gpuBytes = 0;
    bool nearLight = false;              ///< pictures at rest show light from near surfaces
    bool gathers = false;                ///< they end with final gathering
    float gathered = 0;                  ///< share of the last picture that is gathered
    std::uint32_t width = 0, height = 0; ///< of the last picture [px]
    std::uint64_t pictures = 0;          ///< viewport renders
    std::uint64_t surfacesDrawn = 0;     ///< of those, how many drew triangles
    std::uint64_t uiFrames = 0;
    FrameRecord frames;
    double longestLatencyMs =
        0; ///< from the event to the submitted frame, waits for the GPU included
};

/// The log keeps this many of its newest lines.
inline constexpr std::size_t kMaxLogLines = 1000;

/// A line of the log.
struct LogLine {
    enum class Level { Info, Warning, Error } level = Level::Info;
    std::string text;
};

} // namespace limn
