// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace limn {

/// Every technique of bounced light, the default first.
std::span<const Technique* const> techniques();

/// The technique of that name, or null.
const Technique* findTechnique(std::string_view name);

/// The technique's setting with that key, or null.
const TechniqueSetting* findSetting(const Technique& technique, std::string_view key);

/// The technique whose data is precomputed for a document: the chosen one, or, where that needs
/// none, the first that does, so that switching back finds its data.
const Technique& precomputingTechnique(const TechniqueChoice& choice);

/// Reads precomputed data of whichever technique wrote the file. Fails as the first technique's
/// Precomputation::read() where none can.
Result<std::shared_ptr<const Precomputed>> readPrecomputed(const std::string& path,
                                                           const MemoryBudget& memory = {});

/// The overlays of every technique, in the order of the techniques.
std::vector<const OverlayKind*> overlayKinds();

/// The technique that lists an overlay. Precondition: one does.
const Technique& techniqueOf(const OverlayKind& kind);

/// Whether an overlay of this kind can be made of `source`, which may be null.
bool isMadeOf(const OverlayKind& kind, const OverlaySource* source);

/// Names of all techniques, "A or B or C", for messages and --help.
std::string techniqueNames();

/// What is wrong with a document's choice: an unknown technique, or a setting that none has; empty:
/// nothing.
std::string choiceDefect(const TechniqueChoice& choice);

} // namespace limn
