// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/session.h"
#include "engine/files/project_file.h"
#include "tests/core/source_path.h"

#include <chrono>
#include <functional>
#include <string>
#include <thread>

namespace limn {

/// Cornell with a lamp and a bake of a fraction of a second.
inline Document smallDocument() {
    Document document = loadProject(sourcePath("projects/cornell/cornell.limn"))->document;
    for (auto& [id, object] : document.objects)
        if (auto* settings = std::get_if<BakeSettings>(&object)) {
            settings->surfels = 256;
            settings->lightmapCaches = 300;
            settings->rays = 32;
            settings->links = 16;
        }
    addObject(document, Light{.name = "Lamp", .position = {0, 1, 0.3f}, .strength = 1});
    return document;
}

/// Lets a technique light the document, which is no edit of its history.
inline void chooseTechnique(Document& document, const std::string& name) {
    for (auto& [id, object] : document.objects)
        if (auto* choice = std::get_if<TechniqueChoice>(&object)) {
            choice->technique = name;
            return;
        }
    addObject(document, TechniqueChoice{.technique = name});
}

/// Updates the session until `done` returns true; returns false if a minute was not enough.
inline bool runUntil(Session& session, const std::function<bool()>& done) {
    for (int i = 0; i < 12000; ++i) {
        session.update();
        if (done())
            return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
}

} // namespace limn
