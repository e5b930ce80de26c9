// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"

#include <unordered_map>

namespace limn {

/// Transform, flags and density of a node, combined with those of its ancestors.
struct Placement {
    glm::dmat4 toWorld{1};
    bool visible = true;
    bool dynamic = false;
    float texelDensity = 1; ///< within the limits of a single node's
};

/// Placements of a document's nodes, each computed once. The document must outlive this object and
/// its existing objects must not change; new ones may be added.
class Placements {
public:
    /// Placements in world space about the document's own origin. If that origin is 0, matrices are
    /// multiplied as floats, which is sufficient there and keeps bakes of such scenes
    /// bit-identical.
    explicit Placements(const Document& document);

    /// Placements about `origin`, with matrices multiplied as doubles.
    Placements(const Document& document, const glm::dvec3& origin);

    /// Placement of node `id`. A node with a missing parent counts as a root; a cycle, which
    /// documents must not contain, is cut. An id that is no node's has the identity transform.
    Placement of(ObjectId id);

private:
    const Node* node(ObjectId id) const;

    const Document& m_document;
    glm::dvec3 m_origin;
    bool m_inDouble;
    std::unordered_map<ObjectId, Placement> m_known;
};

} // namespace limn
