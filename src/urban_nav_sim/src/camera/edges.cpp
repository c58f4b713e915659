// SPDX-License-Identifier: BSD-3-Clause
#include "camera/edges.hpp"

#include <algorithm>
#include <array>
#include <bitset>

#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector3f;

constexpr int kRaysOfPixel = 4;                   // per pixel
constexpr int kTogether = kLanes / kRaysOfPixel;  // pixels per packet

/// Sample pattern of non-attacking queens: an edge of any direction passes the samples one at a time.
constexpr std::array<int, kRaysOfPixel> kRow = {2, 0, 3, 1};
float along(int i) { return (static_cast<float>(i) + 0.5F) / kRaysOfPixel - 0.5F; }

int bits(std::uint32_t mask) { return static_cast<int>(std::bitset<kLanes>(mask).count()); }

class Smoother {
 public:
  Smoother(const Tracer& tracer, const Eye& eye, const Traces& traces, Picture& picture)
      : tracer_(tracer),
        eye_(eye),
        traces_(traces),
        picture_(picture),
        seams_(tracer, traces, picture.width, picture.height) {}

  void row(int v) const {
    std::array<Pixel, kTogether> waiting{};
    int count = 0;
    for (int u = 0; u < picture_.width; ++u) {
      const Edge edge = seams_.at(u, v);
      if (edge == Edge::None) continue;
      waiting[static_cast<std::size_t>(count++)] = {u, edge};
      if (count == kTogether) {
        smooth(waiting, count, v);
        count = 0;
      }
    }
    if (count > 0) smooth(waiting, count, v);
  }

 private:
  struct Pixel {
    int u = 0;
    Edge edge = Edge::None;
  };
  /// Rays of a pixel that hit the same surface.
  struct Share {
    int first = 0;  ///< lane
    std::uint32_t lanes = 0;
  };
  struct Shares {
    std::array<Share, kRaysOfPixel> all;
    int count = 0;
  };

  void smooth(const std::array<Pixel, kTogether>& waiting, int count, int v) const {
    Packet packet;
    std::array<std::array<int, 2>, kLanes> pixels{};
    for (int lane = 0; lane < kLanes; ++lane) {
      const int i = lane % kRaysOfPixel,
                u = waiting[static_cast<std::size_t>(std::min(lane / kRaysOfPixel, count - 1))].u;
      pixels[static_cast<std::size_t>(lane)] = {u, v};
      eye_.aim(lane, u, v, along(i), along(kRow[static_cast<std::size_t>(i)]), packet);
    }
    packet.active = (1U << count * kRaysOfPixel) - 1U;
    Eye::Seen seen;
    eye_.trace(packet, seen);
    std::array<Shares, kTogether> shares;
    std::uint32_t lanes = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      shares[k] = computeShares(seen, static_cast<int>(k) * kRaysOfPixel);
      for (int i = 0; i < shares[k].count; ++i) {
        const Share& share = shares[k].all[static_cast<std::size_t>(i)];
        if (waiting[k].edge == Edge::OfShadow) lanes |= share.lanes;
        else if (!isMiddle(seen, share, waiting[k].u, v)) lanes |= 1U << share.first;
      }
    }
    eye_.examine(packet, pixels, lanes, seen);
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
      put(packet, seen, shares[k], lanes, picture_.at(waiting[k].u, v));
  }

  Shares computeShares(const Eye::Seen& seen, int begin) const {
    Shares shares;
    for (int lane = begin; lane < begin + kRaysOfPixel; ++lane) {
      const Met met{seen.hits.facet[lane], seen.hits.mover[lane]};
      int i = 0;
      for (; i < shares.count; ++i) {
        const int first = shares.all[static_cast<std::size_t>(i)].first;
        if (areSame(tracer_, {seen.hits.facet[first], seen.hits.mover[first]}, met)) break;
      }
      Share& share = shares.all[static_cast<std::size_t>(i)];
      if (i == shares.count) {
        share.first = lane;
        ++shares.count;
      }
      share.lanes |= 1U << lane;
    }
    return shares;
  }

  /// Returns whether it is the surface hit by the centre of the pixel.
  bool isMiddle(const Eye::Seen& seen, const Share& share, int u, int v) const {
    const std::size_t pixel = picture_.at(u, v);
    return areSame(tracer_, traces_.met[pixel], {seen.hits.facet[share.first], seen.hits.mover[share.first]});
  }

  /// Writes the mean over the shares. `examined`: lanes with known light; for a share without any, the light
  /// is already in the picture.
  void put(const Packet& packet, const Eye::Seen& seen, const Shares& shares, std::uint32_t examined,
           std::size_t pixel) const {
    const auto channels = static_cast<std::size_t>(picture_.channels);
    float* radiance = &picture_.radiance[pixel * channels];
    std::array<float, 3> sum{};
    for (int i = 0; i < shares.count; ++i) {
      const auto [first, lanes] = shares.all[static_cast<std::size_t>(i)];
      std::array<float, 3> own{};
      if ((lanes & examined) == 0) {
        std::copy_n(radiance, channels, own.begin());
      } else {
        urban_nav_sim::put(seen.met(first) ? eye_.light(packet, seen, first, lanes & examined)
                                           : eye_.skyLight(packet.beamDirection(first)),
                           picture_.channels, own.data());
      }
      for (std::size_t c = 0; c < channels; ++c) sum[c] += static_cast<float>(bits(lanes)) * own[c];
    }
    for (std::size_t c = 0; c < channels; ++c) radiance[c] = sum[c] / kRaysOfPixel;
  }

  const Tracer& tracer_;
  const Eye& eye_;
  const Traces& traces_;
  Picture& picture_;
  Seams seams_;
};

}  // namespace

void smoothEdges(const Tracer& tracer, const Eye& eye, const Traces& traces, Picture& picture) {
  const Smoother smoother(tracer, eye, traces, picture);
  urban_nav_core::forEach(static_cast<std::size_t>(picture.height), 4,
                          [&](std::size_t row) { smoother.row(static_cast<int>(row)); });
}

}  // namespace urban_nav_sim
