// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/cut/training_light.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Room of each surfel, numbered from 0, from the training lamps' shadow rays; no ray is traced.
/// Two lamps hang in one room if half of the surfels lit by the one that lights fewer are lit by
/// the other too. A surfel is in the room whose lamps light it most. Surfels that no lamp reaches,
/// such as those inside walls, share one more room.
std::vector<std::uint32_t> findRooms(const TracedTraining& traced);

/// Returns a tree of the same leaves in which only clusters at the top have surfels of several
/// rooms: for each room the tree that `tree` spans over its surfels, then these joined, and the
/// sky. What a cache sees of a cluster across rooms does not tell what the cluster sends: a few
/// bright surfels beyond a door that share a cluster with many dark ones light the dark room
/// through every link to it. leftWeight is by area, as in buildClusterTree().
ClusterTree splitByRoom(const ClusterTree& tree, const Surfels& surfels,
                        const std::vector<std::uint32_t>& room);

} // namespace limn
