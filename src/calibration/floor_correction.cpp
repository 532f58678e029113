#include "calibration/floor_correction.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "core/ray_table.h"

namespace dominant_plane_detection {
namespace {

constexpr int kColumns = 20;  // [#] of cells: 32 px of an image 640 px wide
/// [-] of a cell that is floor, from which on it counts, and counts fully.
constexpr double kLittle = 0.25, kMuch = 0.5;
/// [-] against the weight 1 of one image: how smooth c is, and how small.
constexpr double kSmooth = 1.0, kSmall = 0.1;
/// [#] images that have to show a cell; where fewer do, c is zero.
constexpr double kMinSeen = 3.0;
constexpr double kTiny = 1e-9;
constexpr std::size_t kMinImages = 10;
constexpr std::size_t kMinCells = 20;
constexpr std::size_t kFolds = 5;
/// [-] What a correction may leave of the floor's unevenness on images that it was not learned
/// from.
constexpr double kMostLeft = 0.75;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string sentence(const char* format, double first, double second) {
  char text[256];
  std::snprintf(text, sizeof(text), format, first, second);
  return text;
}

}  // namespace

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
  RayTable rays;
  rays.build(camera);
  const Eigen::Index cells = static_cast<Eigen::Index>(columns_) * rows_;
  Eigen::VectorXd count = Eigen::VectorXd::Zero(cells), weights = count, sum = count;
  Eigen::VectorXd plane_weights = count;
  Eigen::MatrixX3d ray = Eigen::MatrixX3d::Zero(cells, 3);
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < depth.width; ++u) {
      if (detection.label(u, v) != Label::kGround) continue;
      const Eigen::Index cell = static_cast<Eigen::Index>(v * rows_ / depth.height) * columns_ +
                                u * columns_ / depth.width;
      const auto z = static_cast<double>(metresAt(depth, u, v));
      if (!(z > 0.0)) continue;  // a ramp's or a hole's pixel need not have a reading
      const Eigen::Vector3d r = rays.ray(u, v).cast<double>();
      const double weight = std::pow(noise_.quadratic * z * z / noise_.sigma(z), 2);
      count[cell] += 1.0;
      // c moves a point by z^2 c along the ray, and by z c times the distance along the normal.
      plane_weights[cell] += std::pow(z / noise_.sigma(z), 2);
      weights[cell] += weight;
      sum[cell] += weight * (1.0 / z + detection.normal.dot(r) / detection.distance);
      ray.row(cell) += weight * r.transpose();
    }
  }
  Image image{Eigen::VectorXd::Zero(cells), plane_weights, Eigen::VectorXd::Zero(cells),
              Eigen::MatrixX3d::Zero(cells, 3)};
  const double pixels =
      static_cast<double>(depth.width) * depth.height / static_cast<double>(cells);
  for (Eigen::Index cell = 0; cell < cells; ++cell) {
    if (count[cell] < kLittle * pixels) continue;
    image.weight[cell] =
        std::min(1.0, count[cell] / (kMuch * pixels)) * weights[cell] / count[cell];
    image.inverse_depth[cell] = sum[cell] / weights[cell];
    image.ray.row(cell) = ray.row(cell) / weights[cell];
  }
  if (static_cast<std::size_t>((image.weight.array() > 0.0).count()) >= kMinCells) {
    images_.push_back(std::move(image));
  }
}

/// @return [1/m] c of each cell.
Eigen::VectorXd FloorCorrection::solve(const std::vector<const Image*>& images) const {
  const Eigen::Index cells = static_cast<Eigen::Index>(columns_) * rows_;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(cells, cells);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(cells), seen = right;
  Eigen::MatrixX3d ray = Eigen::MatrixX3d::Zero(cells, 3);
  for (const Image* image : images) {
    const Eigen::MatrixX3d weighted = image->weight.asDiagonal() * image->ray;
    const Eigen::LDLT<Eigen::Matrix3d> plane(image->ray.transpose() * weighted);
    matrix -= weighted * plane.solve(weighted.transpose());
    matrix.diagonal() += image->weight;
    right += image->weight.cwiseProduct(image->inverse_depth) -
             weighted * plane.solve(weighted.transpose() * image->inverse_depth);
    ray += weighted;
    seen += image->weight;
  }
  Eigen::MatrixXd bend = Eigen::MatrixXd::Zero(cells, cells);  // the grid's Laplacian
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
  matrix += kSmooth * bend * bend;
  matrix.diagonal().array() += kSmall;
  Eigen::VectorXd correction = matrix.ldlt().solve(right);
  correction = (seen.array() >= kMinSeen).select(correction, 0.0);
  Eigen::Vector3d moved = Eigen::Vector3d::Zero();
  for (const Image* image : images) {
    const Eigen::VectorXd known = (image->weight.array() > 0.0).select(image->plane_weight, 0.0);
    const Eigen::MatrixX3d weighted = known.asDiagonal() * image->ray;
    moved += (image->ray.transpose() * weighted).ldlt().solve(weighted.transpose() * correction);
  }
  ray.array().colwise() /= seen.array().max(kTiny);
  correction -= ray * moved / static_cast<double>(images.size());
  return (seen.array() >= kMinSeen).select(correction, 0.0);
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
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(columns_) * rows_);
  std::vector<double> before, after;
  std::vector<const Image*> all;
  for (std::size_t fold = 0; fold < kFolds; ++fold) {
    const std::size_t begin = count * fold / kFolds, end = count * (fold + 1) / kFolds;
    std::vector<const Image*> learned_from;
    for (std::size_t i = 0; i < count; ++i) {
      if (i < begin || i >= end) learned_from.push_back(&images_[i]);
    }
    const Eigen::VectorXd correction = solve(learned_from);
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
  const Eigen::VectorXd correction = solve(all);
  result.grid.inverse_depth.assign(correction.data(), correction.data() + correction.size());
  return result;
}

}  // namespace dominant_plane_detection
