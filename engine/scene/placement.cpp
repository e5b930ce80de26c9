// SPDX-License-Identifier: MIT
#include "engine/scene/placement.h"

#include "engine/scene/find_object.h"

#include <algorithm>
#include <vector>

namespace limn {

Placements::Placements(const Document& document)
    : m_document(document), m_origin(document.origin),
      m_inDouble(document.origin != glm::dvec3(0)) {}

Placements::Placements(const Document& document, const glm::dvec3& origin)
    : m_document(document), m_origin(origin), m_inDouble(true) {}

const Node* Placements::node(ObjectId id) const {
    return findObjectAs<Node>(m_document, id);
}

/// Iterative, because a chain of nodes may be very long.
Placement Placements::of(ObjectId id) {
    std::vector<ObjectId> chain;
    Placement placement;
    placement.toWorld[3] = glm::dvec4(-m_origin, 1);
    for (; id != 0; id = node(id)->parent) {
        const auto known = m_known.find(id);
        if (known != m_known.end()) {
            placement = known->second;
            break;
        }
        if (!node(id) || chain.size() > m_document.objects.size())
            break;
        chain.push_back(id);
    }
    for (auto child = chain.rbegin(); child != chain.rend(); ++child) {
        const Node& n = *node(*child);
        placement.toWorld = m_inDouble
                                ? placement.toWorld * preciseMatrix(n.transform)
                                : glm::dmat4(glm::mat4(placement.toWorld) * matrix(n.transform));
        placement.visible = placement.visible && n.visible;
        placement.dynamic = placement.dynamic || n.dynamic;
        placement.texelDensity =
            std::clamp(placement.texelDensity * n.texelDensity, kMinTexelDensity, kMaxTexelDensity);
        m_known.emplace(*child, placement);
    }
    return placement;
}

} // namespace limn
