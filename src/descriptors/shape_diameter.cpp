#include "src/descriptors/shape_diameter.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "src/base/index.hpp"
#include "src/descriptors/inside_rays.hpp"

namespace coseg {

namespace {

constexpr double half_angle = std::numbers::pi / 3.0;
constexpr int symmetry = 3;  // rays a ring, see face_frame
constexpr int smoothing_rounds = 3;
// Healthy shapes have up to a dozen, triangles over any vertices a quarter of their number.
constexpr double most_boxes_a_line = 128.0;

/// Axes u, v and the inward normal as columns. The edges as complex numbers in the plane sum to zero, so the
/// sum of their cubes is three times their product: the mean of their arguments is a direction modulo a third
/// of a turn that never vanishes and does not know which corner is the first.
Eigen::Matrix3d face_frame(const TriMesh& mesh, int face, const Eigen::Vector3d& normal) {
    std::array<Eigen::Vector3d, 3> edge;
    for (int k = 0; k < 3; ++k) {
        edge[at(k)] =
            mesh.vertices.col(mesh.faces((k + 1) % 3, face)) - mesh.vertices.col(mesh.faces(k, face));
    }
    const Eigen::Vector3d inward = -normal;
    const Eigen::Vector3d u = (edge[0] - edge[0].dot(normal) * normal).normalized();
    const Eigen::Vector3d v = inward.cross(u);
    double turn = 0.0;
    for (const Eigen::Vector3d& e : edge) turn += std::atan2(e.dot(v), e.dot(u)) / symmetry;
    Eigen::Matrix3d frame;
    frame << std::cos(turn) * u + std::sin(turn) * v, std::cos(turn) * v - std::sin(turn) * u, inward;
    return frame;
}

double median_of_sorted(std::span<const double> sorted) {
    const std::size_t n = sorted.size();
    return 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
}

double standard_deviation(std::span<const double> values) {
    const double n = static_cast<double>(values.size());
    double mean = 0.0;
    for (const double x : values) mean += x / n;
    double variance = 0.0;
    for (const double x : values) variance += (x - mean) * (x - mean) / n;
    return std::sqrt(variance);
}

double half_surface(const Eigen::Array3d& size) {
    return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
}

/// How many of the triangles' bounding boxes a line through the one of the mesh meets on average, and so
/// about how many triangles a ray has to be tested against. Source: for convex bodies it is the ratio of the
/// surfaces (Cauchy and Crofton).
double boxes_a_line(const TriMesh& mesh) {
    const Eigen::Array3d whole = mesh.vertices.rowwise().maxCoeff() - mesh.vertices.rowwise().minCoeff();
    double sum = 0.0;
    for (int f = 0; f < mesh.face_count(); ++f) {
        Eigen::Matrix3d corners;
        for (int k = 0; k < 3; ++k) corners.col(k) = mesh.vertices.col(mesh.faces(k, f));
        sum += half_surface(corners.rowwise().maxCoeff() - corners.rowwise().minCoeff());
    }
    const double surface = half_surface(whole);
    return surface > 0.0 ? sum / surface : 0.0;
}

/// lengths: per ray, 0 if it met nothing.
double robust_mean(const std::array<double, shape_diameter_rays>& lengths, const Eigen::VectorXd& angles) {
    std::array<double, shape_diameter_rays> sorted{};
    std::size_t count = 0;
    for (const double length : lengths) {
        if (length > 0.0) sorted[count++] = length;
    }
    if (count == 0) return 0.0;
    const std::span<double> met(sorted.data(), count);
    std::sort(met.begin(), met.end());
    const double median = median_of_sorted(met);
    // With two values the median is exactly one deviation from both; rounding must not drop them.
    const double reach = standard_deviation(met) + 1e-6 * median;
    double sum = 0.0;
    double weights = 0.0;
    for (std::size_t r = 0; r < lengths.size(); ++r) {
        if (!(lengths[r] > 0.0) || std::abs(lengths[r] - median) > reach) continue;
        const double weight = 1.0 / angles[static_cast<Eigen::Index>(r)];
        sum += weight * lengths[r];
        weights += weight;
    }
    return sum / weights;
}

/// Means over the neighbours that have a value, one ring further in each round.
void fill_from_neighbors(const DualGraph& graph, Eigen::VectorXd& thickness) {
    std::vector<int> missing;
    for (int f = 0; f < graph.face_count; ++f) {
        if (!(thickness[f] > 0.0)) missing.push_back(f);
    }
    while (!missing.empty()) {
        std::vector<std::pair<int, double>> filled;
        std::vector<int> still_missing;
        for (const int f : missing) {
            double sum = 0.0;
            int count = 0;
            for (int k = graph.offsets[at(f)]; k < graph.offsets[at(f) + 1]; ++k) {
                const double value = thickness[graph.other_face(graph.incident[at(k)], f)];
                if (!(value > 0.0)) continue;
                sum += value;
                ++count;
            }
            if (count > 0)
                filled.emplace_back(f, sum / count);
            else
                still_missing.push_back(f);
        }
        if (filled.empty()) return;
        for (const auto& [f, value] : filled) thickness[f] = value;
        missing = std::move(still_missing);
    }
}

Eigen::VectorXd smoothed(const DualGraph& graph, const Eigen::VectorXd& values) {
    Eigen::VectorXd sum = values;
    std::vector<int> count(at(graph.face_count), 1);
    for (const DualEdge& edge : graph.edges) {
        if (edge.is_virtual()) continue;
        sum[edge.face_a] += values[edge.face_b];
        sum[edge.face_b] += values[edge.face_a];
        ++count[at(edge.face_a)];
        ++count[at(edge.face_b)];
    }
    for (int f = 0; f < graph.face_count; ++f) sum[f] /= count[at(f)];
    return sum;
}

Eigen::VectorXd log_normalized(const Eigen::VectorXd& thickness) {
    const double low = thickness.minCoeff();
    const double high = thickness.maxCoeff();
    if (!(high - low > 1e-4 * high)) return Eigen::VectorXd::Zero(thickness.size());
    Eigen::VectorXd result(thickness.size());
    for (Eigen::Index f = 0; f < thickness.size(); ++f) {
        result[f] = std::log(4.0 * (thickness[f] - low) / (high - low) + 1.0) / std::log(5.0);
    }
    return result;
}

}  // namespace

RayCone shape_diameter_cone() {
    constexpr int rings = shape_diameter_rays / symmetry;
    constexpr double ring_turn = 2.0 * std::numbers::pi / symmetry * (std::numbers::phi - 1.0);
    RayCone cone{Eigen::Matrix3Xd(3, shape_diameter_rays), Eigen::VectorXd(shape_diameter_rays)};
    for (int r = 0; r < shape_diameter_rays; ++r) {
        const int ring = r / symmetry;
        const double angle = half_angle * std::sqrt((ring + 0.5) / rings);
        const double turn = ring * ring_turn + r % symmetry * 2.0 * std::numbers::pi / symmetry;
        cone.angles[r] = angle;
        cone.directions.col(r) << std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn),
            std::cos(angle);
    }
    return cone;
}

Eigen::VectorXd shape_diameter_raw(const TriMesh& mesh, const FaceGeometry& geometry) {
    Eigen::VectorXd thickness = Eigen::VectorXd::Zero(mesh.face_count());
    if (mesh.face_count() == 0) return thickness;
    const InsideRays rays(mesh);
    const Eigen::Matrix3Xd normals = face_normals(mesh);
    const RayCone cone = shape_diameter_cone();
    std::array<double, shape_diameter_rays> lengths{};
    const int step = std::max(1, static_cast<int>(std::ceil(boxes_a_line(mesh) / most_boxes_a_line)));
    for (int f = 0; f < mesh.face_count(); f += step) {
        if (!(geometry.area[f] > 0.0)) continue;
        const Eigen::Matrix3Xd directions = face_frame(mesh, f, normals.col(f)) * cone.directions;
        rays.cast(geometry.centroid.col(f), directions, lengths);
        thickness[f] = robust_mean(lengths, cone.angles);
    }
    return thickness;
}

Eigen::VectorXd shape_diameter(const TriMesh& mesh, const FaceGeometry& geometry, const DualGraph& graph) {
    Eigen::VectorXd thickness = shape_diameter_raw(mesh, geometry);
    if (thickness.size() == 0) return thickness;
    fill_from_neighbors(graph, thickness);
    for (int round = 0; round < smoothing_rounds; ++round) thickness = smoothed(graph, thickness);
    return log_normalized(thickness);
}

}  // namespace coseg
