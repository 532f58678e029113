#include "calibration/depth_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dominant_plane_detection {
namespace {

using Form = DepthCalibration::Form;

constexpr double kTape = 0.002;  // [m] standard deviation of the distances
constexpr double kRaw = 0.2;     // [-] of the raw values

/// Pairs as somebody with a tape measure gets them.
std::vector<DepthPair> measure(const DepthCalibration& truth, const std::vector<double>& raws,
                               unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<DepthPair> pairs;
  for (const double raw : raws) {
    pairs.push_back(
        {raw + kRaw * normal(generator), truth.evaluate(raw) + kTape * normal(generator), 0.0});
  }
  return pairs;
}

std::vector<double> kinectRaws() {
  std::vector<double> raws;
  for (int i = 0; i < 25; ++i) raws.push_back(434.0 + 570.0 * i / 24.0);  // 0.5 to 4 m
  return raws;
}

std::vector<double> paperRaws() {
  return {30,  40,  50,  60,  75,  90,   110,  130,  160,  200,  250,  300, 400,
          500, 600, 700, 800, 900, 1000, 1100, 1200, 1400, 1600, 1800, 2000};
}

DepthFitOptions optionsFor(Form form) {
  DepthFitOptions options;
  options.form = form;
  options.raw_sigma = kRaw;
  return options;
}

/// How often the truth lies within one and within three standard errors.
struct Coverage {
  void add(double value, double truth, double error) {
    ++all;
    one += std::abs(value - truth) <= error ? 1 : 0;
    three += std::abs(value - truth) <= 3.0 * error ? 1 : 0;
  }
  int all = 0, one = 0, three = 0;
};

TEST(DepthFit, RecoversReciprocalConstantsWithinTheirErrors) {
  const DepthCalibration truth = DepthCalibration::kinect();
  Coverage a, b;
  for (unsigned seed = 0; seed < 100; ++seed) {
    const DepthFit fit =
        fitDepth(measure(truth, kinectRaws(), seed), optionsFor(Form::kReciprocal));
    a.add(fit.calibration.a, truth.a, fit.standard_errors.a);
    b.add(fit.calibration.b, truth.b, fit.standard_errors.b);
    EXPECT_LT(fit.standard_errors.a, 0.01 * truth.a);
  }
  std::cout << "within one standard error: a " << a.one << ", b " << b.one
            << " of 100; three: " << a.three << ", " << b.three << '\n';
  for (const Coverage& c : {a, b}) {
    EXPECT_GE(c.one, 58);  // 68 expected; two standard deviations of that count are 9
    EXPECT_LE(c.one, 80);
    EXPECT_GE(c.three, 97);
  }
}

TEST(DepthFit, RecoversExponentialConstantsWithinTheirErrors) {
  const DepthCalibration truth = DepthCalibration::paper();
  Coverage a, b, c, d;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const DepthFit fit =
        fitDepth(measure(truth, paperRaws(), seed), optionsFor(Form::kExponential));
    a.add(fit.calibration.a, truth.a, fit.standard_errors.a);
    b.add(fit.calibration.b, truth.b, fit.standard_errors.b);
    c.add(fit.calibration.c, truth.c, fit.standard_errors.c);
    d.add(fit.calibration.d, truth.d, fit.standard_errors.d);
  }
  std::cout << "within one standard error: a " << a.one << ", b " << b.one << ", c " << c.one
            << ", d " << d.one << " of 60; three: " << a.three << ", " << b.three << ", " << c.three
            << ", " << d.three << '\n';
  for (const Coverage& coverage : {a, b, c, d}) {
    EXPECT_GE(coverage.one, 33);  // 41 expected, less where a curve bends within its noise
    EXPECT_LE(coverage.one, 50);
    EXPECT_GE(coverage.three, 58);
  }
}

TEST(DepthFit, ExactPairsGiveExactConstants) {
  for (const Form form : {Form::kReciprocal, Form::kExponential}) {
    const bool exponential = form == Form::kExponential;
    const DepthCalibration truth =
        exponential ? DepthCalibration::paper() : DepthCalibration::kinect();
    std::vector<DepthPair> pairs;
    for (const double raw : exponential ? paperRaws() : kinectRaws()) {
      pairs.push_back({raw, truth.evaluate(raw), 0.0});
    }
    const DepthFit fit = fitDepth(pairs, optionsFor(form));
    EXPECT_NEAR(fit.calibration.a / truth.a, 1.0, 1e-4);
    EXPECT_NEAR(fit.calibration.b / truth.b, 1.0, 1e-4);
    if (exponential) {
      EXPECT_NEAR(fit.calibration.c / truth.c, 1.0, 1e-4);
      EXPECT_NEAR(fit.calibration.d / truth.d, 1.0, 1e-4);
    }
    EXPECT_LT(fit.worst, 1e-5);
  }
}

/// Few pairs hold little against a poor minimum of the many that a curve of four constants has.
TEST(DepthFit, FewExactPairsAreAllUsed) {
  const DepthCalibration truth = DepthCalibration::paper();
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(26.0, 2040.0);
  for (std::size_t n = 6; n <= 12; ++n) {
    for (int trial = 0; trial < 10; ++trial) {
      std::vector<DepthPair> pairs;
      while (pairs.size() < n) {
        const double raw = std::round(uniform(generator));
        pairs.push_back({raw, truth.evaluate(raw), 0.0});
      }
      const DepthFit fit = fitDepth(pairs, optionsFor(Form::kExponential));
      EXPECT_EQ(std::count(fit.outliers.begin(), fit.outliers.end(), true), 0) << n;
      EXPECT_LT(fit.worst, 1e-3) << n << " pairs, trial " << trial;
    }
  }
}

/// Of the residuals of few pairs little is known: the interval has to be the wider for it.
TEST(DepthFit, IntervalsHoldTheTruthInTwoOfThreeFitsHoweverFewPairs) {
  const DepthCalibration truth = DepthCalibration::kinect();
  for (const int n : {4, 6, 10}) {
    std::vector<double> raws;
    for (int i = 0; i < n; ++i) raws.push_back(434.0 + 570.0 * i / (n - 1.0));
    Coverage a, b;
    for (unsigned seed = 0; seed < 300; ++seed) {
      const DepthFit fit = fitDepth(measure(truth, raws, seed), optionsFor(Form::kReciprocal));
      a.add(fit.calibration.a, truth.a, fit.standard_errors.a);
      b.add(fit.calibration.b, truth.b, fit.standard_errors.b);
    }
    std::cout << n << " pairs: a " << a.one << ", b " << b.one << " of 300 within\n";
    for (const Coverage& c : {a, b}) {
      EXPECT_NEAR(c.one, 0.683 * 300, 24) << n;  // three standard deviations of that count
    }
  }
}

/// As many pairs as constants are left: they fit, and say nothing about how well.
TEST(DepthFit, WithoutASparePairTheErrorsAreUnknown) {
  const DepthCalibration truth = DepthCalibration::paper();
  std::vector<DepthPair> pairs;
  for (const double raw : {60.0, 200.0, 500.0, 1000.0, 1800.0}) {
    pairs.push_back({raw, truth.evaluate(raw), 0.0});
  }
  pairs[2].distance += 0.3;
  try {
    const DepthFit fit = fitDepth(pairs, optionsFor(Form::kExponential));
    EXPECT_EQ(fit.calibration.form, Form::kExponential);
    EXPECT_EQ(fit.standard_errors.form, Form::kExponential);
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("do not fit"), std::string::npos) << error.what();
  }
}

TEST(DepthFit, OutliersAreLeftOut) {
  for (const Form form : {Form::kReciprocal, Form::kExponential}) {
    const bool exponential = form == Form::kExponential;
    const DepthCalibration truth =
        exponential ? DepthCalibration::paper() : DepthCalibration::kinect();
    std::vector<DepthPair> pairs = measure(truth, exponential ? paperRaws() : kinectRaws(), 5);
    const DepthFit clean = fitDepth(pairs, optionsFor(form));
    pairs[4].distance += 0.3;
    pairs[17].distance -= 0.2;
    const DepthFit fit = fitDepth(pairs, optionsFor(form));
    EXPECT_EQ(std::count(fit.outliers.begin(), fit.outliers.end(), true), 2);
    EXPECT_TRUE(fit.outliers[4]);
    EXPECT_TRUE(fit.outliers[17]);
    EXPECT_NEAR(fit.calibration.a, clean.calibration.a, 2.0 * clean.standard_errors.a);
    EXPECT_NEAR(fit.calibration.b, clean.calibration.b, 2.0 * clean.standard_errors.b);
  }
}

TEST(DepthFit, AFormThatDoesNotFitIsNotThePairsFault) {
  const auto pairs = measure(DepthCalibration::kinect(), kinectRaws(), 3);
  const DepthFit reciprocal = fitDepth(pairs, optionsFor(Form::kReciprocal));
  const DepthFit exponential = fitDepth(pairs, optionsFor(Form::kExponential));
  EXPECT_LT(reciprocal.sigmas, 1.5);
  EXPECT_GT(exponential.sigmas, 3.0);
  EXPECT_EQ(std::count(exponential.outliers.begin(), exponential.outliers.end(), true), 0);
}

TEST(DepthFit, PairsMayBringTheirOwnErrors) {
  auto pairs = measure(DepthCalibration::kinect(), kinectRaws(), 4);
  for (std::size_t i = 0; i < 5; ++i) pairs[i].sigma = 0.001;
  for (std::size_t i = 5; i < pairs.size(); ++i) {
    pairs[i].sigma = 10.0;  // worth nothing
    pairs[i].distance *= 1.05;
  }
  const DepthFit fit = fitDepth(pairs, optionsFor(Form::kReciprocal));
  for (std::size_t i = 0; i < 5; ++i) EXPECT_LT(std::abs(fit.residuals[i]), 0.01);
  EXPECT_GT(fit.worst, 0.03);
}

/// The constants that the package ships for Eq. 1.
TEST(DepthFit, MinimaxGivesTheShippedExponentialForm) {
  const DepthCalibration curve = DepthCalibration::kinect();
  std::vector<DepthPair> table;
  for (int raw = 0; raw < 2047; ++raw) {
    const double z = curve.distance(raw);
    if (0.5 <= z && z <= 4.0) table.push_back({1.0 * raw, z, std::min(0.02 * z, 0.06)});
  }
  DepthFitOptions options;
  options.form = Form::kExponential;
  const DepthFit squares = fitDepth(table, options);
  options.minimax = true;
  const DepthFit fit = fitDepth(table, options);
  double largest = 0.0, largest_of_squares = 0.0;
  for (std::size_t i = 0; i < table.size(); ++i) {
    largest = std::max(largest, std::abs(fit.residuals[i]) / table[i].sigma);
    largest_of_squares =
        std::max(largest_of_squares, std::abs(squares.residuals[i]) / table[i].sigma);
  }
  std::cout << "largest error " << largest << " of min(2 %, 60 mm), by least squares "
            << largest_of_squares << '\n';
  EXPECT_LT(largest, 1.0);
  EXPECT_GT(largest_of_squares, 2.0);
  EXPECT_NEAR(fit.calibration.a, 8.596446e-07, 1e-9);
  EXPECT_NEAR(fit.calibration.b, 0.01481169, 1e-6);
  EXPECT_NEAR(fit.calibration.c, 0.2090978, 1e-4);
  EXPECT_NEAR(fit.calibration.d, 0.001962744, 1e-6);
}

std::string problemOf(const std::vector<DepthPair>& pairs, Form form = Form::kReciprocal) {
  try {
    fitDepth(pairs, optionsFor(form));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "none";
}

TEST(DepthFit, ExplainsWhatIsWrongWithPairs) {
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(problemOf({}), "too few pairs"));
  EXPECT_TRUE(has(problemOf({{500, 0.56}, {600, 0.67}}), "at least 3"));
  EXPECT_TRUE(has(problemOf({{500, 0.56}, {500, 0.57}, {500, 0.58}, {600, 0.67}}), "different"));
  EXPECT_TRUE(
      has(problemOf({{500, 0.56}, {600, 0.67}, {700, 0.85}, {800, 1.14}}, Form::kExponential),
          "at least 5"));
  EXPECT_TRUE(has(problemOf({{500, 3}, {600, 2}, {700, 1.5}, {800, 1}}), "not monotonic"));
  EXPECT_TRUE(has(problemOf({{500, 560}, {600, 670}, {700, 850}}), "metres"));
  EXPECT_TRUE(has(problemOf({{500, 0.56}, {2047, 0.67}, {700, 0.85}}), "2046"));
  EXPECT_TRUE(has(problemOf({{500, 0.56}, {600, NAN}, {700, 0.85}}), "metres"));
  EXPECT_TRUE(has(problemOf({{500, 0.56}, {600, 0.67, -1.0}, {700, 0.85}}), "deviation"));
  auto pairs = measure(DepthCalibration::kinect(), kinectRaws(), 6);
  for (std::size_t i = 0; i < pairs.size(); i += 3) pairs[i].distance *= 1.2;
  EXPECT_TRUE(has(problemOf(pairs), "do not fit")) << problemOf(pairs);
}

}  // namespace
}  // namespace dominant_plane_detection
