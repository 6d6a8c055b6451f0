#include "src/mesh/moderate_scale.hpp"

#include <algorithm>
#include <cmath>

namespace coseg {

int extreme_exponent(const PolygonMesh& mesh) {
    constexpr double largest = 1e60;
    double reach = 0.0;
    for (const Eigen::Vector3d& p : mesh.vertices) reach = std::max(reach, p.lpNorm<Eigen::Infinity>());
    if (reach == 0.0 || (reach <= largest && reach >= 1.0 / largest)) return 0;
    return std::ilogb(reach);
}

PolygonMesh scaled_by_power(PolygonMesh mesh, int exponent) {
    for (Eigen::Vector3d& p : mesh.vertices)
        p = p.unaryExpr([&](double x) { return std::ldexp(x, exponent); });
    return mesh;
}

}  // namespace coseg
