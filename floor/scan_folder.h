// All rooms of a scans folder, perceived side by side; a bad room is said and set aside.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "floor/fitted_floor.h"
#include "perception/observation.h"
#include "perception/perceive.h"

namespace gramap {

struct PerceivedFolder {
  std::vector<RoomObservation> rooms;  ///< in the order of the folders' names
  std::vector<SetAsideInput>
      set_aside;  ///< rooms that could not be read or perceived, each with place and reason
};

/// Perceives `folder`/<room>/, except the rooms in `without`. A room's folder holds its scans, or a folder
/// for each person who scanned it (scans/<room>/<anything>/), which then are observations of their own. A
/// file <room>.json beside the folders is an observation that an earlier run made (`gramap perceive`), taken
/// as it is. Throws InputError when the folder is not there, holds no room, or a name in `without` is no
/// room. `finished` is called with the name of each room that is done and how many there are, from any
/// thread.
using RoomFinished = std::function<void(const std::string& room, std::size_t rooms)>;
PerceivedFolder perceive_folder(const std::filesystem::path& folder,
                                const std::vector<std::string>& without = {},
                                const PerceptionOptions& options = {},
                                const RoomFinished& finished = nullptr);

}  // namespace gramap
