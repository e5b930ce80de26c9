// SPDX-License-Identifier: MIT
#pragma once

#include "engine/picture/solve_strengths.h"
#include "engine/scene/document.h"

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace limn {

/// A pixel explained, with what its rows name.
struct ExplainedPixel {
    PixelExplanation explanation;
    PixelLight light = PixelLight::Radiance;
    std::vector<ObjectId> lights; ///< of Scene::lights
    std::vector<ObjectId> nodes;  ///< of Scene::instances
    double ms = 0;                ///< that explaining took, without lighting the scene
};

/// A pixel of the picture that was clicked.
struct PixelPick {
    PixelQuestion question;
    glm::vec3 point{0}; ///< of the surface that the pixel shows, world
};

/// Places in the picture that are to have some light, and the strengths that give it to them.
struct GoalsState {
    struct Goal {
        PixelPick pick;
        float wanted = 0;             ///< luminance, as StrengthGoal
        double now = 0;               ///< luminance when the goal was set or solved for
        std::optional<double> solved; ///< luminance with the strengths that were found
    };
    std::vector<Goal> goals;
    bool selectedOnly = false; ///< only selected lights may change
    bool start = false;        ///< the session is to solve
    bool running = false;
    std::string stage;  ///< of the solution that is running
    float fraction = 0; ///< of that stage
    std::string error;  ///< of the last solution
};

/// The table that explains a pixel of the picture.
struct ExplainState {
    bool shown = false;    ///< the table is on screen, and clicks in the picture choose the pixel
    bool bringUp = false;  ///< bring the table to the front in the next frame
    bool bySender = false; ///< which of the tables
    PixelLight light = PixelLight::Radiance;
    std::optional<PixelPick> pick;
    bool running = false;
    std::string refusal; ///< why nothing can be explained now; empty: it can
    std::string error;   ///< of the last explanation
    std::shared_ptr<const ExplainedPixel> result; ///< the newest; null: none yet
    std::set<ObjectId> muted; ///< shown without them while the table that lists them is on screen
    bool mutes = false;       ///< that table is on screen
    ObjectId hovered = 0;     ///< object of the row under the mouse; 0: none
    GoalsState goals;
};

} // namespace limn
