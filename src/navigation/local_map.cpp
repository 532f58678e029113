#include "navigation/local_map.h"

#include <algorithm>
#include <cmath>

#include "navigation/ground_frame.h"

namespace dominant_plane_detection {
namespace {

// Log-odds, of a probability of 0.7 and of 0.4 (OctoMap), and between which limits they stay.
constexpr float kHit = 0.85F, kMiss = 0.4F;
constexpr float kMost = 3.5F, kLeast = -2.0F;
/// One image is enough to be occupied, and one to be free where nothing else was seen.
constexpr float kOccupiedFrom = 0.5F, kFreeTo = -0.3F, kForgotten = 0.02F;

constexpr int kStep = 2;  // [px] from one pixel that is looked at to the next
/// [m] A thing shows itself by a quarter of a square of this side; of a cell, where that is less.
constexpr float kThing = 0.05F;
constexpr float kShare = 0.25F;
constexpr double kSigmas = 3.0;  // [-]

/// @return whether a point may be in an image, generously: farther out distortion is not meant for
/// it.
bool isAbout(const CameraModel& camera, const Eigen::Vector3f& point) {
  constexpr float kNear = 0.1F;    // [m]
  constexpr double kBeyond = 0.6;  // [-] of the image's size, from its middle
  const float z = point.z();
  const auto inside = [z](float x, double focal, double centre, int size) {
    const double middle = 0.5 * size;
    return std::abs(static_cast<float>(focal) * x + static_cast<float>(centre - middle) * z) <
           static_cast<float>(2.0 * kBeyond * middle) * z;
  };
  return z > kNear && inside(point.x(), camera.fx, camera.cx, camera.width) &&
         inside(point.y(), camera.fy, camera.cy, camera.height);
}

}  // namespace

LocalMap::LocalMap(double resolution, double size, double memory)
    : grid_(resolution, std::max(static_cast<int>(std::lround(size / resolution)), 1)),
      memory_(memory),
      cells_(grid_.size()),
      shown_(grid_.size()) {}

void LocalMap::reset() { std::fill(cells_.begin(), cells_.end(), Cell()); }

void LocalMap::age(double stamp) {
  const double seconds = stamp - stamp_;
  stamp_ = stamp;
  if (seconds < 0.0 || !(memory_ > 0.0)) return reset();
  const auto rest = static_cast<float>(std::exp(-seconds / memory_));
  for (Cell& cell : cells_) {
    cell.surface = std::abs(cell.surface) < kForgotten ? 0.0F : cell.surface * rest;
    if (cell.thing == 0.0F) continue;
    cell.thing *= rest;
    if (cell.thing < kForgotten) cell = Cell();  // it may be there still, and the ground below it
  }
}

void LocalMap::add(double stamp, const DepthView& depth, const RayTable& rays,
                   const Detection& detection, const MapLimits& limits,
                   const Eigen::Isometry2d& T_map_ground) {
  age(stamp);
  grid_.moveTo(T_map_ground.translation(), [&](std::size_t place) { cells_[place] = Cell(); });
  setView(detection, T_map_ground);
  const Image image{depth, rays, detection, limits};
  collectThings(image);
  updateCells(image);
}

void LocalMap::setView(const Detection& detection, const Eigen::Isometry2d& T_map_ground) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = T_map_ground.linear();
  const Eigen::Isometry3d ground = groundFromOptical(detection.normal, detection.distance);
  rotation_ = (turn * ground.linear()).cast<float>();
  foot_ = (T_map_ground.translation() - grid_.origin()).cast<float>();
  height_ = static_cast<float>(detection.distance);
}

/// The area that a reading stands for, seen from the camera, is that of its pixel at its depth.
void LocalMap::collectThings(const Image& image) {
  std::fill(shown_.begin(), shown_.end(), Shown());
  const auto low = static_cast<float>(image.limits.clearance_height);
  const auto high = static_cast<float>(image.limits.max_obstacle_height);
  const CameraModel& camera = image.rays.camera();
  const auto pixel = static_cast<float>(kStep * kStep / (camera.fx * camera.fy));
  const auto per_cell = static_cast<float>(1.0 / grid_.resolution());
  for (int v = 0; v < image.detection.image_height; v += kStep) {
    for (int u = 0; u < image.detection.image_width; u += kStep) {
      if (image.detection.label(u, v) != Label::kObstacle) continue;
      const float z = metresAt(image.depth, u, v);
      const Eigen::Vector3f point = z * (rotation_ * image.rays.ray(u, v));
      const float over = height_ + point.z();
      if (!(over >= low && over <= high)) continue;
      const Eigen::Vector2f place = (foot_ + point.head<2>()) * per_cell;
      const float last = static_cast<float>(grid_.cells());
      if (!(place.minCoeff() >= 0.0F && place.maxCoeff() < last)) continue;
      Shown& shown =
          shown_[grid_.placeOf(static_cast<int>(place.x()), static_cast<int>(place.y()))];
      shown.lowest = shown.area > 0.0F ? std::min(shown.lowest, over) : over;
      shown.highest = std::max(shown.highest, over);
      shown.area += pixel * z * z;
    }
  }
}

void LocalMap::updateCells(const Image& image) {
  const auto side = static_cast<float>(grid_.resolution());
  const CameraModel& camera = image.rays.camera();
  const Eigen::Vector3f step = side * rotation_.row(0).transpose();
  for (int y = 0; y < grid_.cells(); ++y) {
    Eigen::Vector2f place(0.5F * side, side * (static_cast<float>(y) + 0.5F));
    Eigen::Vector3f point = inCamera(place, 0.0F);
    for (int x = 0; x < grid_.cells(); ++x, place.x() += side, point += step) {
      const std::size_t at = grid_.placeOf(x, y);
      const bool in_view = isAbout(camera, point);
      const bool idle = !in_view && shown_[at].area == 0.0F && cells_[at].thing == 0.0F;
      if (idle) continue;
      const GroundSeen seen = in_view ? groundAt(image, point) : GroundSeen();
      update(cells_[at], shown_[at], seen, image, place);
    }
  }
}

/// Where something low is seen below something high, the high one is kept: only who looks through
/// it may take it away.
void LocalMap::extend(Cell& cell, const Shown& shown) const {
  const auto side = static_cast<float>(grid_.resolution());
  const bool known = cell.thing > 0.0F;
  const bool above = shown.lowest > cell.highest + side, below = shown.highest < cell.lowest - side;
  if (known && below) return;
  const bool together = known && !above;
  cell.lowest = together ? std::min(cell.lowest, shown.lowest) : shown.lowest;
  cell.highest = together ? std::max(cell.highest, shown.highest) : shown.highest;
}

void LocalMap::update(Cell& cell, const Shown& shown, const GroundSeen& seen, const Image& image,
                      const Eigen::Vector2f& place) {
  const float side = std::min(static_cast<float>(grid_.resolution()), kThing);
  if (shown.area >= kShare * side * side) {
    extend(cell, shown);
    cell.thing = std::min(cell.thing + kHit, kMost);
    return;
  }
  const bool nothing = shown.area == 0.0F;
  if (nothing && cell.thing > 0.0F) {
    const bool stood = cell.lowest < static_cast<float>(footHeight(image.limits));
    const bool gone = (stood && seen.ground >= 3) || seesThrough(image, cell, place);
    if (gone) cell.thing = std::max(cell.thing - kMiss, 0.0F);
  }
  if (seen.hole >= 2) {
    cell.surface = std::min(cell.surface + kHit, kMost);
  } else if (seen.ground >= 2 && seen.hole == 0 && nothing) {
    cell.surface = std::max(cell.surface - kMiss, kLeast);
  }
}

/// What the image shows where four places of a cell are on the plane.
/// @param middle [m] of the cell, in the camera.
LocalMap::GroundSeen LocalMap::groundAt(const Image& image, const Eigen::Vector3f& middle) const {
  const auto quarter = static_cast<float>(0.25 * grid_.resolution());
  const Eigen::Vector3f x = quarter * rotation_.row(0).transpose();
  const Eigen::Vector3f y = quarter * rotation_.row(1).transpose();
  GroundSeen seen;
  for (const Eigen::Vector3f& point :
       {Eigen::Vector3f(middle - x - y), Eigen::Vector3f(middle + x - y),
        Eigen::Vector3f(middle - x + y), Eigen::Vector3f(middle + x + y)}) {
    int u = 0, v = 0;
    if (!pixelOf(image.rays.camera(), point, u, v)) continue;
    const Label label = image.detection.label(u, v);
    const bool missing = label == Label::kMissingGround && image.limits.missing_ground;
    seen.hole += label == Label::kDropOff || missing;
    const bool near = point.z() <= static_cast<float>(image.limits.free_range);
    // The foot of a thing is called ground as well, and is nearer than the ground behind it.
    seen.ground += label == Label::kGround && near &&
                   metresAt(image.depth, u, v) > point.z() - 0.5F * marginAt(image, point.z());
  }
  return seen;
}

/// @return whether readings are from behind where the thing was, at all of three heights of it that
/// are in the image.
bool LocalMap::seesThrough(const Image& image, const Cell& cell,
                           const Eigen::Vector2f& place) const {
  int seen = 0, through = 0;
  for (const float share : {0.15F, 0.5F, 0.85F}) {
    const float height = cell.lowest + share * (cell.highest - cell.lowest);
    const Eigen::Vector3f point = inCamera(place, height);
    int u = 0, v = 0;
    if (!pixelOf(image.rays.camera(), point, u, v)) continue;
    ++seen;
    const float z = metresAt(image.depth, u, v);
    through += std::isfinite(z) && z > point.z() + marginAt(image, point.z());
  }
  return seen > 0 && through == seen;
}

/// @return [m] by how much a reading may be off that is of a cell.
float LocalMap::marginAt(const Image& image, float z) const {
  const double error = image.limits.noise.sigma(static_cast<double>(z));
  return static_cast<float>(grid_.resolution() + kSigmas * error);
}

/// @param place [m] on the ground. @param height [m] over it.
Eigen::Vector3f LocalMap::inCamera(const Eigen::Vector2f& place, float height) const {
  const Eigen::Vector2f from_foot = place - foot_;
  return rotation_.transpose() * Eigen::Vector3f(from_foot.x(), from_foot.y(), height - height_);
}

/// @return whether the camera has a point in its image, and where.
bool LocalMap::pixelOf(const CameraModel& camera, const Eigen::Vector3f& point, int& u,
                       int& v) const {
  if (!isAbout(camera, point)) return false;
  const float x = point.x() / point.z(), y = point.y() / point.z();
  float column = static_cast<float>(camera.fx) * x + static_cast<float>(camera.cx);
  float row = static_cast<float>(camera.fy) * y + static_cast<float>(camera.cy);
  if (camera.distortion != DistortionModel::kNone) {
    const Eigen::Vector2f pixel =
        camera.project(Eigen::Vector2f(x, y).cast<double>()).cast<float>();
    column = pixel.x();
    row = pixel.y();
  }
  u = static_cast<int>(std::floor(column + 0.5F));
  v = static_cast<int>(std::floor(row + 0.5F));
  return u >= 0 && v >= 0 && u < camera.width && v < camera.height;
}

LocalMap::State LocalMap::state(int x, int y) const {
  const Cell& cell = cells_[grid_.placeOf(x, y)];
  if (std::max(cell.thing, cell.surface) >= kOccupiedFrom) return kOccupied;
  return cell.surface <= kFreeTo && cell.thing == 0.0F ? kFree : kUnknown;
}

}  // namespace dominant_plane_detection
