#include "solvers/subspace/dual_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solvers/row_scope/all_pairs_pass.hpp"
#include "solvers/row_scope/working_set_model.hpp"
#include "solvers/variants/subspace_solver.hpp"
#include "src/base/seeded_random.hpp"
#include "tests/support/subspace_problems.hpp"

namespace coseg {
namespace {

/// A random sparse W on the owned columns; the same on any number of ranks.
WorkingSet random_working_set(const Comm& comm, const FeatureStack& stack, double size, std::uint64_t seed) {
    WorkingSet working;
    working.columns = block_range(stack.size, comm.size(), comm.rank(), coefficient_tile);
    for (auto j = static_cast<int>(working.columns.begin); j < working.columns.end; ++j) {
        SeededStream random(hash_words({seed, static_cast<std::uint64_t>(j)}));
        RowScopeColumn fit;
        for (int i = 0; i < stack.size; ++i) {
            if (i == j || random.uniform() > 0.2) continue;
            fit.rows.push_back(i);
            for (int h = 0; h < stack.features; ++h)
                fit.weights.push_back(random.uniform() < 0.5 ? size * random.uniform() : 0.0);
        }
        prepare_row_scope_column(stack, j, fit);
        working.fits.push_back(fit);
    }
    return working;
}

TEST(DualBound, NeverExceedsTheOptimumFromAnyWeights) {
    const Comm world(MPI_COMM_WORLD);
    for (const double lambda : {0.0, 0.01, 1.0, 1000.0}) {
        SubspaceProblem problem = random_subspace_problem(2, 9, 45, 5, 61);
        problem.lambda = lambda;
        // By each rank alone: the truth takes many iterations, and waiting for a busy machine each time.
        const SolveResult best = solve_subspace(Comm(MPI_COMM_SELF), problem, {.gap = 1e-7});
        ASSERT_LE(best.relative_gap, 1e-7);
        const FeatureStack stack = stack_features(problem);
        AllPairsPass pass(world, problem, stack, processor_pair_scorer);
        for (const double size : {0.0, 1e-4, 0.01, 0.3}) {
            const WorkingSet working = random_working_set(world, stack, size, 62);
            std::vector<double> prices(working.fits.size() * 2, 0.0);
            const WorkingSetModel model(world, problem, stack, working, prices);
            const PassFindings found = pass.run(working, model.row_sums());
            EXPECT_LE(found.lower_bound, best.objective) << lambda << " " << size;
            EXPECT_GE(found.lower_bound, 0.0);
        }
    }
}

TEST(DualBound, TheFirstPassCertifiesThatNothingPays) {
    const Comm world(MPI_COMM_WORLD);
    SubspaceProblem problem = random_subspace_problem(2, 9, 45, 5, 63);
    problem.beta = 2.1;  // unit columns: 2 x_i.x_j <= 2
    const FeatureStack stack = stack_features(problem);
    const PassFindings found = AllPairsPass(world, problem, stack, processor_pair_scorer)
                                   .first(random_working_set(world, stack, 0.0, 64));
    EXPECT_EQ(found.entering_pairs, 0);
    EXPECT_NEAR(found.lower_bound, stack.squared_norm, 1e-12 * stack.squared_norm);
    EXPECT_LE(found.lower_bound, stack.squared_norm);
}

/// objective() against the definition, and the gradient behind propose() against differences of it: for a
/// small step t with no penalty the trial is W - t G.
TEST(WorkingSetModel, ObjectiveIsTheDefinitionAndTheGradientItsDerivative) {
    const Comm self(MPI_COMM_SELF);
    SubspaceProblem problem = random_subspace_problem(2, 9, 40, 5, 65);
    problem.lambda = 3.0;
    const FeatureStack stack = stack_features(problem);
    WorkingSet working = random_working_set(self, stack, 0.1, 66);
    std::vector<double> prices(static_cast<std::size_t>(problem.size()) * 2, 0.0);
    const auto definition = [&](const WorkingSet& at) {
        SparseCoefficients all{problem.size(), at.columns, 2, {0}, {}, {}};
        for (const RowScopeColumn& fit : at.fits) {
            all.rows.insert(all.rows.end(), fit.rows.begin(), fit.rows.end());
            all.values.insert(all.values.end(), fit.weights.begin(), fit.weights.end());
            all.offsets.push_back(static_cast<std::int64_t>(all.rows.size()));
        }
        return subspace_objective(problem, dense_weights(all));
    };
    const double objective = definition(working);
    EXPECT_NEAR(WorkingSetModel(self, problem, stack, working, prices).objective(), objective,
                1e-12 * objective);

    problem.alpha = problem.beta = problem.lambda = 0.0;
    for (RowScopeColumn& fit : working.fits) {
        for (double& weight : fit.weights) weight += 1.0;  // far from 0: nothing is clipped
    }
    WorkingSetModel model(self, problem, stack, working, prices);
    constexpr double step = 1e-3;
    model.propose(step);
    model.accept();
    WorkingSet moved = working;
    model.store(moved);
    for (std::size_t c = 0; c < working.fits.size(); c += 7) {
        for (std::size_t at = 0; at < working.fits[c].weights.size(); at += 3) {
            const double gradient = (working.fits[c].weights[at] - moved.fits[c].weights[at]) / step;
            WorkingSet up = working, down = working;
            up.fits[c].weights[at] += 1e-4;
            down.fits[c].weights[at] -= 1e-4;
            EXPECT_NEAR(gradient, (definition(up) - definition(down)) / 2e-4,
                        1e-5 * (1.0 + std::abs(gradient)));
        }
    }
}

}  // namespace
}  // namespace coseg
