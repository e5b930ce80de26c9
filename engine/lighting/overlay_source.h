// SPDX-License-Identifier: MIT
#pragma once

#include "engine/overlay/overlay_data.h"
#include "engine/overlay/overlay_kind.h"
#include "engine/scene/scene.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace limn {

class LightSnapshot;
struct Technique;

/// What the overlays of a technique are made of: its precomputed data or, where it precomputes
/// nothing, a snapshot of its light. Immutable. Whoever has no overlays keeps these defaults.
class OverlaySource {
public:
    virtual ~OverlaySource() = default;

    virtual const Technique& technique() const = 0;

    /// Builds an overlay of one of the kinds in Technique::overlays. `scene` is the one that this
    /// was made from; its materials may be newer. `light` is of the same technique, is read by
    /// kinds that show light, and may be null.
    virtual OverlayData overlay(const OverlayRequest& /*request*/, const Scene& /*scene*/,
                                const LightSnapshot* /*light*/) const {
        return {};
    }
    /// Largest OverlayRequest::depth.
    virtual std::uint32_t maxOverlayDepth() const { return 0; }
    /// Things are picked by their numbers below this.
    virtual std::uint32_t pickCount() const { return 0; }
    /// Number of the thing that lights the surface which was hit; std::nullopt: there is none.
    /// `hit` names an instance of `scene`, or one past its end for an unknown object.
    virtual std::optional<std::uint32_t> pickAt(const Scene& /*scene*/, const Hit& /*hit*/) const {
        return {};
    }
    /// Number of the thing here that lies nearest to number `pick` of `other`, which is of the same
    /// technique.
    virtual std::optional<std::uint32_t> nearestPick(const OverlaySource& /*other*/,
                                                     std::uint32_t /*pick*/) const {
        return {};
    }
    /// Describes number `pick` for kinds with OverlayKind::describesPick. `scene` as for overlay().
    virtual std::vector<OverlayLine> describePick(const Scene& /*scene*/,
                                                  std::uint32_t /*pick*/) const {
        return {};
    }
    /// The numbers that an overlay shows in colours at the surface which was hit. `hit` as for
    /// pickAt(), `light` as for overlay(). Unless overridden: describes what pickAt() finds.
    virtual std::vector<OverlayLine> describeAt(const OverlayRequest& /*request*/,
                                                const Scene& scene, const Hit& hit,
                                                const LightSnapshot* /*light*/) const {
        const std::optional<std::uint32_t> number = pickAt(scene, hit);
        return number ? describePick(scene, *number) : std::vector<OverlayLine>();
    }
};

} // namespace limn
