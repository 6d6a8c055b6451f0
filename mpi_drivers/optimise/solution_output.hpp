#pragma once
// The functions that the commands that solve share: the certificate as JSON, the history, W as a file, and
// the refusals that follow a solve.

#include <optional>
#include <string>
#include <vector>

#include "solvers/variants/subspace_solver.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// Objective, bounds, gap, counts, reason and the problem's sizes and penalties: the text of a JSON object.
std::string certificate_json(const SubspaceProblem& problem, const SolveResult& result);

/// Gathers W on rank 0, which writes `path`. Does nothing if `path` is empty. Collective; throws
/// AgreedError(output).
void write_coefficients(const Comm& comm, const SolveResult& result, const std::string& path);

/// What refuse_unreached_gap says; nothing where the gap was reached.
std::optional<std::string> unreached_gap(const SolveResult& result, double gap, const std::string& subject);

/// Throws AgreedError(not_converged), naming `subject`, where a limit ended the solve before the gap.
void refuse_unreached_gap(const SolveResult& result, double gap, const std::string& subject);

/// Throws AgreedError(input) where W = 0, because there is then nothing to cut. The sentence says whether
/// W = 0 is certified.
void refuse_empty_solution(const SolveResult& result, const std::string& subject);

}  // namespace coseg
