// SPDX-License-Identifier: MIT
#include "editor_ui/session.h"

namespace limn {

/// Starts a check if `start`, and shows how far it is and what it has found.
void Session::followLint(bool start) {
    LintState& lint = state.lint;
    if (start && !m_lintJob.start({std::make_shared<const Document>(state.document), state.assets,
                                   lint.repairs, m_options.import.memory}))
        log(LogLine::Level::Warning, "Busy with another check; try again in a moment");
    auto result = m_lintJob.takeResult();
    const std::shared_ptr<const Document> checked = m_lintJob.document();
    // The document of another file has other objects under the same ids.
    if (result && checked->scenePath == state.document.scenePath) {
        lint.error = *result ? "" : result->error().message;
        if (*result)
            lint.findings = **result;
    }
    lint.running = m_lintJob.busy();
    m_lintJob.report(lint.stage, lint.fraction);
    if (lint.findings && !state.gesture)
        lint.outdated = checked->objects != state.document.objects;
}

} // namespace limn
