// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/other_technique.h"

#include "editor_ui/jobs/fitted_layout.h"
#include "editor_ui/jobs/scene_changes.h"

#include <utility>

#include <fmt/format.h>

namespace limn {

void OtherTechnique::set(const std::string& technique, const std::shared_ptr<const Scene>& scene,
                         const BakedScene& baked, const Viewpoint& view) {
    if (technique.empty()) {
        m_job = nullptr;
        m_documentScene = nullptr;
        m_lit = {};
        m_relit = {};
        return;
    }
    const bool fresh = !m_job;
    if (fresh)
        m_job = std::make_unique<RelightJob>(m_wake);
    const bool sameBake = !fresh && m_bake == baked.bake;
    if (!sameBake) {
        m_bake = baked.bake;
        m_job->setBake(baked);
    }
    if (m_documentScene != scene || m_lit.scene->technique.technique != technique) {
        auto other = std::make_shared<Scene>(*scene);
        other->technique.technique = technique;
        const bool sameLayout = m_documentScene && sameBake &&
                                sameInstanceList(*m_documentScene, *scene) &&
                                m_lit.scene->technique.technique == technique;
        m_documentScene = scene;
        m_lit.scene = std::move(other);
        if (!sameLayout)
            m_lit.layout = layoutOf(*m_lit.scene, baked);
        m_job->setScene(m_lit.scene);
    } else if (!sameBake) {
        m_lit.layout = layoutOf(*m_lit.scene, baked);
    }
    m_job->setView(view);
    m_relit = m_job->result();
    m_lit.field = m_relit.field;
}

std::string OtherTechnique::text() const {
    if (!m_lit.scene)
        return {};
    if (!m_lit.layout)
        return "No bounced light: this technique needs a bake";
    if (!m_relit.field)
        return "Computing its light";
    const double ms = m_relit.status.last.totalMs;
    return fmt::format("{}: {:.1f} ms", m_relit.status.running ? "Refining" : "Last update", ms);
}

} // namespace limn
