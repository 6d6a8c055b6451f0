#pragma once
// Spectral projected gradient with a proximal map (prox) in place of the projection. It is written once for
// all ways to store W.
//
// Source: Birgin, Martinez, Raydan, "Nonmonotone spectral projected gradient methods on convex sets", SIAM
// J. Optim. 2000: Barzilai-Borwein step s.s / s.y, acceptance against the largest of the last 10 objectives,
// sufficient decrease 1e-4, step kept in [1e-30, 1e30].
// Deviates: the objective has a part that is not smooth, so that its prox replaces the projection, and the
// step itself is halved where a trial is refused. This is known as SpaRSA (Wright, Nowak, Figueiredo 2009).
// s.y needs no second gradient: the smooth part is quadratic, so that s.y is the curvature along s.

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <tuple>

#include "src/records/fields.hpp"

#include "src/base/index.hpp"

namespace coseg {

/// The objective of a trial point, and its position relative to the current point.
struct TrialPoint {
    double objective = 0.0;  ///< smooth part and penalties; infinite if the trial cannot be used
    double distance2 = 0.0;  ///< s.s, s = trial - current
    double curvature = 0.0;  ///< s.y, y the change of the smooth part's gradient along s; >= 0
};

/// propose(t) makes the trial prox(W - t G, t); accept() makes it the current point and computes its
/// gradient.
template <class T>
concept ProximalModel = requires(T model, const T& fixed, double step) {
    { fixed.objective() } -> std::convertible_to<double>;
    { model.propose(step) } -> std::same_as<TrialPoint>;
    model.accept();
};

/// All that the iteration knows beside its point. With both it continues to the last bit.
struct SpectralState {
    double step = 0.0;
    std::array<double, 10> recent{};  ///< objectives
    std::int64_t count = 0;           ///< of objectives so far
    int iterations = 0;               ///< accepted steps
    static constexpr auto fields() {
        return std::tuple(field("step", &SpectralState::step), field("recent", &SpectralState::recent),
                          field("count", &SpectralState::count),
                          field("iterations", &SpectralState::iterations));
    }
};

class SpectralStep {
  public:
    static constexpr double smallest = 1e-30;
    static constexpr double largest = 1e30;
    static constexpr double sufficient_decrease = 1e-4;

    explicit SpectralStep(double first_step, double objective)
        : step_(std::clamp(first_step, smallest, largest)) {
        remember(objective);
    }

    explicit SpectralStep(const SpectralState& state)
        : step_(state.step), recent_(state.recent), count_(at(state.count)) {}

    [[nodiscard]] SpectralState state(int iterations) const noexcept {
        return {step_, recent_, static_cast<std::int64_t>(count_), iterations};
    }

    [[nodiscard]] double step() const noexcept { return step_; }

    [[nodiscard]] bool accepts(const TrialPoint& trial) const noexcept {
        const double reference = *std::max_element(recent_.begin(), recent_.end());
        // Near the optimum a decrease is smaller than the rounding of the objective.
        const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * std::abs(reference);
        return trial.objective <= reference + rounding - 0.5 * sufficient_decrease * trial.distance2 / step_;
    }

    void shorten() noexcept { step_ = std::max(0.5 * step_, smallest); }

    void lengthen(const TrialPoint& trial) noexcept {
        remember(trial.objective);
        if (trial.distance2 <= 0.0) return;
        step_ = trial.curvature > trial.distance2 / largest
                    ? std::clamp(trial.distance2 / trial.curvature, smallest, largest)
                    : largest;
    }

  private:
    void remember(double objective) noexcept {
        recent_[count_ % recent_.size()] = objective;
        if (count_ == 0) recent_.fill(objective);
        ++count_;
    }

    double step_;
    std::array<double, 10> recent_{};
    std::size_t count_ = 0;
};

/// What the stopping test is given after each accepted step.
struct SpectralProgress {
    int iterations = 0;     ///< accepted steps
    double residual = 0.0;  ///< ||W - prox(W - t G)|| / t at the step just taken
    SpectralState state;    ///< to continue with spectral_projected_gradient(model, state, stop)
};

/// Continues an iteration; the model is at its point.
template <ProximalModel Model, class Stop>
SpectralProgress spectral_projected_gradient(Model& model, const SpectralState& state, Stop&& stop) {
    SpectralStep rule(state);
    SpectralProgress progress{.iterations = state.iterations, .residual = 0.0, .state = state};
    while (true) {
        TrialPoint trial = model.propose(rule.step());
        while (!rule.accepts(trial) && rule.step() > SpectralStep::smallest) {
            rule.shorten();
            trial = model.propose(rule.step());
        }
        progress.residual = std::sqrt(trial.distance2) / rule.step();
        model.accept();
        ++progress.iterations;
        rule.lengthen(trial);
        progress.state = rule.state(progress.iterations);
        if (stop(progress)) return progress;
    }
}

/// Iterates until `stop(progress)` is true.
/// Collective where the model is; `stop` must decide the same on all ranks.
template <ProximalModel Model, class Stop>
SpectralProgress spectral_projected_gradient(Model& model, double first_step, Stop&& stop) {
    return spectral_projected_gradient(model, SpectralStep(first_step, model.objective()).state(0), stop);
}

}  // namespace coseg
