// Which rooms can be reached through doors.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace gramap {

/// Of the rooms `ids`, those that no sequence of `passages` (pairs of ids; "outside" counts as a place) joins
/// to any of `from`. In the order of `ids`.
std::vector<std::string> unreachable(const std::vector<std::string>& ids,
                                     const std::vector<std::pair<std::string, std::string>>& passages,
                                     const std::vector<std::string>& from);

}  // namespace gramap
