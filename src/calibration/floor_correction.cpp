#include "calibration/floor_correction.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>

#include "calibration/median.h"

namespace dominant_plane_detection {
namespace {

constexpr int kColumns = 20;  // [#] of cells: 32 px of an image 640 px wide
/// [-] of a cell that is floor, from which on it counts, and counts fully.
constexpr double kLittle = 0.25, kMuch = 0.5;
/// [-] against the weight 1 of one image: how smooth c is, and how small.
constexpr double kSmooth = 1.0, kSmall = 0.1;
/// [#] images that have to show a cell's floor; where fewer do, c is zero.
constexpr double kMinSeen = 3.0;
constexpr double kTiny = 1e-9;
constexpr std::size_t kMinImages = 10;
constexpr std::size_t kMinCells = 20;
constexpr std::size_t kFolds = 5;
/// [-] What a correction may leave of the floor's unevenness on images that it was not learned
/// from.
constexpr double kMostLeft = 0.75;

std::string sentence(const char* format, double first, double second) {
  char text[256];
  std::snprintf(text, sizeof(text), format, first, second);
  return text;
}

}  // namespace

/// Sums over the floor's readings in each cell of an image.
struct FloorCorrection::Sums {
  explicit Sums(Eigen::Index cells)
      : count(Eigen::VectorXd::Zero(cells)),
        weights(count),
        plane_weights(count),
        inverse_depth(count),
        ray(Eigen::MatrixX3d::Zero(cells, 3)) {}

  /// @param inverse_depth_over [1/m] of a reading, over the image's plane.
  void add(Eigen::Index cell, double z, const Eigen::Vector3d& reading_ray,
           double inverse_depth_over, const NoiseModel& noise) {
    // The error of 1 / z is sigma(z) / z^2, here as a share of what it is far away.
    const double weight = std::pow(noise.quadratic * z * z / noise.sigma(z), 2);
    count[cell] += 1.0;
    // c moves a point by z^2 c along the ray, and by z c times the distance along the normal.
    plane_weights[cell] += std::pow(z / noise.sigma(z), 2);
    weights[cell] += weight;
    inverse_depth[cell] += weight * inverse_depth_over;
    ray.row(cell) += weight * reading_ray.transpose();
  }

  Eigen::VectorXd count, weights, plane_weights, inverse_depth;
  Eigen::MatrixX3d ray;
};

void FloorCorrection::add(const DepthView& depth, const CameraModel& camera,
                          const Detection& detection) {
  if (!detection.found()) return;
  const int rows = std::max(1, (kColumns * depth.height + depth.width / 2) / depth.width);
  if (images_.empty()) {
    columns_ = kColumns;
    rows_ = rows;
  } else if (rows != rows_) {
    throw std::runtime_error("Expected images of one shape, got one of " +
                             std::to_string(depth.width) + " x " + std::to_string(depth.height) +
                             " pixels.");
  }
  rays_.build(camera);
  Sums sums(static_cast<Eigen::Index>(columns_) * rows_);
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < depth.width; ++u) {
      if (!detection.onPlane(u, v)) continue;
      const auto z = static_cast<double>(metresAt(depth, u, v));
      const Eigen::Vector3d ray = rays_.ray(u, v).cast<double>();
      const Eigen::Index row = static_cast<Eigen::Index>(v) * rows_ / depth.height;
      const Eigen::Index column = static_cast<Eigen::Index>(u) * columns_ / depth.width;
      sums.add(row * columns_ + column, z, ray,
               1.0 / z + detection.normal.dot(ray) / detection.distance, noise_);
    }
  }
  keep(sums, static_cast<double>(depth.width) * depth.height / (columns_ * rows_));
}

/// Keeps an image if enough of its cells show floor.
/// @param pixels [px] of a cell.
void FloorCorrection::keep(const Sums& sums, double pixels) {
  const Eigen::Index cells = sums.count.size();
  Image image{Eigen::VectorXd::Zero(cells), Eigen::VectorXd::Zero(cells),
              Eigen::VectorXd::Zero(cells), Eigen::MatrixX3d::Zero(cells, 3)};
  for (Eigen::Index cell = 0; cell < cells; ++cell) {
    const double count = sums.count[cell], weights = sums.weights[cell];
    if (count < kLittle * pixels) continue;
    image.weight[cell] = std::min(1.0, count / (kMuch * pixels)) * weights / count;
    image.plane_weight[cell] = sums.plane_weights[cell];
    image.inverse_depth[cell] = sums.inverse_depth[cell] / weights;
    image.ray.row(cell) = sums.ray.row(cell) / weights;
  }
  if (static_cast<std::size_t>((image.weight.array() > 0.0).count()) >= kMinCells) {
    images_.push_back(std::move(image));
  }
}

/// @return the quadratic form of how much c bends: the square of the grid's Laplacian.
Eigen::MatrixXd FloorCorrection::bending() const {
  const Eigen::Index cells = static_cast<Eigen::Index>(columns_) * rows_;
  Eigen::MatrixXd bend = Eigen::MatrixXd::Zero(cells, cells);
  const auto addEdge = [&](Eigen::Index a, Eigen::Index b) {
    bend(a, a) += 1.0;
    bend(b, b) += 1.0;
    bend(a, b) -= 1.0;
    bend(b, a) -= 1.0;
  };
  for (Eigen::Index row = 0; row < rows_; ++row) {
    for (Eigen::Index column = 0; column < columns_; ++column) {
      const Eigen::Index cell = row * columns_ + column;
      if (column + 1 < columns_) addEdge(cell, cell + 1);
      if (row + 1 < rows_) addEdge(cell, cell + columns_);
    }
  }
  return bend * bend;
}

/// @param bending see there.
/// @return [1/m] c of each cell.
Eigen::VectorXd FloorCorrection::solve(const std::vector<const Image*>& images,
                                       const Eigen::MatrixXd& bending) const {
  const Eigen::Index cells = static_cast<Eigen::Index>(columns_) * rows_;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(cells, cells);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(cells), seen = right;
  for (const Image* image : images) {
    const Eigen::MatrixX3d weighted = image->weight.asDiagonal() * image->ray;
    const Eigen::LDLT<Eigen::Matrix3d> plane(image->ray.transpose() * weighted);
    matrix -= weighted * plane.solve(weighted.transpose());
    matrix.diagonal() += image->weight;
    right += image->weight.cwiseProduct(image->inverse_depth) -
             weighted * plane.solve(weighted.transpose() * image->inverse_depth);
    seen.array() += (image->weight.array() > 0.0).cast<double>();
  }
  matrix += kSmooth * bending;
  matrix.diagonal().array() += kSmall;
  const Eigen::VectorXd correction = matrix.ldlt().solve(right);
  return (seen.array() >= kMinSeen).select(withoutPlanes(correction, images), 0.0);
}

/// @return c without what on average moves the planes of the images.
Eigen::VectorXd FloorCorrection::withoutPlanes(const Eigen::VectorXd& correction,
                                               const std::vector<const Image*>& images) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  Eigen::MatrixX3d ray = Eigen::MatrixX3d::Zero(correction.size(), 3);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(correction.size());
  for (const Image* image : images) {
    const Eigen::MatrixX3d weighted = image->plane_weight.asDiagonal() * image->ray;
    matrix += image->ray.transpose() * weighted;
    right += weighted.transpose() * correction;
    ray += weighted;
    weights += image->plane_weight;
  }
  ray.array().colwise() /= weights.array().max(kTiny);
  return correction - ray * matrix.ldlt().solve(right);
}

/// @return [1/m] rms of an image's corrected cells over the plane that fits them best.
double FloorCorrection::unevenness(const Image& image, const Eigen::VectorXd& correction) {
  const Eigen::VectorXd corrected = image.inverse_depth - correction;
  const Eigen::MatrixX3d weighted = image.weight.asDiagonal() * image.ray;
  const Eigen::Vector3d plane =
      (image.ray.transpose() * weighted).ldlt().solve(weighted.transpose() * corrected);
  const Eigen::VectorXd left = corrected - image.ray * plane;
  return std::sqrt(image.weight.dot(left.cwiseAbs2()) / image.weight.sum());
}

FloorCorrection::Result FloorCorrection::learn() const {
  const std::size_t count = images_.size();
  if (count < kMinImages) {
    throw std::runtime_error("Expected at least " + std::to_string(kMinImages) +
                             " images that show much ground, got " + std::to_string(count) + ".");
  }
  const Eigen::MatrixXd bending = this->bending();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(columns_) * rows_);
  std::vector<double> before, after;
  std::vector<const Image*> all;
  for (std::size_t fold = 0; fold < kFolds; ++fold) {
    const std::size_t begin = count * fold / kFolds, end = count * (fold + 1) / kFolds;
    std::vector<const Image*> learned_from;
    for (std::size_t i = 0; i < count; ++i) {
      if (i < begin || i >= end) learned_from.push_back(&images_[i]);
    }
    const Eigen::VectorXd correction = solve(learned_from, bending);
    for (std::size_t i = begin; i < end; ++i) {
      all.push_back(&images_[i]);
      before.push_back(unevenness(images_[i], none));
      after.push_back(unevenness(images_[i], correction));
    }
  }
  Result result{{columns_, rows_, {}}, median(before), median(after), count};
  if (!(result.after <= kMostLeft * result.before)) {
    throw std::runtime_error(sentence(
        "The error is not fixed to the pixels: on images that it is not learned from a correction "
        "leaves %.0f %% of the floor's unevenness, more than %.0f %%.",
        100.0 * result.after / result.before, 100.0 * kMostLeft));
  }
  const Eigen::VectorXd correction = solve(all, bending);
  result.grid.inverse_depth.assign(correction.data(), correction.data() + correction.size());
  return result;
}

}  // namespace dominant_plane_detection
