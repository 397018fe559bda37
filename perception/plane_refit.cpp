#include "perception/plane_refit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "perception/plane_fit.h"

namespace gramap {
namespace {

constexpr std::size_t kBlock = 256;      // points whose distances are worked out together, axis by axis
constexpr std::size_t kChunk = 1 << 16;  // points of one task; the sums of tasks are added in order

/// A patch with what the inner loop needs in single precision.
struct FastPatch {
  float nx, ny, nz, rho, band;
  Eigen::Vector3f u, v;
  float u_corner, v_corner, cells_per_m;
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
        cells_per_m(static_cast<float>(1 / p.cell_m)),
        patch(&p) {}

  bool covers(float x, float y, float z) const {
    const float column = u.x() * x + u.y() * y + u.z() * z - u_corner,
                row = v.x() * x + v.y() * y + v.z() * z - v_corner;
    if (!(column >= 0 && row >= 0 && column < static_cast<float>(patch->columns) &&
          row < static_cast<float>(patch->rows)))
      return false;
    return patch->occupied[static_cast<std::size_t>(row) * static_cast<std::size_t>(patch->columns) +
                           static_cast<std::size_t>(column)] != 0;
  }
};

void add_chunk(const std::vector<FastPatch>& patches, std::span<const Point> points, const Point& centre,
               std::vector<Moments>& moments) {
  float x[kBlock], y[kBlock], z[kBlock], nearest[kBlock];
  std::int32_t owner[kBlock];
  for (std::size_t begin = 0; begin < points.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, points.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      const Point& p = points[begin + i];
      x[i] = p.x() - centre.x();
      y[i] = p.y() - centre.y();
      z[i] = p.z() - centre.z();
      nearest[i] = 1e30f;
      owner[i] = -1;
    }
    // The nearest plane, whether or not its patch is there: in a corner of patches that is asked below.
    for (std::size_t k = 0; k < patches.size(); ++k) {
      const FastPatch& plane = patches[k];
      for (std::size_t i = 0; i < count; ++i) {
        const float distance = std::abs(plane.nx * x[i] + plane.ny * y[i] + plane.nz * z[i] - plane.rho);
        const bool closer = (distance < nearest[i]) & (distance <= plane.band);
        nearest[i] = closer ? distance : nearest[i];
        owner[i] = closer ? static_cast<std::int32_t>(k) : owner[i];
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (owner[i] < 0) continue;
      auto best = static_cast<std::size_t>(owner[i]);
      if (!patches[best].covers(x[i], y[i], z[i])) {
        best = patches.size();
        float least = 1e30f;
        for (std::size_t k = 0; k < patches.size(); ++k) {
          const FastPatch& plane = patches[k];
          const float distance = std::abs(plane.nx * x[i] + plane.ny * y[i] + plane.nz * z[i] - plane.rho);
          if (distance < least && distance <= plane.band && plane.covers(x[i], y[i], z[i])) {
            least = distance;
            best = k;
          }
        }
        if (best == patches.size()) continue;
      }
      const double px = static_cast<double>(x[i]), py = static_cast<double>(y[i]),
                   pz = static_cast<double>(z[i]);
      Moments& m = moments[best];
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
  std::vector<std::vector<Moments>> of_chunk(chunks, std::vector<Moments>(patches.size()));
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
    add_chunk(fast, points.subspan(c * kChunk, std::min(kChunk, points.size() - c * kChunk)), centre,
              of_chunk[c]);
  });
  for (std::size_t i = 0; i < patches.size(); ++i) {
    Moments sum;
    for (const std::vector<Moments>& chunk : of_chunk) sum.add(chunk[i]);
    sum.outer = Eigen::Matrix3d(sum.outer.selfadjointView<Eigen::Lower>());
    PlanePatch& patch = patches[i];
    patch.support = static_cast<std::size_t>(sum.weight);
    if (patch.support < 3) continue;
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
