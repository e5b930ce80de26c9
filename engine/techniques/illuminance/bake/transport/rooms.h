// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/transport/training_light.h"

#include <cstdint>
#include <vector>

namespace limn {

/// The room of each surfel, numbered from 0: what the training lamps' shadow rays tell. Two lamps
/// hang in one room if half of the surfels that one of them lights, that of fewer, are lit by the
/// other too; a surfel is in the room whose lamps light it most, and those that no lamp reaches,
/// such as the insides of walls, are together in one more. No ray is traced.
std::vector<std::uint32_t> findRooms(const TracedTraining& traced);

/// The same leaves in a tree of which no cluster but those at its top has surfels of several rooms:
/// for each room the tree that `tree` spans over its surfels, then these joined, and the sky. What
/// a cache sees of such clusters tells nothing of what they send: the few bright surfels beyond a
/// door that share a cluster with many dark ones light the dark room through every link to it.
/// leftWeight is by area, as in buildClusterTree().
ClusterTree splitByRoom(const ClusterTree& tree, const Surfels& surfels,
                        const std::vector<std::uint32_t>& room);

} // namespace limn
