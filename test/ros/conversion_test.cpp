#include <gtest/gtest.h>
#include <pcl_conversions/pcl_conversions.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "core/ray_table.h"
#include "dominant_plane_detection/dominant_plane_detector.h"
#include "ros/camera_conversion.h"
#include "ros/cloud_conversion.h"
#include "ros/depth_conversion.h"
#include "ros/detection_messages.h"
#include "ros/ground_outline.h"
#include "ros/overlay.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

sensor_msgs::Image depthMessage() {
  sensor_msgs::Image image;
  image.encoding = "16UC1";
  image.width = 4;
  image.height = 3;
  image.step = 8;
  image.data.resize(24);
  for (std::uint8_t i = 0; i < 12; ++i) image.data[2 * i] = i;  // little-endian 0 to 11
  return image;
}

TEST(DepthReader, SeesTheMessageItself) {
  const sensor_msgs::Image image = depthMessage();
  DepthReader reader;
  std::string error;
  const auto view = reader.read(image, error);
  ASSERT_TRUE(view) << error;
  EXPECT_EQ(view->data, image.data.data());
  EXPECT_NEAR(static_cast<double>(metresAt(*view, 3, 2)), 0.011, 1e-9);
}

TEST(DepthReader, HonoursStepByteOrderAndEncoding) {
  DepthReader reader;
  std::string error;
  sensor_msgs::Image padded = depthMessage();
  padded.step = 10;
  padded.data.assign(28, 0);  // the last row is not padded
  padded.data[2 * 10 + 6] = 200;
  EXPECT_NEAR(static_cast<double>(metresAt(*reader.read(padded, error), 3, 2)), 0.2, 1e-7);

  sensor_msgs::Image big = depthMessage();
  big.is_bigendian = 1;
  for (std::size_t i = 0; i < big.data.size(); i += 2) std::swap(big.data[i], big.data[i + 1]);
  EXPECT_NEAR(static_cast<double>(metresAt(*reader.read(big, error), 3, 2)), 0.011, 1e-9);

  sensor_msgs::Image mono = depthMessage();
  mono.encoding = "mono16";
  EXPECT_TRUE(reader.read(mono, error));

  sensor_msgs::Image metres = depthMessage();
  metres.encoding = "32FC1";
  metres.step = 16;
  const std::vector<float> values(12, 1.25F);
  metres.data.resize(48);
  std::copy_n(reinterpret_cast<const std::uint8_t*>(values.data()), 48, metres.data.begin());
  EXPECT_EQ(metresAt(*reader.read(metres, error), 2, 1), 1.25F);
}

TEST(DepthReader, SaysWhatIsWrongWithAnImage) {
  const auto errorOf = [](auto change) {
    sensor_msgs::Image image = depthMessage();
    change(image);
    DepthReader reader;
    std::string error;
    EXPECT_FALSE(reader.read(image, error));
    return error;
  };
  using Image = sensor_msgs::Image;
  EXPECT_NE(errorOf([](Image& i) { i.encoding = "rgb8"; }).find("'rgb8'"), std::string::npos);
  EXPECT_NE(errorOf([](Image& i) { i.width = 0; }).find("0 x 3"), std::string::npos);
  EXPECT_NE(errorOf([](Image& i) { i.width = 1U << 31U; }).find("32768"), std::string::npos);
  EXPECT_NE(errorOf([](Image& i) { i.step = 7; }).find("step"), std::string::npos);
  EXPECT_NE(errorOf([](Image& i) { i.step = 9; }).find("multiple of 2"), std::string::npos);
  EXPECT_NE(errorOf([](Image& i) { i.data.resize(23); }).find("24 bytes"), std::string::npos);
}

sensor_msgs::CameraInfo cameraInfo() {
  sensor_msgs::CameraInfo info;
  info.width = 640;
  info.height = 480;
  info.K = {500, 0, 320, 0, 510, 240, 0, 0, 1};
  info.P = {400, 0, 310, 0, 0, 410, 230, 0, 0, 0, 1, 0};
  info.distortion_model = "plumb_bob";
  info.D = {0.1, -0.2, 0.003, -0.004, 0.05};
  return info;
}

TEST(CameraConversion, RawImagesHaveKAndDRectifiedOnesP) {
  std::string error;
  const auto raw = cameraModel(cameraInfo(), false, error);
  ASSERT_TRUE(raw) << error;
  EXPECT_EQ(raw->fx, 500.0);
  EXPECT_EQ(raw->cy, 240.0);
  EXPECT_EQ(raw->distortion, DistortionModel::kPlumbBob);
  EXPECT_EQ(raw->coefficients[4], 0.05);
  const auto rectified = cameraModel(cameraInfo(), true, error);
  ASSERT_TRUE(rectified) << error;
  EXPECT_EQ(rectified->fx, 400.0);
  EXPECT_EQ(rectified->cy, 230.0);
  EXPECT_EQ(rectified->distortion, DistortionModel::kNone);
  sensor_msgs::CameraInfo plain = cameraInfo();
  plain.D.clear();
  plain.distortion_model.clear();
  EXPECT_EQ(cameraModel(plain, false, error)->distortion, DistortionModel::kNone);
  sensor_msgs::CameraInfo rational = cameraInfo();
  rational.distortion_model = "rational_polynomial";
  rational.D.assign(8, 0.01);
  EXPECT_EQ(cameraModel(rational, false, error)->distortion, DistortionModel::kRationalPolynomial);
}

TEST(CameraConversion, RegionOfInterestAndBinning) {
  sensor_msgs::CameraInfo info = cameraInfo();
  info.roi.x_offset = 100;
  info.roi.y_offset = 60;
  info.roi.width = 400;
  info.roi.height = 300;
  info.binning_x = info.binning_y = 2;
  std::string error;
  const auto camera = cameraModel(info, false, error);
  ASSERT_TRUE(camera) << error;
  EXPECT_EQ(camera->width, 200);
  EXPECT_EQ(camera->height, 150);
  EXPECT_EQ(camera->fx, 250.0);
  EXPECT_EQ(camera->cx, 110.0);
  EXPECT_EQ(camera->cy, 90.0);
}

TEST(CameraConversion, SaysWhatIsWrongWithACameraInfo) {
  std::string error;
  EXPECT_FALSE(cameraModel(sensor_msgs::CameraInfo(), false, error));
  EXPECT_NE(error.find("calibrated"), std::string::npos) << error;
  sensor_msgs::CameraInfo info = cameraInfo();
  info.distortion_model = "fisheye";
  EXPECT_FALSE(cameraModel(info, false, error));
  EXPECT_NE(error.find("'fisheye'"), std::string::npos) << error;
  info = cameraInfo();
  info.D.resize(3);
  EXPECT_FALSE(cameraModel(info, false, error));
  EXPECT_NE(error.find("got 3"), std::string::npos) << error;
  info = cameraInfo();
  info.K[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(cameraModel(info, false, error));
  info = cameraInfo();
  info.roi.x_offset = 5000;  // beyond the image
  EXPECT_FALSE(cameraModel(info, false, error));
}

TEST(CameraModelOfInfo, DistortionsOfEveryLength) {
  std::string error;
  sensor_msgs::CameraInfo info = cameraInfo();
  info.distortion_model = "plumb_bob";
  info.D = {0.1, -0.2, 0.001, 0.002};
  const auto four = cameraModel(info, false, error);
  ASSERT_TRUE(four) << error;
  info.D.push_back(0.0);
  EXPECT_EQ(*four, *cameraModel(info, false, error));
  info.D.push_back(0.0);
  EXPECT_FALSE(cameraModel(info, false, error));
  EXPECT_NE(error.find("expected 4 or 5 coefficients of plumb_bob, got 6"), std::string::npos)
      << error;

  info.distortion_model = "rational_polynomial";
  info.D = {0.1, -0.2, 0.001, 0.002, 0.03, 0.2, -0.1, 0.05};
  const auto eight = cameraModel(info, false, error);
  ASSERT_TRUE(eight) << error;
  EXPECT_EQ(eight->coefficients[7], 0.05);
  for (const std::size_t size : {12U, 14U}) {
    info.D.resize(size);
    EXPECT_EQ(*eight, *cameraModel(info, false, error)) << size;
    info.D.back() = 1e-3;
    EXPECT_FALSE(cameraModel(info, false, error));
    EXPECT_NE(error.find("after the first 8"), std::string::npos) << error;
    info.D.back() = 0.0;
  }
}

sensor_msgs::PointCloud2 organisedCloud(const CameraModel& camera, const OwnedDepth<float>& depth) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  pcl::PointCloud<pcl::PointXYZ> cloud(static_cast<std::uint32_t>(camera.width),
                                       static_cast<std::uint32_t>(camera.height));
  RayTable rays;
  rays.build(camera);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const float z = metresAt(depth.view(), u, v);
      const Eigen::Vector3f point = (z > 0.0F ? z : kNaN) * rays.ray(u, v);
      cloud.at(u, v) = {point.x(), point.y(), point.z()};
    }
  }
  sensor_msgs::PointCloud2 message;
  pcl::toROSMsg(cloud, message);
  return message;
}

TEST(CloudReader, FindsTheCameraOfAnOrganisedCloud) {
  CameraModel camera = testCamera(320, 240);
  camera.fy = 270.0;
  camera.cx = 150.0;
  const OwnedDepth<float> depth = planeDepth(camera, upOf(0.2), 0.8);  // NaN over the horizon
  CloudReader reader;
  std::string error;
  const auto image = reader.read(organisedCloud(camera, depth), error);
  ASSERT_TRUE(image) << error;
  EXPECT_NEAR(image->camera.fx, camera.fx, 1e-3);
  EXPECT_NEAR(image->camera.fy, camera.fy, 1e-3);
  EXPECT_NEAR(image->camera.cx, camera.cx, 1e-3);
  EXPECT_NEAR(image->camera.cy, camera.cy, 1e-3);
  EXPECT_EQ(metresAt(image->depth, 100, 200), metresAt(depth.view(), 100, 200));
}

/// Any of PCL's types will do, with fields in any place and rows that are padded.
TEST(CloudReader, ReadsTheFieldsWhereTheyAre) {
  const CameraModel camera = testCamera(64, 48);
  const OwnedDepth<float> depth = planeDepth(camera, upOf(0.6), 0.8);
  const sensor_msgs::PointCloud2 packed = organisedCloud(camera, depth);
  sensor_msgs::PointCloud2 cloud = packed;
  std::swap(cloud.fields[0].offset, cloud.fields[2].offset);  // z y x
  cloud.row_step += 12;
  cloud.data.assign(cloud.row_step * cloud.height, 77);
  for (std::uint32_t v = 0; v < cloud.height; ++v) {
    for (std::uint32_t u = 0; u < cloud.width; ++u) {
      const auto from = packed.data.begin() + v * packed.row_step + u * packed.point_step;
      const auto to = cloud.data.begin() + v * cloud.row_step + u * cloud.point_step;
      std::copy_n(from, 4, to + 8);
      std::copy_n(from + 4, 4, to + 4);
      std::copy_n(from + 8, 4, to);
    }
  }
  cloud.data.resize(cloud.data.size() - 12);  // the last row need not be padded
  CloudReader reader;
  std::string error;
  const auto image = reader.read(cloud, error);
  ASSERT_TRUE(image) << error;
  EXPECT_NEAR(image->camera.cx, camera.cx, 1e-3);
  for (const int v : {0, 47}) {
    EXPECT_EQ(metresAt(image->depth, 63, v), metresAt(depth.view(), 63, v));
  }
}

TEST(CloudReader, SaysWhatIsWrongWithACloud) {
  const CameraModel camera = testCamera(64, 48);
  const auto cloud = organisedCloud(camera, planeDepth(camera, upOf(0.6), 0.8));
  CloudReader reader;
  const auto expectError = [&](const sensor_msgs::PointCloud2& bad, const char* words) {
    std::string error;
    EXPECT_FALSE(reader.read(bad, error));
    EXPECT_NE(error.find(words), std::string::npos) << error;
  };
  const auto change = [&](const std::function<void(sensor_msgs::PointCloud2&)>& how) {
    sensor_msgs::PointCloud2 changed = cloud;
    how(changed);
    return changed;
  };
  const auto setX = [](sensor_msgs::PointCloud2& c, std::size_t point, float x) {
    std::memcpy(&c.data[point * c.point_step], &x, sizeof(x));
  };
  expectError(change([](auto& c) {
                c.width *= c.height;
                c.height = 1;
              }),
              "organised");
  expectError(change([&](auto& c) {
                for (std::size_t i = 0; i < 64 * 48; ++i) {
                  setX(c, i, std::numeric_limits<float>::quiet_NaN());
                }
              }),
              "got 0");
  expectError(change([&](auto& c) {
                for (std::size_t i = 0; i < 64 * 48; ++i) setX(c, i, 0.01F * static_cast<float>(i));
              }),
              "pinhole");
  expectError(sensor_msgs::PointCloud2(), "organised");
  expectError(change([](auto& c) { c.data.pop_back(); }), "bytes of points");
  expectError(change([](auto& c) { c.row_step = 4; }), "row_step of at least 1024");
  expectError(change([](auto& c) { c.height = 0xffffffffU; }), "organised");
  expectError(change([](auto& c) { c.point_step = 0; }), "fields");
  expectError(change([](auto& c) { c.fields.pop_back(); }), "fields");
  expectError(change([](auto& c) { c.fields[1].offset = 13; }), "fields");
  expectError(change([](auto& c) { c.fields[1].offset = 0xfffffffeU; }), "fields");
  expectError(change([](auto& c) { c.fields[0].datatype = sensor_msgs::PointField::FLOAT64; }),
              "fields");
  expectError(change([](auto& c) { c.is_bigendian = 1; }), "byte order");
}

class DetectionMessages : public testing::Test {
 protected:
  DetectionMessages() {
    OwnedDepth<float> metres = planeDepth(camera_, upOf(0.6), 0.8);
    for (int v = 200; v < 260; ++v) {
      for (int u = 300; u < 360; ++u) metres.at(u, v) *= 0.7F;  // obstacle
      for (int u = 100; u < 160; ++u) metres.at(u, v) *= 1.3F;  // hole
    }
    depth_ = inMillimetres(metres);
    rays_.build(camera_);
    header_.stamp = ros::Time(12, 34);
    header_.frame_id = "optical";
  }
  const CameraModel camera_ = testCamera();
  OwnedDepth<std::uint16_t> depth_{1, 1};
  RayTable rays_;
  std_msgs::Header header_;
  DominantPlaneDetector detector_;
};

TEST_F(DetectionMessages, PlaneCoefficientsAndMask) {
  const Detection& detection = detector_.detect(depth_.view(), camera_);
  ASSERT_TRUE(detection.found());
  const auto plane = planeMessage(header_, detection, 0.001);
  EXPECT_EQ(plane->header.stamp, header_.stamp);
  EXPECT_EQ(plane->header.frame_id, "optical");
  EXPECT_EQ(plane->state, DominantPlane::FOUND);
  EXPECT_NEAR(plane->normal.y, -std::cos(0.6), 1e-3);
  EXPECT_NEAR(plane->distance, 0.8, 1e-3);
  // Row-major: the last row and column are the distance's.
  EXPECT_EQ(plane->covariance[15], detection.covariance(3, 3));
  EXPECT_EQ(plane->covariance[7], detection.covariance(1, 3));
  EXPECT_GT(plane->covariance[15], 0.0);
  EXPECT_EQ(plane->up_source, DominantPlane::UP_FIXED);
  const auto coefficients = coefficientsMessage(header_, detection);
  ASSERT_EQ(coefficients->values.size(), 4U);
  EXPECT_NEAR(static_cast<double>(coefficients->values[3]), plane->distance, 1e-6);
  const auto mask = maskMessage(header_, detection);
  EXPECT_EQ(mask->encoding, "mono8");
  EXPECT_EQ(std::count(mask->data.begin(), mask->data.end(), 255),
            static_cast<std::ptrdiff_t>(plane->inliers));
  EXPECT_EQ(mask->data[220 * 640 + 330], 0);
  EXPECT_EQ(mask->data[400 * 640 + 330], 255);
}

TEST_F(DetectionMessages, PlanesAreTheDominantOneAndFurtherOnesByKind) {
  Detection detection = detector_.detect(depth_.view(), camera_);
  const auto alone = planeIndexMessage(header_, detection);
  EXPECT_EQ(std::count(alone->data.begin(), alone->data.end(), 1),
            static_cast<std::ptrdiff_t>(detection.inliers));
  FurtherPlane table;
  table.kind = PlaneKind::kTable;
  table.normal = {0.0, -1.0, 0.0};
  table.distance = 0.3;
  table.covariance(3, 3) = 0.25;
  table.mean_square_error = 0.01;
  table.inliers = 1000;
  detection.further_planes.push_back(table);
  detection.plane_index.assign(640 * 480, 2);
  const auto planes = planesMessage(header_, detection, 0.001);
  EXPECT_EQ(planes->header.frame_id, "optical");
  ASSERT_EQ(planes->planes.size(), 2U);
  EXPECT_EQ(planes->kinds,
            (std::vector<std::uint8_t>{DominantPlaneArray::FLOOR, DominantPlaneArray::TABLE}));
  EXPECT_EQ(planes->planes[0].distance, detection.distance);
  EXPECT_EQ(planes->planes[1].state, DominantPlane::FOUND);
  EXPECT_EQ(planes->planes[1].header.stamp, header_.stamp);
  EXPECT_EQ(planes->planes[1].normal.y, -1.0);
  EXPECT_EQ(planes->planes[1].distance, 0.3);
  EXPECT_EQ(planes->planes[1].covariance[15], 0.25);
  EXPECT_EQ(planes->planes[1].mean_square_error, 0.01);
  EXPECT_EQ(planes->planes[1].inliers, 1000U);
  EXPECT_NEAR(static_cast<double>(planes->planes[1].inlier_share),
              1000.0 / static_cast<double>(detection.valid_pixels), 1e-6);
  EXPECT_EQ(planeIndexMessage(header_, detection)->data, detection.plane_index);

  const auto outlines = furtherOutlines(detection, rays_);
  ASSERT_EQ(outlines.size(), 1U);
  ASSERT_GE(outlines[0].size(), 3U);
  for (const Eigen::Vector3d& corner : outlines[0]) EXPECT_NEAR(corner.y(), 0.3, 1e-6);
  visualization_msgs::MarkerArray markers;
  addFurtherPlanes(header_, detection, outlines, markers);
  ASSERT_EQ(markers.markers.size(), 1U);
  EXPECT_EQ(markers.markers[0].points.size(), outlines[0].size() + 1) << "closed";
  EXPECT_GT(markers.markers[0].lifetime.toSec(), 0.0);

  const OwnedDepth<std::uint16_t> empty(640, 480);
  EXPECT_TRUE(planesMessage(header_, detector_.detect(empty.view(), camera_), 0.0)->planes.empty());
}

TEST_F(DetectionMessages, HeightsAndIndicesOfObstacles) {
  const Detection& detection = detector_.detect(depth_.view(), camera_);
  ASSERT_TRUE(detection.found());
  const auto image = heightMessage(header_, depth_.view(), rays_, detection);
  EXPECT_EQ(image->encoding, "32FC1");
  EXPECT_EQ(image->header.frame_id, "optical");
  ASSERT_EQ(image->step, 4U * 640U);
  ASSERT_EQ(image->data.size(), 4U * 640U * 480U);
  const auto* heights = reinterpret_cast<const float*>(image->data.data());
  const auto indices = obstacleIndices(header_, detection);
  EXPECT_EQ(indices->header.stamp, header_.stamp);
  std::vector<std::int32_t> expected;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const float height = heights[v * 640 + u];
      const DepthView view = depth_.view();
      const auto z = static_cast<double>(metresAt(view, u, v));
      if (detection.label(u, v) == Label::kObstacle) expected.push_back(v * 640 + u);
      if (z == 0.0) {
        ASSERT_TRUE(std::isnan(height)) << u << ", " << v;
        continue;
      }
      const Eigen::Vector2d ray = camera_.ray({u, v});
      const double truth = detection.height({z * ray.x(), z * ray.y(), z});
      ASSERT_NEAR(static_cast<double>(height), truth, 1e-4) << u << ", " << v;
    }
  }
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(indices->indices, expected);

  const OwnedDepth<std::uint16_t> empty(640, 480);
  const Detection& none = detector_.detect(empty.view(), camera_);
  const auto nothing = heightMessage(header_, empty.view(), rays_, none);
  EXPECT_TRUE(std::isnan(reinterpret_cast<const float*>(nothing->data.data())[1000]));
  EXPECT_TRUE(obstacleIndices(header_, none)->indices.empty());
}

TEST_F(DetectionMessages, NoPlaneIsNaNWithAReason) {
  const OwnedDepth<std::uint16_t> empty(640, 480);
  const auto plane = planeMessage(header_, detector_.detect(empty.view(), camera_), 0.001);
  EXPECT_EQ(plane->state, DominantPlane::NO_DEPTH);
  EXPECT_FALSE(plane->reason.empty());
  EXPECT_TRUE(std::isnan(plane->normal.x) && std::isnan(plane->distance) &&
              std::isnan(plane->mean_square_error) && std::isnan(plane->inlier_share));
  EXPECT_EQ(plane->inliers, 0U);
}

TEST_F(DetectionMessages, CloudsHoldTheLabelledPointsInPclsLayout) {
  const Detection& detection = detector_.detect(depth_.view(), camera_);
  const auto message = labelledPoints(depth_.view(), rays_, detection, Label::kObstacle);
  EXPECT_EQ(message->point_step, 16U);
  ASSERT_EQ(message->fields.size(), 3U);
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(message->fields[i].offset, 4 * i);
  pcl::PointCloud<pcl::PointXYZ> cloud;
  pcl::fromROSMsg(*message, cloud);
  ASSERT_NEAR(static_cast<double>(cloud.size()), 3600.0, 10.0);
  for (const auto& point : cloud) {
    const double height =
        detection.normal.dot(point.getVector3fMap().cast<double>()) + detection.distance;
    EXPECT_NEAR(height, 0.3 * 0.8, 0.005);  // seen at 0.7 of the floor's distance
  }
}

/// costmap_2d, pointcloud_to_laserscan and PCL read clouds by their fields' names and types.
TEST_F(DetectionMessages, CloudsAreThinnedOutMovedAndColoured) {
  const Detection& detection = detector_.detect(depth_.view(), camera_);
  pcl::PointCloud<pcl::PointXYZ> all;
  pcl::fromROSMsg(*labelledPoints(depth_.view(), rays_, detection, Label::kGround), all);
  cv::Mat picture(480, 640, CV_8UC3);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      picture.at<cv::Vec3b>(v, u) = {static_cast<std::uint8_t>(v / 2),
                                     static_cast<std::uint8_t>(u / 3), 7};
    }
  }
  CloudForm form;
  form.stride = 5;
  form.coloured = true;
  form.bgr = &picture;
  form.transform.linear() = Eigen::AngleAxisf(0.3F, Eigen::Vector3f::UnitX()).toRotationMatrix();
  form.transform.translation() = Eigen::Vector3f(1.0F, 2.0F, 3.0F);
  const auto message = labelledPoints(depth_.view(), rays_, detection, Label::kGround, form);
  std::vector<std::string> names;
  for (const auto& field : message->fields) {
    names.push_back(field.name);
    EXPECT_EQ(field.datatype, sensor_msgs::PointField::FLOAT32);
    EXPECT_EQ(field.count, 1U);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"x", "y", "z", "rgb"}));
  EXPECT_EQ(message->height, 1U);
  EXPECT_EQ(message->row_step, message->width * message->point_step);
  EXPECT_EQ(message->data.size(), message->row_step);
  EXPECT_TRUE(message->is_dense);
  pcl::PointCloud<pcl::PointXYZRGB> thin;
  pcl::fromROSMsg(*message, thin);
  EXPECT_NEAR(static_cast<double>(thin.size()), static_cast<double>(all.size()) / 25.0, 200.0);
  for (const auto& point : thin) {
    const Eigen::Vector3f seen = form.transform.inverse() * point.getVector3fMap();
    const auto at = [](float ratio, double focal_length, double middle) {
      return static_cast<int>(std::lround(focal_length * static_cast<double>(ratio) + middle));
    };
    const int u = at(seen.x() / seen.z(), camera_.fx, camera_.cx);
    const int v = at(seen.y() / seen.z(), camera_.fy, camera_.cy);
    ASSERT_EQ(u % 5, 0);
    ASSERT_EQ(v % 5, 0);
    ASSERT_EQ(detection.label(u, v), Label::kGround);
    ASSERT_EQ(point.b, v / 2);
    ASSERT_EQ(point.g, u / 3);
    ASSERT_EQ(point.r, 7);
  }
  form.bgr = nullptr;
  pcl::fromROSMsg(*labelledPoints(depth_.view(), rays_, detection, Label::kGround, form), thin);
  EXPECT_EQ(thin.front().r + thin.front().g + thin.front().b, 0);
}

/// What costmap_2d's laser projection reads: angle_min + i * angle_increment, ranges in
/// [range_min, range_max], +Inf for free (REP 117).
TEST_F(DetectionMessages, ScansHoldWhatWasScanned) {
  GroundScan scan;
  scan.angle_min = -0.5;
  scan.angle_increment = 0.25;
  scan.range_min = 0.05;
  scan.range_max = 3.5;
  scan.ranges = {1.0F, NAN, 2.0F, INFINITY, 3.0F};
  const auto message = scanMessage(header_, scan);
  EXPECT_EQ(message->header.stamp, header_.stamp);
  EXPECT_EQ(message->header.frame_id, header_.frame_id);
  EXPECT_FLOAT_EQ(message->angle_min, -0.5F);
  EXPECT_FLOAT_EQ(message->angle_max, 0.5F);
  EXPECT_FLOAT_EQ(message->angle_increment, 0.25F);
  EXPECT_FLOAT_EQ(message->range_min, 0.05F);
  EXPECT_FLOAT_EQ(message->range_max, 3.5F);
  ASSERT_EQ(message->ranges.size(), 5U);
  EXPECT_EQ(message->ranges[2], 2.0F);
  EXPECT_TRUE(std::isnan(message->ranges[1]) && message->ranges[3] == INFINITY);
  // All readings are of one image.
  EXPECT_EQ(message->time_increment, 0.0F);
  EXPECT_TRUE(message->intensities.empty());
  const auto empty = scanMessage(header_, GroundScan());
  EXPECT_TRUE(empty->ranges.empty());
  EXPECT_EQ(empty->angle_min, empty->angle_max);
}

TEST_F(DetectionMessages, ATrackAndItsUpAreTold) {
  Prior prior;
  prior.expected_up = detector_.detect(depth_.view(), camera_).normal;
  prior.up_source = UpSource::kImu;
  const Detection first = detector_.detect(depth_.view(), camera_, prior);
  EXPECT_FALSE(planeMessage(header_, first, 0.001)->tracked);
  prior.predicted_plane = Prior::PredictedPlane{first.normal, first.distance};
  const auto followed =
      planeMessage(header_, detector_.detect(depth_.view(), camera_, prior), 0.001);
  EXPECT_TRUE(followed->tracked);
  EXPECT_EQ(followed->up_source, DominantPlane::UP_IMU);
}

TEST_F(DetectionMessages, OverlayPaintsByLabel) {
  const Detection& detection = detector_.detect(depth_.view(), camera_);
  cv::Mat picture(480, 640, CV_8UC3, cv::Scalar(100, 100, 100));
  paintOverlay(detection, picture);
  EXPECT_EQ(picture.at<cv::Vec3b>(400, 330), cv::Vec3b(0, 0, 0));
  const cv::Vec3b obstacle = picture.at<cv::Vec3b>(220, 330),
                  hole = picture.at<cv::Vec3b>(220, 130);
  EXPECT_GT(obstacle[2], 140);  // red
  EXPECT_LT(obstacle[1], 100);
  EXPECT_GT(hole[2], 140);  // yellow
  EXPECT_GT(hole[1], 130);
  const cv::Mat grey = greyPicture(depth_.view());
  EXPECT_GT(grey.at<cv::Vec3b>(479, 320)[0], grey.at<cv::Vec3b>(300, 320)[0]);  // near is bright
}

class Outline : public testing::Test {
 protected:
  Outline() {
    rays_.build(camera_);
    detection_.state = State::kFound;
    detection_.normal = upOf(0.6, 0.1);
    detection_.distance = 0.8;
    detection_.image_width = camera_.width;
    detection_.image_height = camera_.height;
    detection_.labels.assign(640 * 480, static_cast<std::uint8_t>(Label::kUnknown));
  }
  void markGround(int u, int v) {
    detection_.labels[static_cast<std::size_t>(640 * v + u)] =
        static_cast<std::uint8_t>(Label::kGround);
  }

  CameraModel camera_ = testCamera();
  RayTable rays_;
  Detection detection_;
};

TEST_F(Outline, IsTheHullOfTheGroundOnThePlane) {
  for (int v = 200; v <= 400; ++v) {
    for (int u = 100; u <= 500; ++u) markGround(u, v);
  }
  const auto outline = groundOutline(detection_, rays_);
  std::vector<Eigen::Vector2d> pixels;
  for (const Eigen::Vector3d& corner : outline) {
    EXPECT_NEAR(detection_.normal.dot(corner) + detection_.distance, 0.0, 1e-6);
    pixels.emplace_back(camera_.fx * corner.x() / corner.z() + camera_.cx,
                        camera_.fy * corner.y() / corner.z() + camera_.cy);
  }
  // A rectangle in the image: all corners are on its border, and its own four are among them.
  for (const Eigen::Vector2d& pixel : pixels) {
    const double across = std::min(std::abs(pixel.x() - 100.0), std::abs(pixel.x() - 500.0));
    const double down = std::min(std::abs(pixel.y() - 200.0), std::abs(pixel.y() - 400.0));
    EXPECT_LT(std::min(across, down), 0.05);
  }
  for (const Eigen::Vector2d& own : {Eigen::Vector2d(100, 200), Eigen::Vector2d(500, 200),
                                     Eigen::Vector2d(100, 400), Eigen::Vector2d(500, 400)}) {
    EXPECT_TRUE(std::any_of(pixels.begin(), pixels.end(), [&](const Eigen::Vector2d& pixel) {
      return (pixel - own).norm() < 0.05;
    }));
  }
}

TEST_F(Outline, IsEmptyWithoutAHull) {
  EXPECT_TRUE(groundOutline(detection_, rays_).empty()) << "no ground";
  markGround(320, 300);
  EXPECT_TRUE(groundOutline(detection_, rays_).empty()) << "a point";
  detection_.state = State::kTooSmall;
  for (int u = 0; u < 640; ++u) markGround(u, 300 + u % 7);
  EXPECT_TRUE(groundOutline(detection_, rays_).empty()) << "no plane";
}

TEST_F(Outline, MarkersAreASheetAndAnArrowAlongTheNormal) {
  for (int v = 200; v <= 400; ++v) markGround(v, v), markGround(600 - v / 2, v);
  const auto outline = groundOutline(detection_, rays_);
  std_msgs::Header header;
  header.frame_id = "optical";
  const auto markers = markersMessage(header, detection_, outline);
  ASSERT_EQ(markers->markers.size(), 2U);
  EXPECT_EQ(markers->markers[0].points.size(), 3 * outline.size());
  const auto& arrow = markers->markers[1];
  ASSERT_EQ(arrow.points.size(), 2U);
  EXPECT_EQ(arrow.header.frame_id, "optical");
  EXPECT_NEAR(arrow.points[1].x - arrow.points[0].x, 0.3 * detection_.normal.x(), 1e-9);
  EXPECT_NEAR(arrow.points[1].z - arrow.points[0].z, 0.3 * detection_.normal.z(), 1e-9);
  const auto gone = markersMessage(header, detection_, {});
  for (const auto& marker : gone->markers) {
    EXPECT_EQ(marker.action, visualization_msgs::Marker::DELETE);
  }
  EXPECT_EQ(outlineMessage(header, outline)->polygon.points.size(), outline.size());
}

}  // namespace
}  // namespace dominant_plane_detection
