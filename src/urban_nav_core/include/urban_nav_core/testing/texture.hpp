// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace urban_nav_core::testing {

/// Point spread function of a pixel projected onto a plane, as a Gaussian: covariance in m^2.
struct Footprint {
  double xx = 0.0, xy = 0.0, yy = 0.0;
};

/// Noise of one scale: white noise on a square lattice, interpolated by cubic B-splines, with hardly any signal above
/// the lattice frequency.
struct Octave {
  double spacing = 0.1;    ///< of the lattice, m
  double amplitude = 5.0;  ///< standard deviation, grey levels
  bool patchy = false;     ///< only within a slowly varying mask, so that parts of the surface are smooth
};

/// Rectangles with sharp edges, one in each cell of a wall: bricks, windows, posters, slabs.
struct Cells {
  double width = 0.5, height = 0.25;        ///< of a cell, m
  double shift = 0.0;                       ///< offset of every other row, in cells
  double margin_x = 0.01, margin_y = 0.01;  ///< between the rectangle and its cell, m
  double share = 1.0;                       ///< share of the cells that have a rectangle
  double low = -20.0, high = 20.0;          ///< offset of a rectangle, grey levels, uniform per cell
  std::uint32_t seed = 0;                   ///< equal seeds select the same cells
};

/// Brightness of a surface as a formula that is evaluated at any point and scale and filtered analytically, so that its
/// image moves exactly as the geometry requires and is free of aliasing. At most kMost octaves and kMost patterns of
/// cells. Immutable, hence thread-safe.
class Texture {
 public:
  static constexpr std::size_t kMost = 6;

  Texture(double base, const std::vector<Octave>& octaves, const std::vector<Cells>& cells, std::uint32_t seed);

  /// Texture filtered by a footprint; valid for all places where the footprint is about the same.
  class Filter {
    friend class Texture;
    struct Wave {
      std::size_t which;
      double amplitude;
      int steps;              ///< along the footprint's long axis
      double step_x, step_y;  ///< lattice steps
    };
    struct Pattern {
      std::size_t which;
      double fade;
    };
    std::array<Wave, kMost> waves;
    std::array<Pattern, kMost> patterns;
    std::size_t wave_count = 0, pattern_count = 0;
    double base = 0.0;
    double per_sigma_x = 0.0, per_sigma_y = 0.0;
  };
  Filter filter(const Footprint& footprint) const;

  /// Returns the grey level (not clipped) at (x, y) m under a filter of this texture.
  double value(double x, double y, const Filter& filter) const;

  /// Evaluates kRun adjacent pixels of one row, faster: to within 1 % of each octave's amplitude.
  static constexpr std::size_t kRun = 8;
  using Run = std::array<double, kRun>;
  void values(const Run& x, const Run& y, const Filter& filter, Run& grey) const;

 private:
  struct Wave {
    double frequency;  ///< lattice steps per m
    double amplitude;
    bool patchy;
    double origin_x, origin_y;  ///< octaves share the lattice, each with its own origin
  };
  struct Pattern : Cells {
    double per_width, per_height;
    double mean;  ///< mean of the whole pattern, grey levels
  };
  struct Part;

  double noise(double x, double y) const;
  double mask(double x, double y) const;
  double waveValue(double x, double y, const Filter::Wave& filtered) const;
  template <typename Function>
  static void alongRun(const Run& x, const Run& y, double frequency, Function function, Run& out);
  static std::optional<int> commonRow(const Pattern& pattern, const Run& y, const Filter& filter);
  static bool isUniform(const Pattern& pattern, int row, const Run& x, const Filter& filter);
  static double sampleGrey(const Pattern& pattern, int column, int row);
  static Part part(double x, double size, double per_size, double margin, double per_sigma);
  static double rowValue(const Pattern& pattern, int row, double x, double per_sigma_x);
  static double patternValue(const Pattern& pattern, double x, double y, const Filter& filter);

  double base_;
  std::vector<Wave> waves_;
  std::vector<Pattern> patterns_;
  std::vector<float> lattice_;  ///< three rows and columns more than its period, so that four neighbours need no
                                ///< wrap-around
};

}  // namespace urban_nav_core::testing
