// Files out of a zip archive (PKWARE's APPNOTE 6.3.3, sections 4.3 to 4.5): stored or deflated, as every
// common program writes them. IMDF is handed out so.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace gramap {

/// True for bytes that begin as a zip archive does.
bool is_zip(std::string_view bytes);

/// The bytes of the archive's files whose names, with their folders, are `wanted`. Throws InputError for an
/// archive that is cut off or damaged (checksums are compared), encrypted, of more than 4 GiB (zip64), or
/// whose wanted files are larger than a GiB together.
std::map<std::string, std::string> read_zip(const std::filesystem::path& path,
                                            const std::function<bool(const std::string&)>& wanted);

}  // namespace gramap
