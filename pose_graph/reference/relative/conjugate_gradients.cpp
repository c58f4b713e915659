// SPDX-License-Identifier: BSD-3-Clause
#include "conjugate_gradients.hpp"

namespace pose_graph {

template <int D>
PcgResult<D> conjugateGradients(const LinearSystem<D>& system, const Preconditioner<D>& preconditioner, double damping,
                                double tolerance, int max_iterations) {
  PcgResult<D> result;
  result.step = Increments<D>::Zero(kTangentSize<D>, system.links());
  Increments<D> residual = system.b(), z, product, scratch;
  preconditioner.apply(residual, z, scratch);
  Increments<D> direction = z;
  double rz = residual.cwiseProduct(z).sum();
  const double goal = tolerance * tolerance * rz;
  while (rz > goal && result.iterations < max_iterations) {
    system.apply(damping, direction, product, scratch);
    const double curvature = direction.cwiseProduct(product).sum();
    if (!(curvature > 0.0)) break;  // round-off: the residual is only noise
    const double length = rz / curvature;
    result.step += length * direction;
    residual -= length * product;
    preconditioner.apply(residual, z, scratch);
    const double next = residual.cwiseProduct(z).sum();
    ++result.iterations;
    direction = z + (next / rz) * direction;
    rz = next;
  }
  system.apply(0.0, result.step, product, scratch);
  result.promise = (system.b() - 0.5 * product).cwiseProduct(result.step).sum();
  return result;
}

template PcgResult<2> conjugateGradients(const LinearSystem<2>&, const Preconditioner<2>&, double, double, int);
template PcgResult<3> conjugateGradients(const LinearSystem<3>&, const Preconditioner<3>&, double, double, int);

}  // namespace pose_graph
