// Room scans packed for upload: an octree of the occupied voxels, coded breadth first, behind gzip's deflate.
//
// A file holds one scan: its points move to the centres of the voxels that they fall into, points of one
// voxel become one. Breadth first, every node is a byte with a bit a child (as in Schnabel and Klein,
// Octree-based point-cloud compression, Eurographics Symposium on Point-Based Graphics, 2006); deflate finds
// what the bytes of smooth surfaces have in common.
//
// Layout, little endian: "GRAMAPC1"; resolution_m as a double; three doubles, the corner of the root; one
// byte, the depth of the tree (0 to 21); a 64-bit number of points; a 64-bit number of node bytes; the node
// bytes, deflated by zlib; a 32-bit CRC of the node bytes as they were before.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "perception/scan.h"

namespace gramap {

/// The bytes of a compressed scan. `resolution_m` is the voxels' edge: a point moves by at most 0.87 of it.
/// Throws InputError for a resolution that is too fine for the extent of the cloud.
std::string compress_points(std::span<const Point> points_m, double resolution_m);

/// The points of compress_points' bytes, one a voxel, in the order of the tree. `name` is used in messages;
/// throws InputError for every fault of the bytes.
std::vector<Point> decompress_points(std::string_view bytes, const std::filesystem::path& name);

}  // namespace gramap
