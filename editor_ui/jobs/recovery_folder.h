// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/descriptor.h"
#include "engine/core/result.h"
#include "engine/scene/document.h"

#include <ctime>
#include <optional>
#include <string>

namespace limn {

/// A folder with a copy of one editor's unsaved document. It holds "document.limn", which is a
/// project; "of", the path of the document that it is a copy of; and "lock", which is locked as
/// long as the editor runs, however that ends, so that no other editor takes the copy for a lost
/// one.
struct RecoveryFolder {
    std::string path; ///< absolute, without symbolic links; empty: none
    Descriptor lock{-1};
};

/// The unsaved document of an editor that has ended. Whoever holds it has the lock.
struct Recovery {
    RecoveryFolder folder;
    std::string originalPath; ///< path of the project, or of the scene that was never saved as one
    std::time_t written = 0;  ///< when the copy was written

    std::string documentPath() const { return folder.path + "/document.limn"; }
};

/// Creates a locked folder of a new name in `root`, and `root` where it does not exist.
Result<RecoveryFolder> createRecoveryFolder(const std::string& root);

/// Replaces the copy in `folder` atomically. The document stays valid as it was on failure.
Result<void> writeRecovery(const RecoveryFolder& folder, const std::string& originalPath,
                           const Document& document);

/// Deletes the folder and everything in it, then unlocks it.
void removeRecovery(RecoveryFolder& folder);

/// The newest copy in `root` that no running editor holds, of the project or scene at
/// `originalPath`; of any document where that is empty. Nothing where there is none or `root`
/// cannot be read.
std::optional<Recovery> findRecovery(const std::string& root, const std::string& originalPath);

} // namespace limn
