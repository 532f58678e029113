#include "core/plane_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "support/detector_fixture.h"
#include "support/mahalanobis.h"
#include "support/tile_scene.h"

namespace dominant_plane_detection {
namespace {

const HessePlane kFloor{-kUp, kHeight};
const ErrorSizes kKinect{NoiseModel(), {0.0013, 0.001}, WideErrorModel()};

using Field = Eigen::MatrixXd;

/// @return numbers of variance 1 whose correlation falls like exp(-d / length) along either axis:
/// an autoregressive process along the rows, of such along the columns.
Field shortWaves(int columns, int rows, double length, std::mt19937& generator) {
  std::normal_distribution<double> gauss;
  const double kept = std::exp(-1.0 / length), added = std::sqrt(1.0 - kept * kept);
  Field field = Field::NullaryExpr(rows, columns, [&] { return gauss(generator); });
  for (int i = 1; i < columns; ++i) field.col(i) = kept * field.col(i - 1) + added * field.col(i);
  for (int i = 1; i < rows; ++i) field.row(i) = kept * field.row(i - 1) + added * field.row(i);
  return field;
}

/// @return numbers of variance 1 with the correlation exp(-d^2 / 2 length^2): many plane waves of
/// normally distributed frequency.
Field wideWaves(int columns, int rows, double length, std::mt19937& generator) {
  constexpr int kWaves = 60;
  std::normal_distribution<double> gauss(0.0, 1.0 / length);
  std::uniform_real_distribution<double> phase(0.0, 2.0 * M_PI);
  Field field = Field::Zero(rows, columns);
  for (int i = 0; i < kWaves; ++i) {
    const double x = gauss(generator), y = gauss(generator), begin = phase(generator);
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        field(row, column) += std::sqrt(2.0 / kWaves) * std::cos(x * column + y * row + begin);
      }
    }
  }
  return field;
}

/// The tiles of a floor, and of what a sensor makes of it.
class SensedFloor {
 public:
  explicit SensedFloor(const CameraModel& camera)
      : camera_(camera), scene_(planeDepth(camera, kUp, kHeight), camera) {
    ground_.assign(scene_.tiles.count.size(), 0);
    for (std::size_t i = 0; i < scene_.tiles.size(); ++i) {
      ground_[i] = scene_.tiles.count[i] > 0.0F && scene_.tiles.z[i] < 4.0F;
    }
  }

  const std::vector<std::uint8_t>& ground() const { return ground_; }
  std::vector<std::uint8_t>& ground() { return ground_; }
  const TileMoments& tiles() const { return scene_.tiles; }

  /// @return the tiles with errors along the normal of so many times the sizes.
  TileMoments sense(const ErrorSizes& sizes, double short_times, double wide_times,
                    unsigned seed) const {
    std::mt19937 generator(seed);
    TileMoments tiles = scene_.tiles;
    const double scale = camera_.width / 640.0 / kTileSize;  // [#] tiles a pixel of 640
    const Field short_waves = shortWaves(tiles.columns, tiles.rows, 36.0 * scale, generator);
    const Field wide_waves = wideWaves(tiles.columns, tiles.rows, 150.0 * scale, generator);
    for (int row = 0; row < tiles.rows; ++row) {
      for (int column = 0; column < tiles.columns; ++column) {
        const std::size_t tile = scene_.at(column, row);
        const Eigen::Vector3d centre = tiles.centre(tile);
        const double z = centre.z();
        const double cosine = -kUp.dot(centre) / centre.norm();
        const double wide = sizes.wide.constant + sizes.wide.quadratic * z * z / cosine;
        const double smooth = sizes.smooth.constant + sizes.smooth.quadratic * z * z;
        const Eigen::Vector3d sensed =
            centre + kUp * (short_times * smooth * short_waves(row, column) +
                            wide_times * wide * wide_waves(row, column));
        tiles.x[tile] = static_cast<float>(sensed.x());
        tiles.y[tile] = static_cast<float>(sensed.y());
        tiles.z[tile] = static_cast<float>(sensed.z());
      }
    }
    return tiles;
  }

  /// @return the plane of the ground's tiles by least squares with weights 1 / sigma(z)^2.
  HessePlane fit(const TileMoments& tiles) const {
    HessePlane plane = kFloor;
    for (int step = 0; step < 3; ++step) {
      const Eigen::Vector3d a = plane.normal.unitOrthogonal(), b = plane.normal.cross(a);
      Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
      Eigen::Vector3d right = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < tiles.size(); ++i) {
        if (!ground_[i]) continue;
        const Eigen::Vector3d centre = tiles.centre(i);
        const Eigen::Vector3d row(a.dot(centre), b.dot(centre), 1.0);
        const double weight =
            static_cast<double>(tiles.count[i]) / std::pow(NoiseModel().sigma(centre.z()), 2);
        matrix += weight * row * row.transpose();
        right += weight * plane.signedDistance(centre) * row;
      }
      const Eigen::Vector3d change = matrix.ldlt().solve(right);
      const Eigen::Vector3d normal = (plane.normal - change[0] * a - change[1] * b).normalized();
      plane = HessePlane::through((plane.distance + change[2]) * plane.normal, normal);
    }
    return plane;
  }

 private:
  CameraModel camera_;
  TileScene scene_;
  std::vector<std::uint8_t> ground_;
};

/// Errors drawn as the estimate assumes, with short waves of another size than the profile says.
class DrawnErrors : public testing::TestWithParam<std::pair<double, double>> {};
INSTANTIATE_TEST_SUITE_P(Times, DrawnErrors,
                         testing::Values(std::make_pair(2.0, 0.0), std::make_pair(0.5, 0.0),
                                         std::make_pair(1.0, 1.0), std::make_pair(0.3, 1.0)));

TEST_P(DrawnErrors, AreAsLargeAsTheCovarianceSays) {
  const auto& [short_times, wide_times] = GetParam();
  const SensedFloor floor(testCamera());
  ErrorSizes sizes = kKinect;
  if (wide_times == 0.0) sizes.wide = {0.0, 0.0};
  PlaneCovariance covariance;
  constexpr int kDraws = 300;
  int inside = 0;
  double sum = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const TileMoments tiles =
        floor.sense(sizes, short_times, wide_times, static_cast<unsigned>(draw));
    const HessePlane plane = floor.fit(tiles);
    const double square =
        squaredMahalanobis(covariance.estimate(tiles, floor.ground(), plane, sizes, 640),
                           planeDifference(-plane.normal, plane.distance, kUp, kHeight));
    sum += square;
    inside += square < kChiSquare95 ? 1 : 0;
  }
  // Of 300 draws the mean of 3 has a standard deviation of 0.14; the size of the short waves is
  // itself estimated.
  EXPECT_NEAR(sum / kDraws, 3.0, 0.8);
  EXPECT_GE(inside, 0.87 * kDraws);
  EXPECT_LE(inside, 0.99 * kDraws);
}

TEST(PlaneCovariance, HasRankThreeAndLeavesOutTheNormalsLength) {
  const SensedFloor floor(testCamera());
  PlaneCovariance covariance;
  const Eigen::Matrix4d c =
      covariance.estimate(floor.tiles(), floor.ground(), kFloor, kKinect, 640);
  EXPECT_LT((c - c.transpose()).cwiseAbs().maxCoeff(), 1e-15);
  Eigen::Vector4d along_normal = Eigen::Vector4d::Zero();
  along_normal.head<3>() = kUp;
  EXPECT_LT((c * along_normal).norm(), 1e-12);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(c);
  EXPECT_NEAR(solver.eigenvalues()[0], 0.0, 1e-12);
  // Tilts of a tenth to two degrees and a height of some millimetres.
  EXPECT_GT(solver.eigenvalues()[1], 1e-7);
  EXPECT_LT(solver.eigenvalues()[3], 2e-3);
}

TEST(PlaneCovariance, IsThatOfTheSameViewAtAnyResolution) {
  PlaneCovariance covariance;
  const SensedFloor whole(testCamera());
  const Eigen::Matrix4d expected =
      covariance.estimate(whole.tiles(), whole.ground(), kFloor, kKinect, 640);
  // Of widths that cells of whole tiles do not divide as well.
  for (const int width : {160, 240, 320, 424, 848, 1280}) {
    const SensedFloor floor(testCamera(width, 3 * width / 4));
    const Eigen::Matrix4d found =
        covariance.estimate(floor.tiles(), floor.ground(), kFloor, kKinect, width);
    EXPECT_LT((found - expected).norm(), 0.15 * expected.norm()) << width;
  }
}

TEST(PlaneCovariance, IsUnknownOfAPlaneThroughTheCamera) {
  const SensedFloor floor(testCamera());
  HessePlane through = kFloor;
  through.distance = 0.0;
  TileMoments tiles = floor.tiles();
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const Eigen::Vector3d on_plane =
        tiles.centre(i) - through.signedDistance(tiles.centre(i)) * through.normal;
    tiles.x[i] = static_cast<float>(on_plane.x());
    tiles.y[i] = static_cast<float>(on_plane.y());
    tiles.z[i] = static_cast<float>(on_plane.z());
  }
  PlaneCovariance covariance;
  const Eigen::Matrix4d found = covariance.estimate(tiles, floor.ground(), through, kKinect, 640);
  EXPECT_TRUE(found.allFinite());
}

TEST(PlaneCovariance, IsLargerForAPartOfTheFloor) {
  SensedFloor floor(testCamera());
  PlaneCovariance covariance;
  const Eigen::Matrix4d all =
      covariance.estimate(floor.tiles(), floor.ground(), kFloor, kKinect, 640);
  for (std::size_t i = 0; i < floor.tiles().size(); ++i) {
    if (floor.tiles().x[i] > 0.0F) floor.ground()[i] = 0;
  }
  const Eigen::Matrix4d half =
      covariance.estimate(floor.tiles(), floor.ground(), kFloor, kKinect, 640);
  for (int i = 0; i < 4; ++i) EXPECT_GT(half(i, i), 1.2 * all(i, i)) << i;
}

TEST(PlaneCovariance, KnowsAPlaneWithinOneCellByTheProfile) {
  const SensedFloor floor(testCamera());
  std::vector<std::uint8_t> patch(floor.tiles().count.size(), 0);
  for (int row = 52; row < 56; ++row) {
    for (int column = 40; column < 44; ++column) {
      patch[static_cast<std::size_t>(row * floor.tiles().columns + column)] = 1;
    }
  }
  PlaneCovariance covariance;
  const Eigen::Matrix4d small = covariance.estimate(floor.tiles(), patch, kFloor, kKinect, 640);
  ErrorSizes twice = kKinect;
  twice.smooth = {0.0026, 0.002};
  twice.wide = {0.020, 0.0016};
  const Eigen::Matrix4d large = covariance.estimate(floor.tiles(), patch, kFloor, twice, 640);
  EXPECT_GT(small(3, 3), 0.0);
  EXPECT_NEAR(large(3, 3) / small(3, 3), 4.0, 1e-6);
}

TEST(PlaneCovariance, IsUnknownWhereTilesDoNotDetermineAPlane) {
  const SensedFloor floor(testCamera());
  PlaneCovariance covariance;
  std::vector<std::uint8_t> none(floor.tiles().count.size(), 0);
  EXPECT_EQ(covariance.estimate(floor.tiles(), none, kFloor, kKinect, 640), unknownCovariance());
  none[static_cast<std::size_t>(50 * floor.tiles().columns + 40)] = 1;
  EXPECT_EQ(covariance.estimate(floor.tiles(), none, kFloor, kKinect, 640), unknownCovariance());
}

/// What is off the plane, such as the foot of a box in a tile at the ground's rim, does not say how
/// the floor errs.
TEST(PlaneCovariance, LeavesOutWhatIsOffThePlane) {
  const SensedFloor floor(testCamera());
  PlaneCovariance covariance;
  TileMoments tiles = floor.tiles();
  const Eigen::Matrix4d clean = covariance.estimate(tiles, floor.ground(), kFloor, kKinect, 640);
  for (int column = 20; column < 60; column += 4) {
    const auto tile = static_cast<std::size_t>(50 * tiles.columns + column);
    const Eigen::Vector3d raised = tiles.centre(tile) + 0.2 * kUp;
    tiles.x[tile] = static_cast<float>(raised.x());
    tiles.y[tile] = static_cast<float>(raised.y());
    tiles.z[tile] = static_cast<float>(raised.z());
  }
  const Eigen::Matrix4d rim = covariance.estimate(tiles, floor.ground(), kFloor, kKinect, 640);
  EXPECT_LT((rim - clean).norm(), 0.02 * clean.norm());
}

TEST_P(DetectorAlgorithm, TellsHowSureThePlaneIs) {
  const CameraModel camera = testCamera();
  const auto depth = inMillimetres(planeDepth(camera, kUp, kHeight), 1.425e-3);
  DominantPlaneDetector detector(parameters_);
  const Detection& detection = detector.detect(depth.view(), camera);
  ASSERT_TRUE(detection.found());
  EXPECT_GT(detection.covariance(3, 3), 0.0);
  // The profile's wide error is 11 mm at 1 m.
  EXPECT_LT(std::sqrt(detection.covariance(3, 3)), 0.05);
  const OwnedDepth<std::uint16_t> empty(640, 480);
  EXPECT_EQ(detector.detect(empty.view(), camera).covariance, unknownCovariance());

  parameters_.covariance = false;
  DominantPlaneDetector unasked(parameters_);
  EXPECT_EQ(unasked.detect(depth.view(), camera).covariance, unknownCovariance());
}
INSTANTIATE_TEST_SUITE_P(Both, DetectorAlgorithm,
                         testing::Values(Algorithm::kGrid, Algorithm::kKdtree));

}  // namespace
}  // namespace dominant_plane_detection
