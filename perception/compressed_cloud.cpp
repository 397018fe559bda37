#include "perception/compressed_cloud.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "geometry/error.h"

namespace gramap {
namespace {

constexpr std::string_view kMagic = "GRAMAPC1";
constexpr int kMostLevels = 21;  // three times that are the bits of a voxel's key
constexpr std::uint64_t kMostNodes = std::uint64_t{1} << 31;
static_assert(std::endian::native == std::endian::little);

template <typename Number>
void put(std::string& bytes, Number number) {
  char own[sizeof number];
  std::memcpy(own, &number, sizeof number);
  bytes.append(own, sizeof number);
}

/// Interleaves the bits of a voxel's place: the key's octal digits are the way from the root.
std::uint64_t key_of(const std::uint64_t place[3], int levels) {
  std::uint64_t key = 0;
  for (int level = levels - 1; level >= 0; --level)
    for (int axis = 0; axis < 3; ++axis) key = key << 1 | (place[axis] >> level & 1);
  return key;
}

/// One byte a node, level by level, from the sorted keys of the leaves.
std::vector<unsigned char> nodes_of(const std::vector<std::uint64_t>& keys, int levels) {
  std::vector<unsigned char> nodes;
  for (int level = levels - 1; level >= 0; --level) {
    std::vector<unsigned char> of_level;
    std::uint64_t last = ~std::uint64_t{0};
    for (const std::uint64_t key : keys) {
      const std::uint64_t child = key >> (3 * level), node = child >> 3;
      if (node != last) of_level.push_back(0);
      last = node;
      of_level.back() = static_cast<unsigned char>(of_level.back() | 1 << (child & 7));
    }
    nodes.insert(nodes.end(), of_level.begin(), of_level.end());
  }
  return nodes;
}

/// Takes numbers from the front of the bytes.
class Reader {
 public:
  Reader(std::string_view bytes, const std::filesystem::path& name) : bytes_(bytes), name_(name) {}
  template <typename Number>
  Number get() {
    Number number{};
    if (bytes_.size() < sizeof number) fail("the file ends too early");
    std::memcpy(&number, bytes_.data(), sizeof number);
    bytes_.remove_prefix(sizeof number);
    return number;
  }
  std::string_view rest() const { return bytes_; }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError({name_.string()}, what,
                     "the file is damaged or was cut short; copy or compress it again");
  }

 private:
  std::string_view bytes_;
  const std::filesystem::path& name_;
};

}  // namespace

std::string compress_points(std::span<const Point> points, double resolution_m) {
  Eigen::Vector3d low = Vec3::Zero(), high = Vec3::Zero();
  if (!points.empty()) low = high = points.front().cast<double>();
  for (const Point& point : points) {
    low = low.cwiseMin(point.cast<double>());
    high = high.cwiseMax(point.cast<double>());
  }
  // The raster starts at a multiple of the resolution: a compressed scan is compressed again unchanged.
  for (double& coordinate : low) coordinate = std::floor(coordinate / resolution_m) * resolution_m;
  int levels = 0;
  while (levels <= kMostLevels && std::ldexp(resolution_m, levels) <= (high - low).maxCoeff()) ++levels;
  if (levels > kMostLevels) {
    char text[120];
    std::snprintf(text, sizeof text, "a cloud of %.0f m does not go into voxels of %g m",
                  (high - low).maxCoeff(), resolution_m);
    throw InputError({}, text, "choose a coarser --resolution");
  }
  std::vector<std::uint64_t> keys;
  keys.reserve(points.size());
  const std::uint64_t most = (std::uint64_t{1} << levels) - 1;
  for (const Point& point : points) {
    std::uint64_t place[3];
    for (int axis = 0; axis < 3; ++axis)
      place[axis] = std::min(most, static_cast<std::uint64_t>(std::max(
                                       0.0, (static_cast<double>(point[axis]) - low[axis]) / resolution_m)));
    keys.push_back(key_of(place, levels));
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  const std::vector<unsigned char> nodes = nodes_of(keys, levels);

  std::string bytes(kMagic);
  put(bytes, resolution_m);
  for (const double coordinate : low) put(bytes, coordinate);
  put(bytes, static_cast<std::uint8_t>(levels));
  put(bytes, static_cast<std::uint64_t>(keys.size()));
  put(bytes, static_cast<std::uint64_t>(nodes.size()));
  uLongf packed_size = compressBound(nodes.size());
  std::string packed(packed_size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &packed_size, nodes.data(), nodes.size(), 9) != Z_OK)
    throw std::bad_alloc();
  packed.resize(packed_size);
  bytes += packed;
  put(bytes, static_cast<std::uint32_t>(crc32_z(0, nodes.data(), nodes.size())));
  return bytes;
}

std::vector<Point> decompress_points(std::string_view bytes, const std::filesystem::path& name) {
  Reader reader(bytes, name);
  if (!bytes.starts_with(kMagic)) reader.fail("this is no compressed scan: it does not begin with GRAMAPC1");
  for (std::size_t i = 0; i < kMagic.size(); ++i) reader.get<char>();
  const auto resolution = reader.get<double>();
  Vec3 low;
  for (double& coordinate : low) coordinate = reader.get<double>();
  const int levels = reader.get<std::uint8_t>();
  const auto count = reader.get<std::uint64_t>(), node_count = reader.get<std::uint64_t>();
  if (!(resolution > 0 && resolution < 1e6) || !low.allFinite() || low.cwiseAbs().maxCoeff() > 1e9 ||
      levels > kMostLevels || (levels == 0 ? count > 1 || node_count : node_count == 0 && count > 0))
    reader.fail("the head of the file makes no sense");
  // Deflate packs by a factor of 1032 at most: what claims more is not worth the memory to find out.
  if (node_count > kMostNodes || node_count / 1040 > reader.rest().size() || count > 8 * node_count + 1)
    reader.fail("the file ends too early");
  if (reader.rest().size() < sizeof(std::uint32_t)) reader.fail("the file ends too early");
  const std::string_view packed = reader.rest().substr(0, reader.rest().size() - sizeof(std::uint32_t));
  std::uint32_t checksum;
  std::memcpy(&checksum, packed.data() + packed.size(), sizeof checksum);
  std::vector<unsigned char> nodes(node_count + 1);  // never empty, so that it has an address
  uLongf size = nodes.size();
  if (uncompress(nodes.data(), &size, reinterpret_cast<const Bytef*>(packed.data()), packed.size()) != Z_OK ||
      size != node_count || crc32_z(0, nodes.data(), node_count) != checksum)
    reader.fail("the file's checksum does not fit its content");

  std::vector<std::uint64_t> keys(count > 0 ? 1 : 0), next;
  std::size_t at = 0;
  for (int level = 0; level < levels && count > 0; ++level) {
    next.clear();
    for (const std::uint64_t key : keys) {
      if (at == node_count) reader.fail("the tree ends too early");
      for (unsigned child = 0; child < 8; ++child)
        if (nodes[at] >> child & 1) next.push_back(key << 3 | child);
      ++at;
    }
    keys.swap(next);
  }
  if (at != node_count || keys.size() != count)
    reader.fail("the tree does not have the points that it should");
  std::vector<Point> points;
  points.reserve(keys.size());
  for (const std::uint64_t key : keys) {
    std::uint64_t place[3] = {};
    for (int level = levels - 1; level >= 0; --level)
      for (int axis = 0; axis < 3; ++axis)
        place[axis] = place[axis] << 1 | (key >> (3 * level + 2 - axis) & 1);
    Vec3 centre;
    for (int axis = 0; axis < 3; ++axis)
      centre[axis] = low[axis] + resolution * (static_cast<double>(place[axis]) + 0.5);
    points.push_back(centre.cast<float>());
  }
  return points;
}

}  // namespace gramap
