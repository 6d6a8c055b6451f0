#include "solvers/subspace/coefficients.hpp"

#include <cmath>

#include "src/base/index.hpp"

namespace coseg {

std::vector<double> pair_norms(const SparseCoefficients& coefficients) {
    const auto features = at(coefficients.features);
    std::vector<double> norms(coefficients.rows.size());
    for (std::size_t k = 0; k < norms.size(); ++k) {
        double squares = 0.0;
        for (std::size_t h = 0; h < features; ++h) {
            const double w = coefficients.values[k * features + h];
            squares += w * w;
        }
        norms[k] = std::sqrt(squares);
    }
    return norms;
}

}  // namespace coseg
