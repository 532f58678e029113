#include "core/plane_covariance.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/image_kernel.h"
#include "dominant_plane_detection/detection.h"

namespace dominant_plane_detection {
namespace {

/// [px] of an image 640 px wide: a cell's side, the length over which short waves are correlated,
/// exp(-d / l) along either axis, and that of wide ones, exp(-d^2 / 2 l^2). See docs/method.md.
constexpr double kSide = 32.0;
constexpr double kShort = 36.0;
constexpr double kWide = 150.0;
/// [-] in sigma(z): a tile whose mean is farther off shows something else as well.
constexpr double kFarthest = 3.0;
/// Smallest reciprocal condition of the normal equations that still tell a plane.
constexpr double kMinCondition = 1e-9;

/// @param cells [#] apart along an axis.
/// @param side [px] of one.
/// @return [-] between the means of two cells.
double shortCorrelation(int cells, double side) {
  if (cells == 0) return 1.0;
  const double falls = std::exp(-side / kShort);
  const double variance = 2.0 * (side / kShort - 1.0 + falls);
  return (1.0 - falls) * (1.0 - falls) * std::exp((1 - cells) * side / kShort) / variance;
}

double wideCorrelation(int cells, double side) {
  const double distance = cells * side;
  return std::exp(-0.5 * distance * distance / (kWide * kWide));
}

template <typename Correlation>
Eigen::MatrixXd correlationMatrix(int count, double side, Correlation correlation) {
  Eigen::MatrixXd matrix(count, count);
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) matrix(i, j) = correlation(std::abs(i - j), side);
  }
  return matrix;
}

}  // namespace

void PlaneCovariance::resize(const TileMoments& tiles, int image_width) {
  side_ = std::max(1, static_cast<int>(std::lround(kSide * image_width / 640.0 / kTileSize)));
  const int columns = covering(tiles.columns, side_), rows = covering(tiles.rows, side_);
  cells_.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), Cell());
  if (columns == columns_ && rows == rows_ && image_width == image_width_) return;
  const double side = side_ * kTileSize * 640.0 / image_width;  // [px] of an image 640 px wide
  short_ = {correlationMatrix(columns, side, shortCorrelation),
            correlationMatrix(rows, side, shortCorrelation)};
  wide_ = {correlationMatrix(columns, side, wideCorrelation),
           correlationMatrix(rows, side, wideCorrelation)};
  neighbours_ = shortCorrelation(1, side);
  values_.resize(rows, columns);
  along_rows_.resize(rows, columns);
  near_.resize(rows, columns);
  columns_ = columns;
  rows_ = rows;
  image_width_ = image_width;
}

/// @return the weighted moments of all points, of [x, y, z, 1].
Eigen::Matrix4d PlaneCovariance::addTiles(const TileMoments& tiles,
                                          const std::vector<std::uint8_t>& ground,
                                          const HessePlane& plane, const NoiseModel& noise) {
  Eigen::Matrix4d moments = Eigen::Matrix4d::Zero();
  for (int row = 0; row < tiles.rows; ++row) {
    for (int column = 0; column < tiles.columns; ++column) {
      const auto tile = static_cast<std::size_t>(row) * static_cast<std::size_t>(tiles.columns) +
                        static_cast<std::size_t>(column);
      if (!ground[tile] || !(tiles.count[tile] > 0.0F)) continue;
      const Eigen::Vector3d centre = tiles.centre(tile);
      const double sigma = noise.sigma(centre.z());
      if (std::abs(plane.signedDistance(centre)) > kFarthest * sigma) continue;
      const auto points = static_cast<double>(tiles.count[tile]);
      const Eigen::Vector4d homogeneous = centre.homogeneous();
      const Eigen::Vector4d weighted = points / (sigma * sigma) * homogeneous;
      moments.noalias() += weighted * homogeneous.transpose();
      Cell& cell = cells_[static_cast<std::size_t>(row / side_ * columns_ + column / side_)];
      cell.points += points;
      cell.sums += weighted;
    }
  }
  return moments;
}

/// @return [-] the variance of cells' means by short waves, in squares of `Cell::smooth`: half the
/// mean square of the differences between adjacent cells, which wide waves hardly move.
double PlaneCovariance::shortWaves() const {
  double squares = 0.0, weights = 0.0;
  const auto add = [&](const Cell& a, const Cell& b) {
    if (a.points == 0.0 || b.points == 0.0) return;
    const double difference = a.height / a.smooth - b.height / b.smooth;
    squares += a.points * b.points * difference * difference;
    weights += a.points * b.points;
  };
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Cell* cell = cells_.data() + static_cast<std::ptrdiff_t>(row) * columns_ + column;
      if (column + 1 < columns_) add(cell[0], cell[1]);
      if (row + 1 < rows_) add(cell[0], cell[columns_]);
    }
  }
  if (weights == 0.0) return 1.0;  // a plane within one cell: as the profile says
  return squares / weights / 2.0 / (1.0 - neighbours_);
}

/// @return J^T W E W J for the waves of a size.
Eigen::Matrix3d PlaneCovariance::spread(double Cell::*size, const Correlations& correlations) {
  const auto at = [&](int row, int column) -> const Cell& {
    return cells_[static_cast<std::size_t>(row * columns_ + column)];
  };
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) {
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        const Cell& cell = at(row, column);
        values_(row, column) = cell.*size * cell.jacobian[k];
      }
    }
    along_rows_.noalias() = values_ * correlations.columns;
    near_.noalias() = correlations.rows * along_rows_;
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        const Cell& cell = at(row, column);
        sum.col(k) += near_(row, column) * cell.*size * cell.jacobian;
      }
    }
  }
  return sum;
}

Eigen::Matrix4d PlaneCovariance::estimate(const TileMoments& tiles,
                                          const std::vector<std::uint8_t>& ground,
                                          const HessePlane& plane, const ErrorSizes& sizes,
                                          int image_width) {
  resize(tiles, image_width);
  const Eigen::Matrix4d moments = addTiles(tiles, ground, plane, sizes.noise);
  // h = p a + q b + c, with a and b along the plane from the camera's foot.
  const Eigen::Matrix<double, 4, 3> axes = planeChanges(plane.normal);
  const Eigen::LDLT<Eigen::Matrix3d> normal_equations(axes.transpose() * moments * axes);
  if (!(normal_equations.rcond() > kMinCondition)) return unknownCovariance();
  for (Cell& cell : cells_) {
    if (cell.points == 0.0) continue;
    const Eigen::Vector3d centre = cell.sums.hnormalized();
    cell.jacobian = axes.transpose() * cell.sums;
    cell.height = plane.signedDistance(centre);
    cell.smooth = sizes.smooth.sigma(centre.z());
    cell.wide = sizes.wide.size(centre.z(), std::abs(plane.normal.dot(centre)) / centre.norm());
  }
  const Eigen::Matrix3d errors =
      shortWaves() * spread(&Cell::smooth, short_) + spread(&Cell::wide, wide_);
  const Eigen::Matrix3d half = normal_equations.solve(errors);
  // That plane's normal is n - p a - q b, its distance d + c; published is the opposite normal, so
  // that a and b lead from (p, q) to it as they are.
  const Eigen::Matrix3d of_plane = normal_equations.solve(half.transpose());
  const Eigen::Matrix4d covariance = axes * of_plane * axes.transpose();
  // Seen edge-on, a plane's errors are infinite.
  if (!covariance.allFinite()) return unknownCovariance();
  return 0.5 * (covariance + covariance.transpose());  // symmetric to the last digit
}

}  // namespace dominant_plane_detection
