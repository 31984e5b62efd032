#include "optimize/algebra/sqp.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <nlopt.h>

namespace glissade::optimizer {
namespace {

struct OptimizerDeleter {
  void operator()(nlopt_opt opt) const { nlopt_destroy(opt); }
};
using Optimizer = std::unique_ptr<std::remove_pointer_t<nlopt_opt>, OptimizerDeleter>;

/// What NLopt's three callbacks share: the last sample, in scaled variables.
struct Context {
  const SampleFunction* function = nullptr;
  const ShiftedCholesky* metric = nullptr;
  const std::function<bool()>* stop = nullptr;
  nlopt_opt optimizer = nullptr;
  Vector origin;
  Vector at;
  Sample sample;
  int evaluations = 0;
  bool stopped = false;

  [[nodiscard]] Vector original(const double* y) const {
    Vector z(y, y + origin.size());
    metric->backward(z.data());
    for (std::size_t i = 0; i < z.size(); ++i) z[i] += origin[i];
    return z;
  }

  void update(const double* y) {
    if (!at.empty() && std::equal(at.begin(), at.end(), y)) return;
    at.assign(y, y + origin.size());
    if ((*stop)()) {
      stopped = true;
      nlopt_force_stop(optimizer);
    }
    (*function)(original(y), sample);
    ++evaluations;
    metric->forward(sample.gradient.data());
    for (std::size_t i = 0; i < sample.equality.size(); ++i) metric->forward(sample.equality_jacobian.row(i));
    for (std::size_t i = 0; i < sample.inequality.size(); ++i) {
      metric->forward(sample.inequality_jacobian.row(i));
    }
  }
};

double objective(unsigned n, const double* y, double* gradient, void* data) {
  auto& context = *static_cast<Context*>(data);
  context.update(y);
  if (gradient != nullptr) std::copy_n(context.sample.gradient.begin(), n, gradient);
  return context.sample.objective;
}

void equalities(unsigned m, double* value, unsigned n, const double* y, double* gradient, void* data) {
  auto& context = *static_cast<Context*>(data);
  context.update(y);
  std::copy_n(context.sample.equality.begin(), m, value);
  if (gradient != nullptr) std::copy_n(context.sample.equality_jacobian.row(0), m * n, gradient);
}

void inequalities(unsigned m, double* value, unsigned n, const double* y, double* gradient, void* data) {
  auto& context = *static_cast<Context*>(data);
  context.update(y);
  std::copy_n(context.sample.inequality.begin(), m, value);
  if (gradient != nullptr) std::copy_n(context.sample.inequality_jacobian.row(0), m * n, gradient);
}

}  // namespace

Descent descend(const SampleFunction& function, const Vector& z, std::size_t equality_count,
                std::size_t inequality_count, const ShiftedCholesky& metric, const DescentOptions& options,
                const std::function<bool()>& stop) {
  const auto n = static_cast<unsigned>(z.size());
  const Optimizer optimizer(nlopt_create(NLOPT_LD_SLSQP, n));
  Context context;
  context.function = &function;
  context.metric = &metric;
  context.stop = &stop;
  context.optimizer = optimizer.get();
  context.origin = z;
  nlopt_set_min_objective(optimizer.get(), objective, &context);
  const Vector equality_tolerance(equality_count, 1e-12);
  const Vector inequality_tolerance(inequality_count, 1e-10);
  if (equality_count > 0) {
    nlopt_add_equality_mconstraint(optimizer.get(), static_cast<unsigned>(equality_count), equalities,
                                   &context, equality_tolerance.data());
  }
  if (inequality_count > 0) {
    nlopt_add_inequality_mconstraint(optimizer.get(), static_cast<unsigned>(inequality_count), inequalities,
                                     &context, inequality_tolerance.data());
  }
  nlopt_set_maxeval(optimizer.get(), options.most_evaluations);
  nlopt_set_xtol_abs1(optimizer.get(), options.step_tolerance);
  Vector y(z.size(), 0.0);
  double value = 0.0;
  // Every way to end, rounding included, leaves the best point in y; whether it will do is judged by its
  // residuals, not by the return code.
  (void)nlopt_optimize(optimizer.get(), y.data(), &value);
  Descent result;
  result.z = context.original(y.data());
  result.evaluations = context.evaluations;
  result.stopped = context.stopped;
  return result;
}

}  // namespace glissade::optimizer
