// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace limn {

/// What a program keeps for its user, each kind in a folder of its own.
enum class UserFolder : std::uint8_t {
    Config, ///< settings: $XDG_CONFIG_HOME, else ~/.config
    Cache,  ///< what can be made again: $XDG_CACHE_HOME, else ~/.cache
    State,  ///< what outlives a run and is no setting: $XDG_STATE_HOME, else ~/.local/state
};

/// The folder "limn" in the user's folder of that kind, which need not exist. Empty where neither
/// variable is set. A variable that is not an absolute path is ignored.
/// XDG Base Directory Specification 0.8
std::string userFolder(UserFolder kind);

/// Where the user keeps documents: XDG_DOCUMENTS_DIR of user-dirs.dirs in the user's configuration,
/// else ~/Documents if there is one, else the home folder. Empty where no home is known.
std::string documentsFolder();

} // namespace limn
