#include "calibration/fit_plot.h"

#include <gnuplot-iostream.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace dominant_plane_detection {
namespace {

using Points = std::vector<std::pair<double, double>>;

Points curveOf(const std::vector<DepthPair>& pairs, const DepthCalibration& calibration) {
  const auto [least, most] = std::minmax_element(
      pairs.begin(), pairs.end(), [](const auto& p, const auto& q) { return p.raw < q.raw; });
  constexpr int kSteps = 400;
  Points curve;
  for (int i = 0; i <= kSteps; ++i) {
    const double raw = least->raw + (most->raw - least->raw) * i / kSteps;
    curve.emplace_back(raw, calibration.evaluate(raw));
  }
  return curve;
}

/// @return a text as it stands between gnuplot's single quotes.
std::string quoted(std::string text) {
  for (std::size_t i = text.find('\''); i != std::string::npos; i = text.find('\'', i + 2)) {
    text.insert(i, 1, '\'');
  }
  return text;
}

}  // namespace

void plotFit(const std::string& file, const std::vector<DepthPair>& pairs, const DepthFit& fit) {
  Points used, left_out, residuals;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    (fit.outliers[i] ? left_out : used).emplace_back(pairs[i].raw, pairs[i].distance);
    if (!fit.outliers[i]) residuals.emplace_back(pairs[i].raw, 1000.0 * fit.residuals[i]);
  }
  const bool exponential = fit.calibration.form == DepthCalibration::Form::kExponential;
  std::error_code error;
  std::filesystem::remove(file, error);
  {
    Gnuplot gnuplot("gnuplot");
    gnuplot << "set terminal pngcairo size 900,900 font 'Sans,12'\n"
            << "set output '" << quoted(file) << "'\n"
            << "set multiplot layout 2,1\n"
            << "set lmargin 10\nset grid\nset key left top\nset xlabel 'raw depth value D'\n"
            << "set ylabel 'distance Z [m]'\n"
            << "plot '-' with lines lw 2 title '"
            << (exponential ? "Z = a exp(b D) + c exp(d D)" : "Z = 1 / (a + b D)") << "'"
            << ", '-' with points pt 7 title 'measured'";
    if (!left_out.empty()) gnuplot << ", '-' with points pt 2 lw 2 title 'left out'";
    gnuplot << '\n';
    gnuplot.send1d(curveOf(pairs, fit.calibration));
    gnuplot.send1d(used);
    if (!left_out.empty()) gnuplot.send1d(left_out);
    gnuplot << "set ylabel 'fitted minus measured [mm]'\nunset key\nset xzeroaxis lw 2\n"
            << "plot '-' with points pt 7\n";
    gnuplot.send1d(residuals);
    gnuplot << "unset multiplot\n";
  }
  if (!std::filesystem::exists(file, error)) {
    throw std::runtime_error(file +
                             ": no picture was drawn: is gnuplot installed, and can the "
                             "file be written?");
  }
}

}  // namespace dominant_plane_detection
