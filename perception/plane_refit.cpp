#include "perception/plane_refit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

#include "perception/plane_fit.h"

namespace gramap {
namespace {

constexpr std::size_t kBlock = 256;      // points whose distances are worked out together, axis by axis
constexpr std::size_t kChunk = 1 << 16;  // points of one task; the sums of tasks are added in order

/// What a plane is fitted to. Where two planes meet, each has points of the other in its band, all on one
/// side: those are counted, but not fitted to. The outermost sixth of the band is left to what is scattered
/// about.
struct Gathered {
  std::size_t support = 0;
  Moments own;       ///< nobody else's
  Moments disputed;  ///< near a plane that stands across, too
};
constexpr float kFittedBand = 5.0f / 6;
constexpr double kLeastOwnShare = 0.3;  // a narrow face may be nothing but meeting places

/// A patch with what the inner loop needs in single precision.
struct FastPatch {
  float nx, ny, nz, rho, band;
  Eigen::Vector3f u, v;  // per cell
  float u_corner, v_corner;
  const PlanePatch* patch;

  explicit FastPatch(const PlanePatch& p)
      : nx(static_cast<float>(p.normal.x())),
        ny(static_cast<float>(p.normal.y())),
        nz(static_cast<float>(p.normal.z())),
        rho(static_cast<float>(p.rho_m)),
        band(static_cast<float>(p.band_m)),
        u((p.u / p.cell_m).cast<float>()),
        v((p.v / p.cell_m).cast<float>()),
        u_corner(static_cast<float>(p.u.dot(p.corner) / p.cell_m)),
        v_corner(static_cast<float>(p.v.dot(p.corner) / p.cell_m)),
        patch(&p),
        widened(p.occupied.size()) {
    for (int row = 0; row < p.rows; ++row)
      for (int column = 0; column < p.columns; ++column)
        for (int r = std::max(0, row - 1); r <= std::min(p.rows - 1, row + 1); ++r)
          for (int c = std::max(0, column - 1); c <= std::min(p.columns - 1, column + 1); ++c)
            widened[static_cast<std::size_t>(row * p.columns + column)] |=
                p.occupied[static_cast<std::size_t>(r * p.columns + c)];
  }

  float distance(float x, float y, float z) const { return std::abs(nx * x + ny * y + nz * z - rho); }
  bool covers(float x, float y, float z) const { return at(patch->occupied, x, y, z); }
  /// On the patch or within a cell of it: a plane found after its neighbour lacks the strip where they meet.
  bool is_beside(float x, float y, float z) const { return at(widened, x, y, z); }

 private:
  std::vector<std::uint8_t> widened;

  bool at(const std::vector<std::uint8_t>& raster, float x, float y, float z) const {
    const float column = u.x() * x + u.y() * y + u.z() * z - u_corner,
                row = v.x() * x + v.y() * y + v.z() * z - v_corner;
    if (!(column >= 0 && row >= 0 && column < static_cast<float>(patch->columns) &&
          row < static_cast<float>(patch->rows)))
      return false;
    return raster[static_cast<std::size_t>(row) * static_cast<std::size_t>(patch->columns) +
                  static_cast<std::size_t>(column)] != 0;
  }
};

/// Which planes have a point within their bands: a bit for each of the first ones, the last bit for all
/// others.
using NearPlanes = std::uint32_t;
constexpr std::size_t kBits = 31;
NearPlanes bit_of(std::size_t plane) {
  return NearPlanes{1} << std::min(plane, kBits);
}

/// The nearest plane whose patch the point is on, or patches.size(); `disputed` when it is also on or
/// beside one that stands across.
std::size_t nearest_patch(const std::vector<FastPatch>& patches, NearPlanes asked, float x, float y, float z,
                          float& least, bool& disputed) {
  std::size_t best = patches.size(), near[8], count = 0;
  least = 1e30f;
  const auto look_at = [&](std::size_t k) {
    const float distance = patches[k].distance(x, y, z);
    if (distance > patches[k].band || !patches[k].is_beside(x, y, z)) return;
    if (count < std::size(near)) near[count++] = k;
    if (distance >= least || !patches[k].covers(x, y, z)) return;
    least = distance;
    best = k;
  };
  for (NearPlanes left = asked & (bit_of(kBits) - 1); left != 0; left &= left - 1)
    look_at(static_cast<std::size_t>(std::countr_zero(left)));
  if (asked & bit_of(kBits))
    for (std::size_t k = kBits; k < patches.size(); ++k) look_at(k);
  disputed = best < patches.size() && std::any_of(near, near + count, [&](std::size_t k) {
               return std::abs(patches[k].patch->normal.dot(patches[best].patch->normal)) < 0.5;
             });
  return best;
}

void add_chunk(const std::vector<FastPatch>& patches, std::span<const Point> points, const Point& centre,
               std::vector<Gathered>& gathered) {
  float x[kBlock], y[kBlock], z[kBlock], nearest[kBlock];
  std::int32_t owner[kBlock];
  NearPlanes near[kBlock];
  for (std::size_t begin = 0; begin < points.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, points.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      const Point& p = points[begin + i];
      x[i] = p.x() - centre.x();
      y[i] = p.y() - centre.y();
      z[i] = p.z() - centre.z();
      nearest[i] = 1e30f;
      owner[i] = -1;
      near[i] = 0;
    }
    // The nearest plane, and which are near, whether or not their patches are there: that is asked below.
    for (std::size_t k = 0; k < patches.size(); ++k) {
      const FastPatch& plane = patches[k];
      const std::size_t bit = std::min(k, kBits);
      for (std::size_t i = 0; i < count; ++i) {
        const float distance = std::abs(plane.nx * x[i] + plane.ny * y[i] + plane.nz * z[i] - plane.rho);
        const bool close = distance <= plane.band;
        const bool closer = (distance < nearest[i]) & close;
        near[i] |= static_cast<NearPlanes>(close) << bit;
        nearest[i] = closer ? distance : nearest[i];
        owner[i] = closer ? static_cast<std::int32_t>(k) : owner[i];
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (owner[i] < 0) continue;
      auto best = static_cast<std::size_t>(owner[i]);
      float distance = nearest[i];
      bool disputed = false;
      if ((near[i] & (near[i] - 1)) != 0 || near[i] == bit_of(kBits)) {
        best = nearest_patch(patches, near[i], x[i], y[i], z[i], distance, disputed);
        if (best == patches.size()) continue;
      } else if (!patches[best].covers(x[i], y[i], z[i])) {
        continue;
      }
      Gathered& plane = gathered[best];
      ++plane.support;
      if (distance > kFittedBand * patches[best].band) continue;
      const double px = static_cast<double>(x[i]), py = static_cast<double>(y[i]),
                   pz = static_cast<double>(z[i]);
      Moments& m = disputed ? plane.disputed : plane.own;
      m.weight += 1;
      m.sum.x() += px;
      m.sum.y() += py;
      m.sum.z() += pz;
      double* const o = m.outer.data();  // the lower triangle
      o[0] += px * px;
      o[1] += px * py;
      o[2] += px * pz;
      o[4] += py * py;
      o[5] += py * pz;
      o[8] += pz * pz;
    }
  }
}

}  // namespace

void refit_planes(std::vector<PlanePatch>& patches, std::span<const Point> points, const Point& centre) {
  if (patches.empty()) return;
  const std::vector<FastPatch> fast(patches.begin(), patches.end());
  const std::size_t chunks = (points.size() + kChunk - 1) / kChunk;
  std::vector<std::vector<Gathered>> of_chunk(chunks, std::vector<Gathered>(patches.size()));
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
    add_chunk(fast, points.subspan(c * kChunk, std::min(kChunk, points.size() - c * kChunk)), centre,
              of_chunk[c]);
  });
  for (std::size_t i = 0; i < patches.size(); ++i) {
    Gathered all;
    for (const std::vector<Gathered>& chunk : of_chunk) {
      all.support += chunk[i].support;
      all.own.add(chunk[i].own);
      all.disputed.add(chunk[i].disputed);
    }
    PlanePatch& patch = patches[i];
    patch.support = all.support;
    if (patch.support < 3) continue;
    Moments sum = all.own;
    if (sum.weight < std::max(3.0, kLeastOwnShare * static_cast<double>(all.support))) sum.add(all.disputed);
    if (sum.weight < 3) continue;
    sum.outer = Eigen::Matrix3d(sum.outer.selfadjointView<Eigen::Lower>());
    const FittedPlane plane = fit_plane(sum);
    const bool same =
        plane.normal.dot(patch.normal) > 0;  // a plane through the origin may come out turned round
    patch.normal = same ? plane.normal : -plane.normal;
    patch.rho_m = same ? plane.rho_m : -plane.rho_m;
    patch.rms_m = plane.rms_m;
  }
}

bool PlanePatch::covers(const Vec3& point) const {
  const Vec3 offset = point - corner;
  const double x = u.dot(offset) / cell_m, y = v.dot(offset) / cell_m;
  if (!(x >= 0 && y >= 0 && x < columns && y < rows)) return false;
  return occupied[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(x)] != 0;
}

}  // namespace gramap
