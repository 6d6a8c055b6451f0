#include "solvers/row_scope/dense_solver.hpp"

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "solvers/numeric/blas.hpp"
#include "solvers/subspace/dual_bound.hpp"
#include "solvers/subspace/feature_stack.hpp"
#include "solvers/subspace/group_shrinkage.hpp"
#include "solvers/subspace/spectral_projected_gradient.hpp"
#include "solvers/subspace/stopping_rule.hpp"
#include "src/base/index.hpp"
#include "src/parallel/exact_sum.hpp"

namespace coseg {

namespace {

/// What is summed over all ranks.
struct DenseSums {
    enum : std::size_t { fit, norms, entries, distance2, fit_curvature, count };
};

/// A point of the iteration: the owned columns of W, their residuals X W - X and everybody's row sums.
struct DensePoint {
    std::vector<Eigen::MatrixXd> weights;  ///< H matrices N x owned
    Eigen::MatrixXd residual;              ///< D x owned
    std::vector<double> row_sums;          ///< of W_h, the H values of a row together
    double objective = 0.0;
};

class DenseModel {
  public:
    DenseModel(const Comm& comm, const SubspaceProblem& problem, const FeatureStack& stack,
               BlockRange columns);

    [[nodiscard]] double objective() const noexcept { return current_.objective; }
    TrialPoint propose(double step);
    void accept();

    [[nodiscard]] double lower_bound();
    [[nodiscard]] SparseCoefficients coefficients() const;
    [[nodiscard]] std::int64_t owned() const noexcept { return columns_.size(); }

  private:
    void shrink_tile(std::int64_t begin, std::int64_t end, double step);
    void measure_tile(std::int64_t begin, std::int64_t end);
    void compute_gradient();
    TrialPoint finish_trial();

    const Comm& comm_;
    const SubspaceProblem& problem_;
    const FeatureStack& stack_;
    BlockRange columns_;
    DensePoint current_;
    DensePoint trial_;
    std::vector<Eigen::MatrixXd> gradient_;
    ExactSum sums_;
    double tile_distance2_ = 0.0;
    double tile_norms_ = 0.0;
    double tile_entries_ = 0.0;
};

DensePoint zero_point(const FeatureStack& stack, BlockRange columns) {
    DensePoint point;
    point.weights.assign(at(stack.features), Eigen::MatrixXd::Zero(stack.size, columns.size()));
    point.residual = -stack.columns.middleCols(columns.begin, columns.size());
    point.row_sums.assign(at(stack.features) * at(stack.size), 0.0);
    point.objective = stack.squared_norm;
    return point;
}

DenseModel::DenseModel(const Comm& comm, const SubspaceProblem& problem, const FeatureStack& stack,
                       BlockRange columns)
    : comm_(comm),
      problem_(problem),
      stack_(stack),
      columns_(columns),
      current_(zero_point(stack, columns)),
      trial_(current_),
      gradient_(current_.weights),
      sums_(current_.row_sums.size(), row_sum_scale(stack, problem.lambda), DenseSums::count) {
    compute_gradient();
}

/// The prox of W - step G for the columns [begin, end) of the owned ones.
void DenseModel::shrink_tile(std::int64_t begin, std::int64_t end, double step) {
    const auto features = at(stack_.features);
    std::vector<double> pair(features);
    tile_distance2_ = tile_norms_ = tile_entries_ = 0.0;
    for (std::int64_t c = begin; c < end; ++c) {
        for (int i = 0; i < stack_.size; ++i) {
            for (std::size_t h = 0; h < features; ++h) {
                pair[h] = current_.weights[h](i, c) - step * gradient_[h](i, c);
            }
            if (i == columns_.begin + c) std::fill(pair.begin(), pair.end(), 0.0);
            tile_norms_ += shrink_group(pair, step, problem_.alpha, problem_.beta);
            for (std::size_t h = 0; h < features; ++h) {
                const double change = pair[h] - current_.weights[h](i, c);
                tile_distance2_ += change * change;
                tile_entries_ += pair[h];
                trial_.weights[h](i, c) = pair[h];
            }
        }
    }
}

/// Residuals, row sums and scalars of the trial's columns [begin, end) of the owned ones.
void DenseModel::measure_tile(std::int64_t begin, std::int64_t end) {
    const int width = static_cast<int>(end - begin);
    const int n = stack_.size;
    const int rows = stack_.dimension;
    trial_.residual.middleCols(begin, width) = -stack_.columns.middleCols(columns_.begin + begin, width);
    for (int h = 0; h < stack_.features; ++h) {
        const Eigen::MatrixXd& weights = trial_.weights[at(h)];
        const int height = stack_.rows_of(h);
        multiply({stack_.feature(h), height, n, rows}, {weights.data() + begin * n, n, width, n}, 1.0,
                 {trial_.residual.data() + begin * rows + stack_.offset[at(h)], height, width, rows});
        if (problem_.lambda == 0.0) continue;
        for (int i = 0; i < n; ++i) {
            double sum = 0.0;
            for (std::int64_t c = begin; c < end; ++c) sum += weights(i, c);
            sums_.add_field(at(i) * current_.weights.size() + at(h), sum);
        }
    }
    double tile_fit = 0.0;
    double tile_curvature = 0.0;
    for (std::int64_t entry = begin * rows; entry < end * rows; ++entry) {
        const double z = trial_.residual.data()[entry];
        const double change = z - current_.residual.data()[entry];
        tile_fit += z * z;
        tile_curvature += change * change;
    }
    sums_.add_scalar(DenseSums::fit, tile_fit);
    sums_.add_scalar(DenseSums::norms, tile_norms_);
    sums_.add_scalar(DenseSums::entries, tile_entries_);
    sums_.add_scalar(DenseSums::distance2, tile_distance2_);
    sums_.add_scalar(DenseSums::fit_curvature, tile_curvature);
}

TrialPoint DenseModel::finish_trial() {
    sums_.reduce(comm_);
    double row_squares = 0.0;
    double row_curvature = 0.0;
    if (problem_.lambda > 0.0) {
        trial_.row_sums = sums_.field();
        for (std::size_t entry = 0; entry < trial_.row_sums.size(); ++entry) {
            const double sum = trial_.row_sums[entry];
            const double change = sum - current_.row_sums[entry];
            row_squares += sum * sum;
            row_curvature += change * change;
        }
    }
    TrialPoint trial;
    trial.objective = sums_.overflowed() ? std::numeric_limits<double>::infinity()
                                         : sums_.scalar(DenseSums::fit) + problem_.lambda * row_squares +
                                               problem_.alpha * sums_.scalar(DenseSums::norms) +
                                               problem_.beta * sums_.scalar(DenseSums::entries);
    trial.distance2 = sums_.scalar(DenseSums::distance2);
    trial.curvature = 2.0 * (sums_.scalar(DenseSums::fit_curvature) + problem_.lambda * row_curvature);
    trial_.objective = trial.objective;
    return trial;
}

TrialPoint DenseModel::propose(double step) {
    sums_.clear();
    for (std::int64_t begin = 0; begin < owned(); begin += coefficient_tile) {
        const std::int64_t end = std::min(begin + coefficient_tile, owned());
        shrink_tile(begin, end, step);
        measure_tile(begin, end);
    }
    return finish_trial();
}

void DenseModel::accept() {
    std::swap(current_, trial_);
    compute_gradient();
}

/// G_h = 2 X_h^T (X_h W_h - X_h) + 2 lambda r_h 1^T.
void DenseModel::compute_gradient() {
    const int n = stack_.size;
    const int rows = stack_.dimension;
    for (int h = 0; h < stack_.features; ++h) {
        Eigen::MatrixXd& gradient = gradient_[at(h)];
        const Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<>> sums(
            current_.row_sums.data() + h, n, Eigen::InnerStride<>(stack_.features));
        for (std::int64_t begin = 0; begin < owned(); begin += coefficient_tile) {
            const int width = static_cast<int>(std::min(coefficient_tile, owned() - begin));
            const int height = stack_.rows_of(h);
            const double* residual = current_.residual.data() + begin * rows + stack_.offset[at(h)];
            multiply_transposed({stack_.feature(h), height, n, rows}, {residual, height, width, rows}, 0.0,
                                {gradient.data() + begin * n, n, width, n});
        }
        for (std::int64_t c = 0; c < owned(); ++c) {
            gradient.col(c) = 2.0 * gradient.col(c) + 2.0 * problem_.lambda * sums;
        }
    }
}

double DenseModel::lower_bound() {
    PaperDualBound bound(stack_, problem_.alpha, problem_.beta, problem_.lambda, current_.row_sums);
    const auto features = at(stack_.features);
    std::vector<double> scores(features);
    for (std::int64_t begin = 0; begin < owned(); begin += coefficient_tile) {
        const int width = static_cast<int>(std::min(coefficient_tile, owned() - begin));
        const auto first = static_cast<int>(columns_.begin + begin);
        const Eigen::MatrixXd reconstruction =
            current_.residual.middleCols(begin, width) + stack_.columns.middleCols(first, width);
        bound.begin_tile(first, width, reconstruction.data());
        for (int c = 0; c < width; ++c) {
            for (int i = 0; i < stack_.size; ++i) {
                if (i == first + c) continue;
                for (std::size_t h = 0; h < features; ++h) {
                    const double row_sum = current_.row_sums[at(i) * features + h];
                    scores[h] = 2.0 * problem_.lambda * row_sum - gradient_[h](i, begin + c);
                }
                bound.check_pair(c, i, scores.data(), 2.0 * stack_.inner_product_error());
            }
        }
        bound.end_tile();
    }
    return bound.finish(comm_);
}

SparseCoefficients DenseModel::coefficients() const {
    SparseCoefficients sparse{stack_.size, columns_, stack_.features, {0}, {}, {}};
    for (std::int64_t c = 0; c < owned(); ++c) {
        for (int i = 0; i < stack_.size; ++i) {
            const auto positive = [&](const Eigen::MatrixXd& weights) { return weights(i, c) > 0.0; };
            if (std::none_of(current_.weights.begin(), current_.weights.end(), positive)) continue;
            sparse.rows.push_back(i);
            for (const Eigen::MatrixXd& weights : current_.weights) sparse.values.push_back(weights(i, c));
        }
        sparse.offsets.push_back(static_cast<std::int64_t>(sparse.rows.size()));
    }
    return sparse;
}

}  // namespace

SolveResult solve_dense(const Comm& comm, const SubspaceProblem& problem, const SolveOptions& options) {
    const FeatureStack stack = stack_features(problem);
    const BlockRange columns = block_range(stack.size, comm.size(), comm.rank(), coefficient_tile);
    DenseModel model(comm, problem, stack, columns);
    StoppingRule rule(comm, options, stack.squared_norm);
    SolveResult result;
    constexpr int certificate_interval = 10;
    const std::int64_t all_pairs = static_cast<std::int64_t>(stack.size) * (stack.size - 1);
    const auto certify = [&] {
        const bool reached = rule.certify(model.objective(), model.lower_bound());
        ++result.passes;
        append_row(result.history, {result.passes, result.iterations, model.objective(), rule.lower_bound(),
                                    rule.relative_gap(), all_pairs});
        return reached;
    };
    const bool stopped = certify();
    const auto stop = [&](const SpectralProgress& progress) {
        result.iterations = progress.iterations;
        result.kkt_residual = progress.residual / gradient_scale(stack);
        const bool due = progress.iterations % certificate_interval == 0 ||
                         progress.iterations >= options.max_iterations ||
                         result.kkt_residual <= smallest_residual;
        if (!due) return false;
        const bool limit = rule.limit_reached(progress.iterations, result.kkt_residual);
        return certify() || limit;
    };
    if (!stopped) {
        const double first_step = 1.0 / (2.0 * (stack.largest_inner + problem.lambda));
        spectral_projected_gradient(model, first_step, stop);
    }
    result.coefficients = model.coefficients();
    result.working_pairs = all_pairs;
    result.nonzero_groups = all_sum(comm, static_cast<std::int64_t>(result.coefficients.rows.size()));
    rule.report(result);
    return result;
}

}  // namespace coseg
