// SPDX-License-Identifier: BSD-3-Clause
// A stereo pair of 512x384 of the small renderer on one core, noise included.
#include <benchmark/benchmark.h>

#include "urban_nav_core/testing/rendered_sequence.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_core/testing/textured_street.hpp"

namespace {

using namespace urban_nav_core::testing;

void run(benchmark::State& state, RenderedSequence sequence) {
  int i = 0;
  while (state.KeepRunning()) benchmark::DoNotOptimize(sequence.frame(i = (i + 37) % 480).left.pixels.data());
}

void room(benchmark::State& state) { run(state, RenderedSequence(texturedRoom(), namedMotion("loop", "room", 1), {})); }
void street(benchmark::State& state) {
  run(state, RenderedSequence(texturedStreet(), namedMotion("straight", "street", 1), {}));
}

}  // namespace

BENCHMARK(room)->Unit(benchmark::kMillisecond);
BENCHMARK(street)->Unit(benchmark::kMillisecond);
BENCHMARK_MAIN();
