// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"

#include <unordered_map>

namespace limn {

/// What a node inherits from its ancestors, and its own.
struct Placement {
    glm::dmat4 toWorld{1};
    bool visible = true;
    bool dynamic = false;
};

/// Placements of a document's nodes, each computed once. The document must outlive it; what it has
/// must stay as it is, but objects may be added.
class Placements {
public:
    /// In world space about the document's own origin. Where that is 0, matrices are multiplied as
    /// floats, which suffices there, so that bakes of such scenes keep their bits.
    explicit Placements(const Document& document);

    /// About `origin` instead, multiplied as doubles.
    Placements(const Document& document, const glm::dvec3& origin);

    /// A missing parent makes a root; a cycle, which documents must not have, is cut. An id that is
    /// no node's has world space itself as its place.
    Placement of(ObjectId id);

private:
    const Node* node(ObjectId id) const;

    const Document& m_document;
    glm::dvec3 m_origin;
    bool m_inDouble;
    std::unordered_map<ObjectId, Placement> m_known;
};

} // namespace limn
