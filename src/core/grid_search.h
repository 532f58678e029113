#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/ground_tiles.h"
#include "core/plane_refinement.h"
#include "core/plane_selection.h"
#include "core/seed_search.h"
#include "core/surface_check.h"
#include "core/surface_split.h"
#include "core/tile_growth.h"
#include "core/tile_judge.h"
#include "core/tile_limits.h"
#include "dominant_plane_detection/detection.h"
#include "dominant_plane_detection/parameters.h"

namespace dominant_plane_detection {

/// Grows regions of tiles, and keeps that of the selected plane.
class GridSearch : private RegionSource {
 public:
  /// What the search looks at.
  struct Image {
    const TileMoments& tiles;
    const CameraModel& camera;
    std::size_t min_piece;  ///< [px] smallest piece that joins a region beyond a gap
  };

  /// @param predicted where the plane should be, if that is known; looked at before any seed.
  /// @param effort is added to.
  void run(const Image& image, const Parameters& parameters,
           const std::optional<HessePlane>& predicted, PlaneSelection& selection, Effort& effort);

  /// Collects the ground of a region that was found otherwise.
  /// @param region tiles with points of it, each once.
  void collectGround(const Image& image, const Parameters& parameters, const HessePlane& plane,
                     const std::vector<std::size_t>& region);

  /// @return 1 for the tiles of the selected plane's region, padded like the moments.
  /// @pre the last `run` found a plane, or `collectGround` was called.
  const std::vector<std::uint8_t>& ground() const { return ground_; }
  /// @return whether the selected plane is the predicted one.
  bool tracked() const { return tracked_; }
  /// @return kAbove or kBelow for the tiles of the surfaces that it was told from, else 0; padded
  /// like the moments.
  const std::vector<std::uint8_t>& otherSurfaces() const { return other_surfaces_; }

 private:
  /// Which seeds regions are grown from.
  enum class Seeds {
    kPromising,  ///< those whose tiles are not clearly too tilted to be ground
    kAll,
  };
  /// How often what was grown as one may be told into two surfaces: it may show three of them, or
  /// the second look tells better than the first.
  static constexpr int kMaxSplits = 2;
  /// The two surfaces of a split, and the tiles that belong to neither.
  struct Parts {
    std::array<TileRegion, 2> sides;
    std::vector<std::uint8_t> other;
  };

  void start(const Image& image, const Parameters& parameters);
  void begin(Seeds seeds);
  void search(const Parameters& parameters);
  void tryPrediction(const HessePlane& plane);
  bool available(std::size_t tile) const override {
    return tiles_->count[tile] >= kMinReadings && !taken_[tile] && !seeded_[tile];
  }
  std::size_t availablePoints() const override { return available_points_; }
  bool tryRegion(std::size_t tile) override;
  void finishRegion(const TileRegion& grown);
  void finishPart(const TileRegion& part, int splits);
  void finishSides(int splits);
  void finishSurface(const SurfacePlane& surface, bool is_level);
  std::optional<SurfacePlane> decideAgain(const TileRegion& grown);
  bool collectSurface(const SurfacePlane& surface, const std::vector<std::size_t>& grown);
  void joinPieces(float level);
  Eigen::Vector3d centre() const;
  double nearestPoint() const;
  void placeOtherSurfaces();
  void take(std::size_t tile);

  const TileMoments* tiles_ = nullptr;
  TileLimits limits_;
  TileJudge judge_;
  TileGrowth growth_;
  TileRegion region_;                      ///< what was grown, decided again
  std::vector<std::size_t> tiles_so_far_;  ///< of the region, while it is decided again
  TileRegion predicted_region_;            ///< what is on the predicted plane
  std::vector<std::size_t> predicted_tiles_;
  TileRegion around_;  ///< the region and its rim
  SurfaceSplit split_;
  std::array<Parts, kMaxSplits> parts_;
  /// The split that a tile went to another surface by, counted from the last one to the first, or
  /// 0: other surfaces' tiles do not join.
  std::vector<std::uint8_t> other_;
  SurfaceCheck check_;
  GroundTiles ground_tiles_;
  SeedOrder order_;
  RandomDraw draw_;
  GroundTiles::Limits piece_limits_{};
  NoiseModel smooth_error_;
  std::vector<std::uint8_t> taken_;   ///< 1 for tiles of regions: they neither seed nor join
  std::vector<std::uint8_t> seeded_;  ///< 1 for tiles that were seeds
  std::size_t available_points_ = 0;  ///< [px] in tiles that are not taken
  std::vector<std::uint8_t> ground_;
  std::vector<std::uint8_t> other_surfaces_;
  Seeds seeds_ = Seeds::kPromising;
  bool predicted_ = false;  ///< what is looked at is the prediction
  bool tracked_ = false;
  PlaneSelection* selection_ = nullptr;
  Effort* effort_ = nullptr;
};

}  // namespace dominant_plane_detection
