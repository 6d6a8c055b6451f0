#include "io/mesh_files/lost_digits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "src/base/index.hpp"

namespace coseg {

namespace {

double largest_coordinate_of(const PolygonMesh& mesh) {
    double largest = 0.0;
    for (const Eigen::Vector3d& p : mesh.vertices) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    return largest;
}

/// Of the edges that have a length; 0 if there are none.
double average_edge(const PolygonMesh& mesh) {
    double sum = 0.0;
    std::int64_t count = 0;
    for (int f = 0; f < mesh.face_count(); ++f) {
        const int begin = mesh.offsets[at(f)];
        const int end = mesh.offsets[at(f) + 1];
        for (int k = begin; k < end; ++k) {
            const int next = k + 1 < end ? k + 1 : begin;
            const Eigen::Vector3d edge =
                mesh.vertices[at(mesh.corners[at(k)])] - mesh.vertices[at(mesh.corners[at(next)])];
            // The square of an edge below 1e-162 is 0; the scaled norm takes several times as long.
            const double plain = edge.norm();
            const double length = plain > 0.0 ? plain : edge.stableNorm();
            if (!(length > 0.0)) continue;
            sum += length;
            ++count;
        }
    }
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

}  // namespace

std::optional<std::string> lost_digits(const PolygonMesh& mesh) {
    constexpr double most_steps = 0.01;
    const double largest = largest_coordinate_of(mesh);
    const auto single = static_cast<float>(largest);
    const double step = std::nextafter(single, std::numeric_limits<float>::infinity()) - single;
    const double edge = average_edge(mesh);
    if (!(edge > 0.0) || step <= most_steps * edge) return std::nullopt;
    const bool is_tiny = largest < static_cast<double>(std::numeric_limits<float>::min());
    char text[320];
    std::snprintf(text, sizeof text,
                  "coordinates up to %.6g in single precision have steps of %.2g, but the average edge is "
                  "%.2g long: digits are lost; export the mesh %s, or in a format of text with all digits",
                  largest, step, edge, is_tiny ? "larger" : "near the origin");
    return text;
}

}  // namespace coseg
