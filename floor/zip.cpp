#include "floor/zip.h"

#include <zlib.h>

#include <cstdint>

#include "geometry/error.h"
#include "geometry/file.h"

namespace gramap {
namespace {

constexpr std::uint64_t kMost_bytes = std::uint64_t{1} << 30;
constexpr std::size_t kEndLength = 22, kEntryLength = 46, kLocalLength = 30;

/// The archive's bytes, little-endian, with every access checked.
struct Bytes {
  std::string path, all;

  [[noreturn]] void fail(const std::string& what,
                         const std::string& advice = "download or pack it again") const {
    throw InputError({path}, what, advice);
  }
  std::string_view at(std::uint64_t begin, std::uint64_t length) const {
    if (begin > all.size() || length > all.size() - begin) fail("the zip archive is cut off");
    return std::string_view(all).substr(begin, length);
  }
  std::uint32_t number(std::uint64_t begin, int bytes) const {
    const std::string_view text = at(begin, static_cast<std::uint64_t>(bytes));
    std::uint32_t value = 0;
    for (int i = bytes - 1; i >= 0; --i)
      value = value << 8 | static_cast<unsigned char>(text[static_cast<std::size_t>(i)]);
    return value;
  }
};

/// Where the record at the end of the archive begins; a comment of up to 64 KiB may follow it.
std::size_t end_record(const Bytes& zip) {
  const std::size_t at = zip.all.rfind("PK\x05\x06");
  if (at == std::string::npos || zip.all.size() - at < kEndLength)
    zip.fail("the zip archive has no directory");
  return at;
}

struct Entry {
  std::string name;
  std::uint32_t flags = 0, method = 0, checksum = 0, packed = 0, size = 0, header = 0;
};

std::string unpacked(const Bytes& zip, const Entry& entry) {
  constexpr std::uint32_t kStored = 0, kDeflated = 8;
  if (entry.flags & 1) zip.fail("'" + entry.name + "' is encrypted", "unpack the archive with its password");
  if (entry.method != kStored && entry.method != kDeflated)
    zip.fail("'" + entry.name + "' is packed by a method other than deflate",
             "unpack the archive into a folder, and give the folder");
  if (zip.at(entry.header, kLocalLength).substr(0, 4) != std::string_view("PK\x03\x04", 4))
    zip.fail("'" + entry.name + "' is not where the archive's directory says");
  const std::uint64_t data = std::uint64_t{entry.header} + kLocalLength + zip.number(entry.header + 26, 2) +
                             zip.number(entry.header + 28, 2);
  const std::string_view packed = zip.at(data, entry.packed);
  std::string bytes;
  if (entry.method == kStored) {
    bytes = packed;
  } else {
    // Deflate packs at most 1032 times; what says more is damaged.
    if (entry.size / 1032 > entry.packed + 1) zip.fail("'" + entry.name + "' is damaged");
    bytes.resize(entry.size);
    z_stream stream{};
    if (inflateInit2(&stream, -MAX_WBITS) != Z_OK)
      zip.fail("there is no memory to unpack '" + entry.name + "'");
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = entry.packed;
    stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
    stream.avail_out = entry.size;
    const int state = inflate(&stream, Z_FINISH);
    inflateEnd(&stream);
    if (state != Z_STREAM_END || stream.avail_out > 0) zip.fail("'" + entry.name + "' is damaged");
  }
  const uLong checksum =
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size()));
  if (bytes.size() != entry.size || checksum != entry.checksum) zip.fail("'" + entry.name + "' is damaged");
  return bytes;
}

}  // namespace

bool is_zip(std::string_view bytes) {
  return bytes.starts_with("PK\x03\x04");
}

std::map<std::string, std::string> read_zip(const std::filesystem::path& path,
                                            const std::function<bool(const std::string&)>& wanted) {
  const Bytes zip{path.string(), read_file(path)};
  const std::size_t end = end_record(zip);
  const std::uint32_t count = zip.number(end + 10, 2);
  std::uint64_t at = zip.number(end + 16, 4);
  if (count == 0xffff || at == 0xffffffff)
    zip.fail("the zip archive is larger than 4 GiB", "unpack it into a folder, and give the folder");
  std::map<std::string, std::string> files;
  std::uint64_t total = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (zip.at(at, kEntryLength).substr(0, 4) != std::string_view("PK\x01\x02", 4))
      zip.fail("the zip archive's directory is damaged");
    Entry entry;
    entry.flags = zip.number(at + 8, 2);
    entry.method = zip.number(at + 10, 2);
    entry.checksum = zip.number(at + 16, 4);
    entry.packed = zip.number(at + 20, 4);
    entry.size = zip.number(at + 24, 4);
    entry.header = zip.number(at + 42, 4);
    const std::uint32_t name = zip.number(at + 28, 2);
    entry.name = zip.at(at + kEntryLength, name);
    at += kEntryLength + name + zip.number(at + 30, 2) + zip.number(at + 32, 2);
    if (!wanted(entry.name)) continue;
    total += entry.size;
    if (total > kMost_bytes) zip.fail("the zip archive's files are larger than 1 GiB", "give a smaller plan");
    files[entry.name] = unpacked(zip, entry);
  }
  return files;
}

}  // namespace gramap
