#include "geometry/watertight.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "geometry/sets.h"

namespace gramap {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 cgal(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

/// The mesh with points of equal coordinates made one.
Mesh welded(const Mesh& mesh) {
  Mesh result;
  std::map<std::tuple<double, double, double>, int> index;
  std::vector<int> to(mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vec3& p = mesh.points[i];
    const auto [entry, is_new] =
        index.try_emplace({p.x(), p.y(), p.z()}, static_cast<int>(result.points.size()));
    if (is_new) result.points.push_back(p);
    to[i] = entry->second;
  }
  for (const Triangle& t : mesh.triangles) result.triangles.push_back({to[t[0]], to[t[1]], to[t[2]]});
  return result;
}

class Check {
 public:
  Check(const Mesh& mesh, int limit) : mesh_(welded(mesh)), limit_(limit) {}

  std::vector<MeshFault> run() {
    for (const Vec3& p : mesh_.points)
      if (!p.allFinite()) fault(MeshFault::Kind::not_finite, p);
    if (!faults_.empty()) return faults_;
    triangles();
    if (faults_.empty()) edges();
    if (faults_.empty()) {
      umbrellas();
      shells();
      self_intersections();
    }
    return faults_;
  }

 private:
  void fault(MeshFault::Kind kind, const Vec3& at) {
    if (static_cast<int>(faults_.size()) < limit_) faults_.push_back({kind, at});
  }
  const Vec3& point(int triangle, int k) const { return mesh_.points[mesh_.triangles[triangle][k]]; }

  void triangles() {
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t)
      if (CGAL::collinear(cgal(point(t, 0)), cgal(point(t, 1)), cgal(point(t, 2))))
        fault(MeshFault::Kind::degenerate, point(t, 0));
  }

  void edges() {
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t)
      for (int k = 0; k < 3; ++k)
        if (!triangle_of_.try_emplace({mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]}, t).second) {
          // The same directed edge twice: neighbours that disagree on the side, or more than two faces.
          const bool reversed = triangle_of_.count({mesh_.triangles[t][(k + 1) % 3], mesh_.triangles[t][k]});
          fault(reversed ? MeshFault::Kind::non_manifold : MeshFault::Kind::orientation, point(t, k));
        }
    for (const auto& [edge, t] : triangle_of_)
      if (!triangle_of_.count({edge.second, edge.first}))
        fault(MeshFault::Kind::open_edge, mesh_.points[edge.first]);
  }

  /// Around every point the triangles form one fan.
  void umbrellas() {
    std::vector<int> count(mesh_.points.size(), 0), start(mesh_.points.size(), -1);
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t)
      for (const int p : mesh_.triangles[t]) ++count[p], start[p] = t;
    for (int p = 0; p < static_cast<int>(mesh_.points.size()); ++p) {
      if (start[p] < 0) continue;
      int t = start[p], steps = 0;
      do {  // turn about p: over the edge that leaves p
        const Triangle& corners = mesh_.triangles[t];
        const int k = static_cast<int>(std::find(corners.begin(), corners.end(), p) - corners.begin());
        t = triangle_of_.at({corners[(k + 1) % 3], p});
        ++steps;
      } while (t != start[p] && steps <= count[p]);
      if (steps != count[p]) fault(MeshFault::Kind::non_manifold, mesh_.points[p]);
    }
  }

  /// Every connected shell encloses a positive volume.
  void shells() {
    Sets sets(mesh_.triangles.size());
    for (const auto& [edge, t] : triangle_of_) sets.join(t, triangle_of_.at({edge.second, edge.first}));
    std::map<int, Mesh> shells;
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) {
      Mesh& shell = shells[sets.find(t)];
      for (int k = 0; k < 3; ++k) shell.points.push_back(point(t, k));
      const int first = static_cast<int>(shell.points.size()) - 3;
      shell.triangles.push_back({first, first + 1, first + 2});
    }
    for (const auto& [root, shell] : shells)
      if (!(signed_volume(shell) > 0)) fault(MeshFault::Kind::inside_out, point(root, 0));
  }

  void self_intersections() {
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;
    std::vector<Box> boxes;
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) {
      // The search divides the last dimension first: heights, of which there are few, must not come last.
      const Vec3 low = point(t, 0).cwiseMin(point(t, 1)).cwiseMin(point(t, 2));
      const Vec3 high = point(t, 0).cwiseMax(point(t, 1)).cwiseMax(point(t, 2));
      double from[] = {low.z(), low.x(), low.y()}, to[] = {high.z(), high.x(), high.y()};
      boxes.emplace_back(from, to, t);
    }
    std::vector<int> found;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
      if (intersect(a.info(), b.info())) found.push_back(std::min(a.info(), b.info()));
    });
    std::sort(found.begin(), found.end());
    for (const int triangle : found) fault(MeshFault::Kind::self_intersection, point(triangle, 0));
  }

  /// The axis along which all corners of both triangles have the same coordinate; -1 when there is none.
  int level_axis(int s, int t) const {
    for (int axis = 2; axis >= 0; --axis) {
      const double at = point(s, 0)[axis];
      if (point(s, 1)[axis] == at && point(s, 2)[axis] == at && point(t, 0)[axis] == at &&
          point(t, 1)[axis] == at && point(t, 2)[axis] == at)
        return axis;
    }
    return -1;
  }

  /// True when two triangles meet anywhere but in the corners and edges that they share.
  bool intersect(int s, int t) const {
    const Triangle &a = mesh_.triangles[s], &b = mesh_.triangles[t];
    // Corners in both, and the others of each.
    std::array<int, 3> shared{}, only_a{}, only_b{};
    int shared_count = 0, a_count = 0, b_count = 0;
    for (const int p : a) {
      if (std::find(b.begin(), b.end(), p) != b.end())
        shared[shared_count++] = p;
      else
        only_a[a_count++] = p;
    }
    for (const int p : b)
      if (std::find(a.begin(), a.end(), p) == a.end()) only_b[b_count++] = p;
    if (shared_count == 3) return true;

    const auto at = [this](int p) { return cgal(mesh_.points[p]); };
    if (shared_count < 2) {
      const Kernel::Triangle_3 face_a(at(a[0]), at(a[1]), at(a[2])), face_b(at(b[0]), at(b[1]), at(b[2]));
      if (shared_count == 0) return CGAL::do_intersect(face_a, face_b);
      // The edge opposite the shared corner must stay clear of the other triangle.
      return CGAL::do_intersect(Kernel::Segment_3(at(only_a[0]), at(only_a[1])), face_b) ||
             CGAL::do_intersect(Kernel::Segment_3(at(only_b[0]), at(only_b[1])), face_a);
    }
    // An edge in common: they overlap only when folded onto each other.
    if (const int axis = level_axis(s, t); axis >= 0) {  // most often; then doubles decide, not exact numbers
      const auto in_plane = [&](int p) {
        const Vec3& q = mesh_.points[p];
        return Kernel::Point_2(q[(axis + 1) % 3], q[(axis + 2) % 3]);
      };
      return CGAL::orientation(in_plane(shared[0]), in_plane(shared[1]), in_plane(only_a[0])) ==
             CGAL::orientation(in_plane(shared[0]), in_plane(shared[1]), in_plane(only_b[0]));
    }
    return CGAL::coplanar(at(shared[0]), at(shared[1]), at(only_a[0]), at(only_b[0])) &&
           CGAL::coplanar_orientation(at(shared[0]), at(shared[1]), at(only_a[0]), at(only_b[0])) ==
               CGAL::POSITIVE;
  }

  Mesh mesh_;
  int limit_;
  std::map<std::pair<int, int>, int> triangle_of_;  ///< by directed edge
  std::vector<MeshFault> faults_;
};

}  // namespace

const char* to_string(MeshFault::Kind kind) {
  switch (kind) {
    case MeshFault::Kind::open_edge:
      return "open edge";
    case MeshFault::Kind::non_manifold:
      return "not a 2-manifold";
    case MeshFault::Kind::orientation:
      return "neighbouring faces with opposite orientation";
    case MeshFault::Kind::degenerate:
      return "triangle without area";
    case MeshFault::Kind::inside_out:
      return "shell that faces inward";
    case MeshFault::Kind::self_intersection:
      return "self-intersection";
    case MeshFault::Kind::not_finite:
      return "coordinate that is not finite";
  }
  return "";
}

std::vector<MeshFault> check_solid(const Mesh& mesh, int limit) {
  return Check(mesh, limit).run();
}

}  // namespace gramap
