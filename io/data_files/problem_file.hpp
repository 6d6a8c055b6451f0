#pragma once
// Problems as text: the features and penalties of one multi-feature subspace problem.
//
//   line 1      H d N
//   line 2      lambda alpha beta
//   line 3      an upper and a lower bound of the optimum, if known (carried along, not used)
//   line 4 ...  X_1 as d lines of N numbers, then X_2, ...

#include <Eigen/Core>
#include <string>
#include <vector>

namespace coseg {

struct ProblemFile {
    std::vector<Eigen::MatrixXd> features;  ///< H matrices d x N
    double lambda = 0.0;
    double alpha = 0.0;
    double beta = 0.0;
    double known_upper = 0.0;  ///< line 3
    double known_lower = 0.0;
};

/// Reads a problem. Serial. Throws Error(input), naming file and line, where the file cannot be opened, ends
/// early, goes on too long, or holds something other than finite numbers. No memory is allocated that the
/// file could not fill.
ProblemFile read_problem_file(const std::string& path);

}  // namespace coseg
