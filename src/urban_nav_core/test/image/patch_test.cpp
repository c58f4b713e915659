// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/patch.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace urban_nav_core {
namespace {

struct Picture {
  int width, height;
  std::vector<std::uint8_t> pixels;
  ImageView view() const { return {pixels.data(), width, height, width}; }
};

/// Waves of 4 to 30 px in all directions, with an exact value at any position.
class Texture {
 public:
  explicit Texture(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (Wave& wave : waves_) {
      const double length = 4.0 * std::pow(7.5, unit(random)), angle = 2.0 * M_PI * unit(random);
      wave = {2.0 * M_PI / length * std::cos(angle), 2.0 * M_PI / length * std::sin(angle), 2.0 * M_PI * unit(random),
              4.0 + 0.5 * length};
    }
  }
  double at(double x, double y) const {
    double value = 0.0;
    for (const Wave& wave : waves_) value += wave.size * std::sin(wave.kx * x + wave.ky * y + wave.phase);
    return 128.0 + value;
  }

 private:
  struct Wave {
    double kx, ky, phase, size;
  };
  std::array<Wave, 16> waves_{};
};

Picture render(int width, int height, double noise, unsigned seed, const std::function<double(double, double)>& grey) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, noise > 0.0 ? noise : 1.0);
  Picture picture{width, height, {}};
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const double value = grey(u, v) + (noise > 0.0 ? normal(random) : 0.0);
      picture.pixels.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0))));
    }
  return picture;
}

struct Statistics {
  Eigen::Vector2d bias = Eigen::Vector2d::Zero();
  double normalised = 0.0;  // mean of e^T C^-1 e, two dimensions
  int count = 0;
};

/// Aligns patches of an image to another, shifted by (du, dv).
Statistics alignShifted(double du, double dv, double noise, double gain, double offset, int patches) {
  Statistics s;
  for (int k = 0; k < patches; ++k) {
    const unsigned seed = static_cast<unsigned>(1000 + k);
    const Texture texture(seed);
    const Picture first = render(25, 25, noise, seed, [&](double x, double y) { return texture.at(x, y); });
    const Picture second = render(25, 25, noise, seed + 5000,
                                  [&](double x, double y) { return offset + gain * texture.at(x - du, y - dv); });
    const auto source = cutSource(first.view(), 12, 12);
    PatchTemplate made;
    if (!warpTemplate(*source, {}, made)) continue;
    const Alignment a = alignPatch(second.view(), made, {12.4, 11.7});
    if (!a.converged) continue;
    const Eigen::Vector2d error = a.position - Eigen::Vector2d(12 + du, 12 + dv);
    s.bias += error;
    s.normalised += error.dot(a.covariance.inverse() * error);
    ++s.count;
  }
  s.bias /= s.count;
  s.normalised /= s.count;
  return s;
}

TEST(Patch, RefinementHasNoBiasAtAnyPhase) {
  for (const double noise : {0.0, 1.0, 3.0, 6.0})
    for (int i = 0; i <= 20; ++i) {
      const double phase = 0.05 * i;
      const Statistics s = alignShifted(phase, 1.0 - phase, noise, 1.0, 0.0, 100);
      EXPECT_GT(s.count, 93) << "noise " << noise << " phase " << phase;
      EXPECT_LT(s.bias.cwiseAbs().maxCoeff(), 0.02) << "noise " << noise << " phase " << phase;
    }
}

TEST(Patch, CovarianceIsThatOfTheErrors) {
  for (const double noise : {1.0, 3.0, 6.0}) {
    const Statistics s = alignShifted(0.3, 0.6, noise, 1.0, 0.0, 400);
    // template and image each contribute the stated variance once: 2 x 2 dimensions
    EXPECT_GT(s.normalised, 2.8) << noise;
    EXPECT_LT(s.normalised, 5.2) << noise;
  }
}

TEST(Patch, LightDoesNotMoveIt) {
  const Statistics dim = alignShifted(0.3, 0.6, 1.0, 0.4, 10.0, 100);
  const Statistics bright = alignShifted(0.3, 0.6, 1.0, 1.3, -20.0, 100);
  EXPECT_GT(dim.count, 90);
  EXPECT_LT(dim.bias.norm(), 0.02);
  EXPECT_LT(bright.bias.norm(), 0.02);
}

TEST(Patch, GainNoiseAndCorrelationAreMeasured) {
  const Texture texture(3);
  const Picture first = render(41, 41, 2.0, 1, [&](double x, double y) { return texture.at(x, y); });
  const Picture second = render(41, 41, 2.0, 2, [&](double x, double y) { return 60.0 + 0.5 * texture.at(x, y); });
  PatchTemplate made;
  ASSERT_TRUE(warpTemplate(*cutSource(first.view(), 20, 20), {}, made));
  const Alignment a = alignPatch(second.view(), made, {20.0, 20.0});
  ASSERT_TRUE(a.converged);
  EXPECT_NEAR(a.gain, 0.5, 0.03);
  EXPECT_NEAR(a.noise, 2.0, 0.7);
  EXPECT_GT(a.correlation, 0.97);
}

TEST(Patch, CorrelationAtAPlaceIsThatOfTheAlignmentAndFallsAsideOfIt) {
  const Texture texture(3), other(4);
  const Picture first = render(41, 41, 1.0, 1, [&](double x, double y) { return texture.at(x, y); });
  const Picture second = render(41, 41, 1.0, 2, [&](double x, double y) { return 60.0 + 0.5 * texture.at(x, y); });
  const Picture negative = render(41, 41, 1.0, 3, [&](double x, double y) { return 250.0 - texture.at(x, y); });
  const Picture unlike = render(41, 41, 1.0, 4, [&](double x, double y) { return other.at(x, y); });
  PatchTemplate made;
  ASSERT_TRUE(warpTemplate(*cutSource(first.view(), 20, 20), {}, made));
  const Alignment a = alignPatch(second.view(), made, {20.0, 20.0});
  ASSERT_TRUE(a.converged);
  EXPECT_NEAR(correlationAt(second.view(), made, a.position), a.correlation, 1e-3);
  EXPECT_LT(correlationAt(second.view(), made, {24.0, 20.0}), a.correlation - 0.2);
  EXPECT_LT(correlationAt(negative.view(), made, {20.0, 20.0}), -0.9);
  EXPECT_LT(std::abs(correlationAt(unlike.view(), made, {20.0, 20.0})), 0.6);
  EXPECT_EQ(correlationAt(second.view(), made, {2.0, 20.0}), 0.0);
  EXPECT_EQ(correlationAt(second.view(), made, {std::nan(""), 20.0}), 0.0);
}

TEST(Patch, WarpFollowsScaleAndTurn) {
  Eigen::Vector2d bias = Eigen::Vector2d::Zero();
  int count = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Texture texture(seed);
    Eigen::Matrix2d A;
    A << 1.3, -0.2, 0.25, 1.2;
    const Eigen::Matrix2d B = A.inverse();
    const Eigen::Vector2d middle(20.35, 19.8);
    const Picture first = render(41, 41, 1.0, seed, [&](double x, double y) { return texture.at(x, y); });
    const Picture second = render(41, 41, 1.0, seed + 100, [&](double x, double y) {
      const Eigen::Vector2d p = Eigen::Vector2d(20.0, 20.0) + B * (Eigen::Vector2d(x, y) - middle);
      return texture.at(p.x(), p.y());
    });
    PatchTemplate made;
    if (!warpTemplate(*cutSource(first.view(), 20, 20), A, made)) continue;
    const Alignment a = alignPatch(second.view(), made, {20.0, 20.5});
    if (!a.converged || a.correlation < 0.9) continue;
    bias += a.position - middle;
    EXPECT_LT((a.position - middle).norm(), 0.25);
    ++count;
  }
  EXPECT_GT(count, 50);
  EXPECT_LT((bias / count).norm(), 0.02);
}

TEST(Patch, PerspectiveIsTakenIntoTheTemplate) {
  // On a wall alongside, pixels further ahead are enlarged less: an affine template has a second-order error that is
  // the same at all such positions.
  PatchWarp warp(Eigen::Matrix2d(Eigen::Vector2d(1.25, 1.15).asDiagonal()), {0.02, -0.005});
  const Eigen::Matrix2d back = warp.A.inverse();
  Eigen::Vector2d bias = Eigen::Vector2d::Zero(), without = Eigen::Vector2d::Zero();
  double noise = 0.0, noise_without = 0.0;
  int count = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Texture texture(seed + 1200);
    const Picture first = render(41, 41, 1.0, seed, [&](double x, double y) { return texture.at(x, y); });
    const Picture second = render(41, 41, 1.0, seed + 100, [&](double x, double y) {
      const Eigen::Vector2d q = back * Eigen::Vector2d(x - 20.3, y - 20.1);
      const Eigen::Vector2d p = q / (1.0 - warp.bend.dot(q));
      return texture.at(20.0 + p.x(), 20.0 + p.y());
    });
    const auto source = *cutSource(first.view(), 20, 20);
    PatchTemplate made, affine;
    if (!warpTemplate(source, warp, made) || !warpTemplate(source, warp.A, affine)) continue;
    const Alignment a = alignPatch(second.view(), made, {20.0, 20.0}),
                    b = alignPatch(second.view(), affine, {20.0, 20.0});
    if (!a.converged || !b.converged) continue;
    bias += a.position - Eigen::Vector2d(20.3, 20.1);
    without += b.position - Eigen::Vector2d(20.3, 20.1);
    noise += a.noise;
    noise_without += b.noise;
    ++count;
  }
  ASSERT_GT(count, 80);
  EXPECT_LT((bias / count).norm(), 0.02);
  EXPECT_GT((without / count).norm(), 4.0 * (bias / count).norm());
  EXPECT_LT(noise, 0.7 * noise_without);
  PatchTemplate made;
  const Texture texture(4);
  const Picture good = render(41, 41, 0.0, 1, [&](double x, double y) { return texture.at(x, y); });
  warp.bend.x() = 0.1;
  EXPECT_FALSE(warpTemplate(*cutSource(good.view(), 20, 20), warp, made));
}

TEST(Patch, SlopesOfDisparityAreFound) {
  Eigen::Vector2d slopes = Eigen::Vector2d::Zero(), bias = Eigen::Vector2d::Zero();
  int count = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Texture texture(seed + 300);
    const double d = 3.3, a = 0.1, b = 0.3;
    const Picture left = render(61, 41, 1.0, seed, [&](double x, double y) { return texture.at(x, y); });
    // u_right = u_left - d - a (u_left - 30) - b (v - 20), solved for u_left
    const Picture right = render(61, 41, 1.0, seed + 100, [&](double x, double y) {
      return texture.at(30.0 + (x - 30.0 + d + b * (y - 20.0)) / (1.0 - a), y);
    });
    PatchTemplate made;
    const SlopedAlignment found = alignAcross(right.view(), *cutSource(left.view(), 30, 20), {27.0, 20.0}, 0.05, made);
    if (!found.alignment.converged) continue;
    slopes += found.slopes;
    bias += found.alignment.position - Eigen::Vector2d(30.0 - d, 20.0);
    ++count;
  }
  ASSERT_GT(count, 90);
  EXPECT_LT((slopes / count - Eigen::Vector2d(0.1, 0.3)).norm(), 0.03);
  EXPECT_LT((bias / count).norm(), 0.02);
}

TEST(Patch, SlopesStayAtThePriorWithoutContrast) {
  double usual = 0.0, wide = 0.0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Texture texture(seed + 700);
    const Picture left = render(61, 41, 6.0, seed, [&](double x, double y) { return texture.at(x, y); });
    const Picture right = render(61, 41, 6.0, seed + 100, [&](double x, double y) { return texture.at(x + 3.3, y); });
    PatchTemplate made;
    const auto source = *cutSource(left.view(), 30, 20);
    usual += alignAcross(right.view(), source, {27.0, 20.0}, 0.01, made).slopes.norm();
    wide += alignAcross(right.view(), source, {27.0, 20.0}, 0.3, made).slopes.norm();
  }
  EXPECT_LT(usual, 0.5 * wide);
}

TEST(Patch, ALaterViewDeterminesTheSlant) {
  // The view is the source sheared by direction (slant . p); the template was made without the slant.
  const Eigen::Vector2d direction(0.6, -0.2), slant(0.2, -0.1);
  const Eigen::Matrix2d B = (Eigen::Matrix2d::Identity() + direction * slant.transpose()).inverse();
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int count = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Texture texture(seed + 900);
    const Picture first = render(41, 41, 1.0, seed, [&](double x, double y) { return texture.at(x, y); });
    const Picture second = render(41, 41, 1.0, seed + 100, [&](double x, double y) {
      const Eigen::Vector2d p = Eigen::Vector2d(20.0, 20.0) + B * Eigen::Vector2d(x - 20.3, y - 20.1);
      return texture.at(p.x(), p.y());
    });
    const auto source = *cutSource(first.view(), 20, 20);
    PatchTemplate made;
    if (!warpTemplate(source, {}, made)) continue;
    const Alignment a = alignPatch(second.view(), made, {20.0, 20.0});
    if (!a.converged) continue;
    Slope seen;
    seeSlant(second.view(), source, made, a, direction, {0.0, 0.0}, seen);
    const Slope::Estimate estimate = seen.under(0.3);
    EXPECT_LT(estimate.covariance.determinant(), 0.5 * std::pow(0.3, 4));
    sum += estimate.mean;
    ++count;
    // an observation at the present slant must not change it, in particular if its variance is small
    Slope sure;
    sure.see(1e9 * Eigen::Vector2d(0.1, 0.1), 1e9 * Eigen::Matrix2d::Identity());
    seeSlant(second.view(), source, made, a, direction, {0.0, 0.0}, sure);
    EXPECT_LT((sure.under(0.3).mean - Eigen::Vector2d(0.1, 0.1)).norm(), 1e-3);
  }
  ASSERT_GT(count, 50);
  EXPECT_LT((sum / count - slant).norm(), 0.03);
}

TEST(Patch, RefusesWhatHasNoTextureOrLeavesTheImage) {
  const Picture flat = render(41, 41, 0.0, 1, [](double, double) { return 90.0; });
  const Picture edge = render(41, 41, 0.0, 1, [](double x, double) { return x < 20 ? 20.0 : 200.0; });
  const Texture texture(4);
  const Picture good = render(41, 41, 0.0, 1, [&](double x, double y) { return texture.at(x, y); });
  PatchTemplate made;
  EXPECT_FALSE(warpTemplate(*cutSource(flat.view(), 20, 20), {}, made));
  EXPECT_FALSE(warpTemplate(*cutSource(edge.view(), 20, 20), {}, made));
  EXPECT_FALSE(warpTemplate(*cutSource(good.view(), 20, 20), Eigen::Matrix2d(Eigen::Matrix2d::Zero()), made));
  EXPECT_FALSE(cutSource(good.view(), 3, 20));
  EXPECT_FALSE(cutSource(ImageView{}, 0, 0));
  ASSERT_TRUE(warpTemplate(*cutSource(good.view(), 20, 20), {}, made));
  EXPECT_FALSE(alignPatch(good.view(), made, {2.0, 20.0}).converged);
  EXPECT_FALSE(alignPatch(good.view(), made, {std::nan(""), 20.0}).converged);
  EXPECT_FALSE(alignPatch(flat.view(), made, {20.0, 20.0}).converged);
}

TEST(Sad, EqualsItsDefinition) {
  const Texture texture(7);
  const Picture picture = render(40, 30, 4.0, 1, [&](double x, double y) { return texture.at(x, y); });
  const ImageView view = picture.view();
  const SadPatch patch = sadPatch(view, 12, 14);
  EXPECT_EQ(meanRemovedSad(patch, view, 12, 14), 0);
  for (int u = 4; u < 36; ++u)
    for (int v = 4; v < 25; ++v) {
      ASSERT_TRUE(sadFits(view, u, v));
      int total = 0;
      for (int j = -4; j <= 4; ++j)
        for (int i = -4; i < 4; ++i) total += view.at(u + i, v + j);
      const int mean = (2 * total + 72) / 144;
      int expected = 0;
      for (int j = -4; j <= 4; ++j)
        for (int i = -4; i < 4; ++i)
          expected +=
              std::abs(view.at(u + i, v + j) - mean - patch.value[static_cast<std::size_t>((j + 4) * 8 + i + 4)]);
      EXPECT_EQ(meanRemovedSad(patch, view, u, v), expected);
    }
  EXPECT_FALSE(sadFits(view, 3, 10));
  EXPECT_FALSE(sadFits(view, 37, 10));
}

TEST(Sad, OfATemplateIsThatOfItsSmoothedPixels) {
  const Texture texture(9);
  const Picture picture = render(41, 41, 0.0, 1, [&](double x, double y) { return texture.at(x, y); });
  PatchTemplate made;
  ASSERT_TRUE(warpTemplate(*cutSource(picture.view(), 20, 20), {}, made));
  const SadPatch patch = sadPatch(made);
  const int here = meanRemovedSad(patch, picture.view(), 20, 20);
  for (int u = 10; u < 30; ++u)
    for (int v = 10; v < 30; ++v) EXPECT_GE(meanRemovedSad(patch, picture.view(), u, v), here);
}

}  // namespace
}  // namespace urban_nav_core
