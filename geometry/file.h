// Reading whole files, and writing them so that a failure leaves the old one untouched.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gramap {

/// The bytes of a file. Throws InputError naming the file and the system's reason.
std::string read_file(const std::filesystem::path& path);

/// Replaces `path` with `bytes`: written beside under a temporary name, flushed to disk, renamed. On any
/// failure (missing folder, full disk, no permission) throws InputError, removes the temporary file and
/// leaves an existing `path` as it was. The path "-" means standard output.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Makes a folder and those above it, where they are not there. Throws InputError with the system's reason.
void make_folder(const std::filesystem::path& folder);

/// Throws InputError when `name`, out of an input, cannot be the name of a file in a folder of ours: empty,
/// "." or "..", with a "/" or a control character. `place` is the input it comes from.
void check_file_name(const std::string& name, const std::string& place);

/// 64-bit FNV-1a hash as 16 hexadecimal digits, for naming inputs in outputs (not for security).
std::string hash_hex(std::string_view bytes);

}  // namespace gramap
