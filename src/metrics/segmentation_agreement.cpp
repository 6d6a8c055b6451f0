#include "src/metrics/segmentation_agreement.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/geodesics/shortest_paths.hpp"
#include "src/geodesics/surface_graph.hpp"
#include "src/metrics/rand_index.hpp"

namespace coseg {

namespace {

/// Areas of the segments of both, and of what they share.
struct Overlaps {
    std::map<int, double> reference;
    std::map<int, double> answer;
    std::map<std::pair<int, int>, double> shared;  // (reference, answer)
};

Overlaps overlaps_of(const Eigen::VectorXd& area, const std::vector<int>& reference,
                     const std::vector<int>& answer) {
    Overlaps overlaps;
    for (std::size_t f = 0; f < reference.size(); ++f) {
        const double a = area[static_cast<Eigen::Index>(f)];
        overlaps.reference[reference[f]] += a;
        overlaps.answer[answer[f]] += a;
        overlaps.shared[{reference[f], answer[f]}] += a;
    }
    return overlaps;
}

/// Area of the segments of one side outside the segment of the other side that shares most with each.
double unmatched_area(const std::map<int, double>& segments,
                      const std::map<std::pair<int, int>, double>& shared, bool segment_is_first) {
    std::map<int, double> most;
    for (const auto& [pair, area] : shared) {
        double& best = most[segment_is_first ? pair.first : pair.second];
        best = std::max(best, area);
    }
    double unmatched = 0.0;
    for (const auto& [segment, area] : segments) unmatched += area - most[segment];
    return unmatched;
}

void set_consistency(SegmentationAgreement& agreement, const Overlaps& overlaps, double total) {
    double towards_answer = 0.0;
    double towards_reference = 0.0;
    double local = 0.0;
    for (const auto& [pair, area] : overlaps.shared) {
        const double of_reference = 1.0 - area / overlaps.reference.at(pair.first);
        const double of_answer = 1.0 - area / overlaps.answer.at(pair.second);
        towards_answer += area * of_reference;
        towards_reference += area * of_answer;
        local += area * std::min(of_reference, of_answer);
    }
    agreement.global_consistency_error = std::min(towards_answer, towards_reference) / total;
    agreement.local_consistency_error = local / total;
}

std::vector<DualEdge> boundary_edges(const DualGraph& graph, const std::vector<int>& label) {
    std::vector<DualEdge> edges;
    for (const DualEdge& e : graph.edges) {
        if (e.is_virtual()) continue;
        if (label[at(e.face_a)] != label[at(e.face_b)]) edges.push_back(e);
    }
    return edges;
}

/// Mean over the edges `from`, by length, of the distance to the nearest vertex of the edges `to`.
double mean_distance(const SurfaceGraph& surface, const std::vector<DualEdge>& from,
                     const std::vector<DualEdge>& to) {
    std::vector<PathSource> sources;
    for (const DualEdge& e : to) sources.insert(sources.end(), {{e.vertex_a, 0.0F}, {e.vertex_b, 0.0F}});
    std::vector<float> distance(at(surface.node_count()), std::numeric_limits<float>::infinity());
    lower_distances(surface, sources, distance);
    double sum = 0.0;
    double length = 0.0;
    for (const DualEdge& e : from) {
        const double a = distance[at(e.vertex_a)];
        const double b = distance[at(e.vertex_b)];
        sum += e.length * 0.5 * (a + b);
        length += e.length;
    }
    return length > 0.0 ? sum / length : 0.0;
}

double mean_radius(const FaceGeometry& geometry) {
    const Eigen::Vector3d centre = surface_centroid(geometry);
    return (geometry.centroid.colwise() - centre).colwise().norm().dot(geometry.area) / geometry.total_area;
}

std::optional<double> cut_discrepancy(const TriMesh& mesh, const FaceGeometry& geometry,
                                      const DualGraph& graph, const std::vector<int>& reference,
                                      const std::vector<int>& answer) {
    const std::vector<DualEdge> of_reference = boundary_edges(graph, reference);
    const std::vector<DualEdge> of_answer = boundary_edges(graph, answer);
    if (of_reference.empty() && of_answer.empty()) return 0.0;
    if (of_reference.empty() || of_answer.empty()) return std::nullopt;
    const SurfaceGraph surface = surface_graph(mesh, graph);
    return (mean_distance(surface, of_reference, of_answer) +
            mean_distance(surface, of_answer, of_reference)) /
           mean_radius(geometry);
}

}  // namespace

SegmentationAgreement segmentation_agreement(const TriMesh& mesh, const FaceGeometry& geometry,
                                             const DualGraph& graph, const std::vector<int>& reference,
                                             const std::vector<int>& answer) {
    const auto faces = at(mesh.face_count());
    if (reference.size() != faces || answer.size() != faces)
        throw Error(ExitCode::internal,
                    "a segmentation to compare has not one number for each face of the mesh");
    const Overlaps overlaps = overlaps_of(geometry.area, reference, answer);
    const double total = geometry.total_area;
    SegmentationAgreement agreement;
    // The Rand index leaves negative truth out; here every number is a segment.
    std::vector<int> numbered(reference);
    for (int& segment : numbered) {
        segment =
            static_cast<int>(std::distance(overlaps.reference.begin(), overlaps.reference.find(segment)));
    }
    agreement.rand_index_error = 1.0 - rand_index(numbered, answer);
    agreement.missing_rate = unmatched_area(overlaps.reference, overlaps.shared, true) / total;
    agreement.false_alarm_rate = unmatched_area(overlaps.answer, overlaps.shared, false) / total;
    agreement.hamming_distance = 0.5 * (agreement.missing_rate + agreement.false_alarm_rate);
    set_consistency(agreement, overlaps, total);
    agreement.cut_discrepancy = cut_discrepancy(mesh, geometry, graph, reference, answer);
    return agreement;
}

}  // namespace coseg
