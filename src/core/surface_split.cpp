#include "core/surface_split.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/image_kernel.h"
#include "core/window_sums.h"

namespace dominant_plane_detection {
namespace {

constexpr int kSquare = 2;  // [tiles]
/// [squares] that have a say to either side; with all of them 112 pixels, more than twice the
/// bumps of depth cameras' errors.
constexpr int kReach = 3;
/// [-] in sigma(z): heights that are so far from a plane support it half as much.
constexpr float kWidth = 0.3F;
/// Turns of dividing and fitting.
constexpr int kTurns = 4;
/// Two surfaces are told where one plane is bent by so many smooth errors, and by so many times
/// what two are [-]. A smooth error over a whole image is more or less than its rms; on floors of
/// recordings two planes gain up to 3.6, on rendered ones 4.1. With a gain beyond that smaller
/// bends are told, too.
struct Evidence {
  float bend, gain;
};
constexpr Evidence kBent{1.7F, 2.5F}, kStraight{0.6F, 3.7F};
constexpr float kMinShare = 0.05F;  // [-] of the points
/// Smallest reciprocal condition of normal equations that tell a plane.
constexpr float kMinCondition = 1e-6F;
/// [1/m] A millionth of a millimetre is a vote.
constexpr float kLarge = 1e9F;

/// Parts of a region along rows or columns, as shares of its points.
struct Band {
  float begin, end;
};
constexpr std::array<Band, 5> kBands{
    {{0.0F, 0.25F}, {0.75F, 1.0F}, {0.0F, 0.5F}, {0.5F, 1.0F}, {0.25F, 0.75F}}};

}  // namespace

void SurfaceSplit::collect(const TileJudge& judge, const TileRegion& region,
                           const NoiseModel& smooth_error) {
  const TileMoments& tiles = judge.tiles();
  columns_ = covering(tiles.columns, kSquare);
  rows_ = covering(tiles.rows, kSquare);
  frame_ = PlaneFrame::of(region.plane, tiles.centre(region.tiles.front()));
  for (Numbers* numbers : {&points_, &a_, &b_, &h_, &inverse_sigma_, &depth_}) {
    numbers->setZero(columns_ * rows_);
  }
  tile_columns_ = static_cast<std::size_t>(tiles.columns);
  for (const std::size_t tile : region.tiles) {
    const Eigen::Index square = squareOf(tile);
    const Eigen::Vector3f place =
        frame_.axes.transpose() *
        (Eigen::Vector3f(tiles.x[tile], tiles.y[tile], tiles.z[tile]) - frame_.origin);
    const float points = tiles.count[tile];
    points_[square] += points;
    a_[square] += points * place.x();
    b_[square] += points * place.y();
    h_[square] += points * place.z();
    inverse_sigma_[square] += points * judge.limits().inverse_sigma[tile];
    depth_[square] += points * tiles.z[tile];
  }
  for (Numbers* numbers : {&a_, &b_, &h_, &inverse_sigma_, &depth_}) {
    *numbers /= points_.max(1.0F);
  }
  products_.resize(points_.size(), kProducts);
  const auto product = [&](int which) { return products_.col(which).array(); };
  product(kOne) = points_ * inverse_sigma_.square();
  product(kA) = product(kOne) * a_;
  product(kB) = product(kOne) * b_;
  product(kH) = product(kOne) * h_;
  product(kAA) = product(kA) * a_;
  product(kAB) = product(kA) * b_;
  product(kBB) = product(kB) * b_;
  product(kAH) = product(kA) * h_;
  product(kBH) = product(kB) * h_;
  inverse_smooth_ = 1.0F / (static_cast<float>(smooth_error.constant) +
                            static_cast<float>(smooth_error.quadratic) * depth_.square());
  column_.resize(points_.size());
  row_.resize(points_.size());
  for (int y = 0; y < rows_; ++y) {
    column_.segment(y * columns_, columns_).setLinSpaced(0.0F, static_cast<float>(columns_ - 1));
    row_.segment(y * columns_, columns_).setConstant(static_cast<float>(y));
  }
}

/// @param chosen 1 for the squares that count, else 0.
/// @return the plane of least squared heights; nothing where too few squares determine one.
std::optional<SurfaceSplit::Sheet> SurfaceSplit::fit(const Numbers& chosen) const {
  const Eigen::Matrix<float, kProducts, 1> sums = products_.transpose() * chosen.matrix();
  Eigen::Matrix3f normal_matrix;
  normal_matrix << sums[kAA], sums[kAB], sums[kA],  //
      sums[kAB], sums[kBB], sums[kB],               //
      sums[kA], sums[kB], sums[kOne];
  const Eigen::LDLT<Eigen::Matrix3f> solver(normal_matrix);
  if (!(sums[kOne] > 0.0F) || !(solver.rcond() > kMinCondition)) return std::nullopt;
  const Eigen::Vector3f sheet = solver.solve(Eigen::Vector3f(sums[kAH], sums[kBH], sums[kH]));
  return Sheet{sheet[0], sheet[1], sheet[2]};
}

/// Planes of the parts along one direction of the image.
/// @param places of each square, 0 to count - 1.
void SurfaceSplit::addBands(const Numbers& places, int count) {
  std::vector<float>& points = place_points_;
  points.assign(static_cast<std::size_t>(count), 0.0F);
  for (Eigen::Index i = 0; i < places.size(); ++i) {
    points[static_cast<std::size_t>(places[i])] += points_[i];
  }
  const float all = points_.sum();
  const auto placeAt = [&](float share) {
    float sum = 0.0F;
    std::size_t place = 0;
    while (place + 1 < points.size() && (sum += points[place]) <= share * all) ++place;
    return static_cast<float>(place);
  };
  for (const Band& band : kBands) {
    const float first = placeAt(band.begin), last = placeAt(band.end);
    chosen_ = (places >= first && places <= last).cast<float>();
    if (const auto sheet = fit(chosen_)) bands_.push_back(*sheet);
  }
}

/// @return the two planes with most support, each square supporting the one that it is nearer to.
std::optional<SurfaceSplit::Pair> SurfaceSplit::bestPair() {
  bands_.clear();
  addBands(row_, rows_);
  addBands(column_, columns_);
  supports_.resize(2 * kBands.size());
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    supports_[i] = points_ / (1.0F + (heightsOver(bands_[i]) * inverse_sigma_ / kWidth).square());
  }
  float most = 0.0F;
  std::optional<Pair> best;
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    for (std::size_t j = i + 1; j < bands_.size(); ++j) {
      const float support = supports_[i].max(supports_[j]).sum();
      if (support <= most) continue;
      most = support;
      best = {bands_[i], bands_[j]};
    }
  }
  return best;
}

/// Each square goes to the plane that most of those about it are nearer to.
void SurfaceSplit::divide(const Pair& pair) {
  const auto nearer_to_first = heightsOver(pair[1]).abs() - heightsOver(pair[0]).abs();
  // The sign of each that has points.
  values_ = points_.min(1.0F) * (kLarge * nearer_to_first).max(-1.0F).min(1.0F);
  second_.resize(points_.size());
  sumWindows<kReach>(values_.data(), columns_, rows_, {0, rows_}, column_sum_, second_.data());
  first_ = (second_ >= 0.0F).cast<float>();
  second_ = 1.0F - first_;
}

/// @return whether both have enough squares.
bool SurfaceSplit::refit(Pair& pair) const {
  const std::optional<Sheet> first = fit(first_), second = fit(second_);
  if (!first || !second) return false;
  pair = {*first, *second};
  return true;
}

/// @return [px] for both planes, squared means of the heights about each square of a side, of its
/// side alone, in smooth errors; summed over the side's points.
std::array<float, 2> SurfaceSplit::bendSums(const Pair& sheets, const Numbers& side) {
  const auto sum = [&](Numbers& sums) {
    sums.resize(points_.size());
    sumWindows<kReach>(values_.data(), columns_, rows_, {0, rows_}, column_sum_, sums.data());
  };
  values_ = points_ * side;
  sum(window_points_);
  std::array<float, 2> bends{};
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    values_ = points_ * side * heightsOver(sheets[i]) * inverse_smooth_;
    sum(window_heights_);
    bends[i] = (points_ * side * (window_heights_ / window_points_.max(1.0F)).square()).sum();
  }
  return bends;
}

Eigen::Index SurfaceSplit::squareOf(std::size_t tile) const {
  return static_cast<Eigen::Index>(tile / tile_columns_ / kSquare) * columns_ +
         static_cast<Eigen::Index>(tile % tile_columns_ / kSquare);
}

void SurfaceSplit::takeSides(const TileJudge& judge, const TileRegion& region, const Pair& pair) {
  for (std::size_t side = 0; side < sides_.size(); ++side) {
    sides_[side].clear();
    sides_[side].member.resize(judge.tiles().count.size());
    const Sheet& sheet = pair[side];
    const Eigen::Vector3f normal = frame_.axes * Eigen::Vector3f(-sheet.p, -sheet.q, 1.0F);
    const Eigen::Vector3f origin = frame_.origin + sheet.c * frame_.axes.col(2);
    sides_[side].plane =
        HessePlane::through(origin.cast<double>(), normal.cast<double>().normalized());
  }
  for (const std::size_t tile : region.tiles) {
    sides_[first_[squareOf(tile)] > 0.0F ? 0 : 1].add(tile, judge.tiles());
  }
}

bool SurfaceSplit::find(const TileJudge& judge, const TileRegion& region,
                        const NoiseModel& smooth_error) {
  collect(judge, region, smooth_error);
  chosen_.setOnes(points_.size());
  const std::optional<Sheet> one = fit(chosen_);
  std::optional<Pair> pair = bestPair();
  if (!one || !pair) return false;
  for (int turn = 0; turn < kTurns; ++turn) {
    divide(*pair);
    if (!refit(*pair)) return false;
  }
  const float share = (points_ * first_).sum() / points_.sum();
  if (std::min(share, 1.0F - share) < kMinShare) return false;
  const auto first = bendSums({*one, (*pair)[0]}, first_);
  const auto second = bendSums({*one, (*pair)[1]}, second_);
  const float bend = first[0] + second[0], rest = first[1] + second[1];
  const auto exceeds = [&](const Evidence& least) {
    return bend > least.bend * least.bend * points_.sum() && bend > least.gain * least.gain * rest;
  };
  if (!exceeds(kBent) && !exceeds(kStraight)) return false;
  takeSides(judge, region, *pair);
  return true;
}

}  // namespace dominant_plane_detection
