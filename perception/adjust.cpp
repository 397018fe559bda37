#include "perception/adjust.h"

#include <algorithm>
#include <cmath>

namespace gramap {
namespace {

using Row = Eigen::Matrix<double, 9,
                          1>;  // derivatives by the scan's shift and turn, and the plane's offset and slopes
using Block = Eigen::Matrix<double, 9, 9>;
using Pose = Eigen::Matrix<double, 6, 1>;
using PoseBlock = Eigen::Matrix<double, 6, 6>;

/// One scan's view of one plane: weighted sums over its points.
struct View {
  double count = 0, weight = 0;
  Block outer = Block::Zero();
  Row right = Row::Zero();

  /// Points average their own noise, never what the whole view has in common.
  double share(double systematic_m) const { return 1 / (1 + weight * systematic_m * systematic_m); }

  /// Of the weighted mean of its points, each as `outer`'s.
  Row mean_row() const { return -outer.col(6) / weight; }
  double mean_residual() const { return right[6] / weight; }
};

}  // namespace

Adjustment adjust(std::vector<AdjustedPlane>& planes, const std::vector<PlanePoint>& points,
                  const std::vector<Vec3>& scanners, const AdjustOptions& options) {
  const std::size_t parts = scanners.size(), count = planes.size();
  std::vector<View> views(parts * count);
  for (const PlanePoint& point : points) {
    const AdjustedPlane& plane = planes[point.plane];
    const Vec3 offset = point.point_m - plane.middle, arm = point.point_m - scanners[point.part];
    const double residual = plane.normal.dot(offset);
    Row row;
    row << plane.normal, arm.cross(plane.normal), -1, -plane.u.dot(offset), -plane.v.dot(offset);
    View& view = views[point.part * count + point.plane];
    const double weight = 1 / (point.sigma_m * point.sigma_m);
    view.count += 1;
    view.weight += weight;
    const Row weighted = weight * row;
    for (int j = 0; j < 9; ++j)
      for (int i = j; i < 9; ++i) view.outer(i, j) += weighted[i] * row[j];
    view.right -= residual * weighted;
  }
  for (View& view : views) view.outer = view.outer.selfadjointView<Eigen::Lower>();

  const auto size = static_cast<Eigen::Index>(3 * count);
  Adjustment result;
  double shift = options.start_shift_m, turn = options.start_turn_rad,
         systematic = options.start_systematic_m;
  std::vector<Pose> poses(parts, Pose::Zero());
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(size);
  Eigen::MatrixXd covariance;
  for (int round = 0; round < 8; ++round) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
    for (std::size_t p = 0; p < count; ++p) {
      const auto at = static_cast<Eigen::Index>(3 * p);
      normal(at, at) += 1;  // a metre: nothing is known of the place
      normal(at + 1, at + 1) += 1 / (planes[p].u_slope_sigma * planes[p].u_slope_sigma);
      normal(at + 2, at + 2) += 1 / (planes[p].v_slope_sigma * planes[p].v_slope_sigma);
    }
    // The scans' corrections are eliminated one by one (Schur complement): the cost grows with scans, not
    // their cube.
    std::vector<PoseBlock> inverse(parts);
    std::vector<Eigen::MatrixXd> coupling(parts);
    std::vector<Pose> pose_right(parts, Pose::Zero());
    for (std::size_t k = 0; k < parts; ++k) {
      PoseBlock own = PoseBlock::Zero();
      own.diagonal().head<3>().setConstant(1 / (shift * shift));
      own.diagonal().tail<3>().setConstant(1 / (turn * turn));
      coupling[k] = Eigen::MatrixXd::Zero(6, size);
      for (std::size_t p = 0; p < count; ++p) {
        const View& view = views[k * count + p];
        if (view.count < 5) continue;
        const double weight = view.share(systematic);
        const auto at = static_cast<Eigen::Index>(3 * p);
        own += weight * view.outer.topLeftCorner<6, 6>();
        coupling[k].middleCols<3>(at) += weight * view.outer.topRightCorner<6, 3>();
        normal.block<3, 3>(at, at) += weight * view.outer.bottomRightCorner<3, 3>();
        pose_right[k] += weight * view.right.head<6>();
        right.segment<3>(at) += weight * view.right.tail<3>();
      }
      inverse[k] = own.inverse();
      normal -= coupling[k].transpose() * inverse[k] * coupling[k];
      right -= coupling[k].transpose() * (inverse[k] * pose_right[k]);
    }
    covariance = normal.inverse();
    moved = covariance * right;
    double shifts = 0, turns = 0;
    double squares = options.systematic_worth * options.systematic_m * options.systematic_m,
           views_seen = options.systematic_worth;
    for (std::size_t k = 0; k < parts; ++k) {
      poses[k] = inverse[k] * (pose_right[k] - coupling[k] * moved);
      const Eigen::MatrixXd through = inverse[k] * coupling[k];
      const PoseBlock pose_covariance = inverse[k] + through * covariance * through.transpose();
      const Pose variance = pose_covariance.diagonal();
      shifts += poses[k].head<3>().squaredNorm() + variance.head<3>().sum();
      turns += poses[k].tail<3>().squaredNorm() + variance.tail<3>().sum();
      for (std::size_t p = 0; p < count; ++p) {
        const View& view = views[k * count + p];
        if (view.count < 5) continue;
        // What the view is off by in common: expected square given where scan and plane are, which is
        // uncertain.
        const auto at = static_cast<Eigen::Index>(3 * p);
        const Row row = view.mean_row();
        const auto of_pose = row.head<6>();
        const auto of_plane = row.tail<3>();
        const double residual =
            view.mean_residual() + of_pose.dot(poses[k]) + of_plane.dot(moved.segment<3>(at));
        const double uncertain = of_pose.dot(pose_covariance * of_pose) -
                                 2 * of_pose.dot(through * covariance.middleCols<3>(at) * of_plane) +
                                 of_plane.dot(covariance.block<3, 3>(at, at) * of_plane);
        const double common = 1 - view.share(systematic);
        squares += common * common * (residual * residual + uncertain) +
                   systematic * systematic * view.share(systematic);
        views_seen += 1;
      }
    }
    systematic = std::sqrt(squares / views_seen);
    if (parts > 1) {
      shift = std::clamp(std::sqrt(shifts / (3 * static_cast<double>(parts))), 0.0005, 0.1);
      turn = std::clamp(std::sqrt(turns / (3 * static_cast<double>(parts))), 0.0002, 0.05);
    }
  }

  result.systematic_m = systematic;
  result.shift_sigma_m = shift;
  result.turn_sigma_rad = turn;
  for (std::size_t k = 0; k < parts; ++k) {
    const Vec3 axis = poses[k].tail<3>();
    Eigen::Isometry3d correction = Eigen::Isometry3d::Identity();
    if (axis.norm() > 0)
      correction.linear() = Eigen::AngleAxisd(axis.norm(), axis.normalized()).toRotationMatrix();
    correction.translation() = poses[k].head<3>() + scanners[k] - correction.linear() * scanners[k];
    result.corrected_from_registered.push_back(correction);
  }
  result.covariance.resize(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(count));
  for (std::size_t p = 0; p < count; ++p) {
    const auto at = static_cast<Eigen::Index>(3 * p);
    AdjustedPlane& plane = planes[p];
    plane.middle += moved[at] * plane.normal;
    plane.normal = (plane.normal - moved[at + 1] * plane.u - moved[at + 2] * plane.v).normalized();
    plane.u = (plane.u - plane.normal * plane.normal.dot(plane.u)).normalized();
    plane.v = plane.normal.cross(plane.u) * (plane.normal.cross(plane.u).dot(plane.v) > 0 ? 1 : -1);
    for (std::size_t q = 0; q < count; ++q)
      result.covariance(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(q)) =
          covariance(at, static_cast<Eigen::Index>(3 * q));
  }
  std::vector<double> squares(count);
  for (AdjustedPlane& plane : planes) plane.support = 0;
  for (const PlanePoint& point : points) {
    const double distance = residual_m(point, planes, result.corrected_from_registered);
    squares[point.plane] += distance * distance;
    ++planes[point.plane].support;
  }
  for (std::size_t p = 0; p < count; ++p)
    planes[p].rms_m = planes[p].support ? std::sqrt(squares[p] / static_cast<double>(planes[p].support)) : 0;
  return result;
}

}  // namespace gramap
