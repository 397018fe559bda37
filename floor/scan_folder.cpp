#include "floor/scan_folder.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <new>
#include <optional>

#include "geometry/error.h"
#include "geometry/file.h"
#include "perception/scan.h"

namespace gramap {
namespace {

namespace fs = std::filesystem;

struct Job {
  std::string room;
  fs::path folder;  ///< of its scans; or the .json that an earlier run made of them
};

std::vector<fs::path> folders_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error, ignored;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (entry->is_directory(ignored)) found.push_back(entry->path());
  if (error)
    throw InputError({folder.string()}, "this folder of scans cannot be read: " + error.message(),
                     "give the folder that holds a folder for each room");
  std::sort(found.begin(), found.end());
  return found;
}

bool holds_files(const fs::path& folder) {
  std::error_code error, ignored;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (!entry->is_directory(ignored)) return true;
  return false;
}

std::vector<fs::path> observations_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error, ignored;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (entry->path().extension() == ".json" && !entry->is_directory(ignored)) found.push_back(entry->path());
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<Job> jobs_of(const fs::path& folder, const std::vector<std::string>& without) {
  std::vector<Job> jobs;
  std::vector<std::string> names;
  for (const fs::path& room : folders_in(folder)) {
    const std::string name = room.filename().string();
    names.push_back(name);
    if (std::find(without.begin(), without.end(), name) != without.end()) continue;
    const std::vector<fs::path> people = folders_in(room);
    if (people.empty() || holds_files(room)) {
      jobs.push_back({name, room});
    } else {
      for (const fs::path& person : people) jobs.push_back({name, person});
    }
  }
  for (const fs::path& file : observations_in(folder)) {
    names.push_back(file.stem().string());
    if (std::find(without.begin(), without.end(), names.back()) == without.end())
      jobs.push_back({names.back(), file});
  }
  if (names.empty())
    throw InputError({folder.string()}, "there is no room in this folder",
                     "it should hold a folder for each scanned room: <room>/scan000.xyz, scan000.pose, …");
  for (const std::string& name : without)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InputError({folder.string()}, "there is no scanned room \"" + name + "\" to leave out",
                       "the rooms are the names of the folders in it");
  return jobs;
}

RoomObservation observed(const Job& job, const PerceptionOptions& options) {
  if (job.folder.extension() == ".json") return observation_from_json(read_file(job.folder), job.folder);
  return perceive_room(read_room_scans(job.folder), options);
}

std::string reason(const InputError& error) {
  const std::string place = to_string(error.place);
  return (place.empty() ? "" : place + ": ") + error.what() +
         (error.advice.empty() ? "" : "; " + error.advice);
}

}  // namespace

PerceivedFolder perceive_folder(const fs::path& folder, const std::vector<std::string>& without,
                                const PerceptionOptions& options, const RoomFinished& finished) {
  const std::vector<Job> jobs = jobs_of(folder, without);
  std::vector<std::optional<RoomObservation>> rooms(jobs.size());
  std::vector<std::string> faults(jobs.size());
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {
    try {
      rooms[i] = observed(jobs[i], options);
      rooms[i]->room = jobs[i].room;
    } catch (const InputError& error) {
      faults[i] = reason(error);
    } catch (const std::bad_alloc&) {
      faults[i] = "the memory does not suffice for this room; thin its scans";
    } catch (const fs::filesystem_error& error) {
      faults[i] = error.path1().string() + ": " + error.code().message();
    }
    if (finished) finished(jobs[i].room, jobs.size());
  });
  PerceivedFolder result;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (rooms[i])
      result.rooms.push_back(std::move(*rooms[i]));
    else
      result.set_aside.push_back({jobs[i].room, faults[i]});
  }
  return result;
}

}  // namespace gramap
