#include "src/geodesics/geodesic.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <span>
#include <string>

#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"
#include "src/base/vector_clones.hpp"
#include "src/geodesics/shortest_paths.hpp"
#include "src/geodesics/surface_graph.hpp"

namespace coseg {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

std::vector<PathSource> sources_of_face(const TriMesh& mesh, const FaceGeometry& geometry, int face) {
    std::vector<PathSource> sources;
    for (int k = 0; k < 3; ++k) {
        const int v = mesh.faces(k, face);
        sources.push_back(
            {v, static_cast<float>((mesh.vertices.col(v) - geometry.centroid.col(face)).norm())});
    }
    return sources;
}

/// The face with the largest score; among equals the one with the smallest hash.
class FarthestFace {
  public:
    explicit FarthestFace(std::uint64_t seed) : seed_(seed) {}
    void offer(int face, double score) {
        if (face_ >= 0 && score < score_) return;
        const bool is_tie = face_ >= 0 && score == score_;
        if (is_tie && hash(face) > hash(face_)) return;
        face_ = face;
        score_ = score;
    }
    [[nodiscard]] int face() const { return face_; }
    [[nodiscard]] double score() const { return score_; }

  private:
    [[nodiscard]] std::uint64_t hash(int face) const {
        return hash_words({seed_, static_cast<std::uint64_t>(face)});
    }
    std::uint64_t seed_;
    int face_ = -1;
    double score_ = 0.0;
};

int most_remote_face(const FaceGeometry& geometry, std::uint64_t seed) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (Eigen::Index f = 0; f < geometry.area.size(); ++f)
        centre += geometry.area[f] * geometry.centroid.col(f);
    if (geometry.total_area > 0.0) centre /= geometry.total_area;
    FarthestFace farthest(seed);
    for (Eigen::Index f = 0; f < geometry.area.size(); ++f) {
        farthest.offer(static_cast<int>(f), (geometry.centroid.col(f) - centre).squaredNorm());
    }
    return farthest.face();
}

float corner_sum(const TriMesh& mesh, int face, const std::vector<float>& distance) {
    return distance[at(mesh.faces(0, face))] + distance[at(mesh.faces(1, face))] +
           distance[at(mesh.faces(2, face))];
}

void require_all_reached(const TriMesh& mesh, const std::vector<float>& distance) {
    for (int f = 0; f < mesh.face_count(); ++f) {
        if (corner_sum(mesh, f, distance) < infinity) continue;
        throw Error(ExitCode::internal,
                    "face " + std::to_string(f) +
                        " has no finite geodesic distance; the dual graph must be connected and "
                        "the coordinates finite");
    }
}

/// The face whose corners are farthest from all samples, again and again while these distances sink. Of a run
/// of faces the largest sum seen last is a bound: most runs need not be looked at.
class RemoteFaces {
  public:
    RemoteFaces(const TriMesh& mesh, std::uint64_t seed)
        : mesh_(mesh),
          seed_(seed),
          is_sample_(at(mesh.face_count()), 0),
          bound_(at((mesh.face_count() + run - 1) / run), infinity) {}
    void leave_out(int face) { is_sample_[at(face)] = 1; }
    [[nodiscard]] int farthest(const std::vector<float>& distance);

  private:
    static constexpr int run = 32;
    void offer_run(std::size_t number, const std::vector<float>& distance, FarthestFace& farthest);
    const TriMesh& mesh_;
    std::uint64_t seed_;
    std::vector<char> is_sample_;
    std::vector<float> bound_;  // per run
};

void RemoteFaces::offer_run(std::size_t number, const std::vector<float>& distance, FarthestFace& farthest) {
    const int begin = static_cast<int>(number) * run;
    float largest = -infinity;
    for (int f = begin; f < std::min(begin + run, mesh_.face_count()); ++f) {
        if (is_sample_[at(f)] != 0) continue;
        const float sum = corner_sum(mesh_, f, distance);
        largest = std::max(largest, sum);
        farthest.offer(f, sum);
    }
    bound_[number] = largest;
}

int RemoteFaces::farthest(const std::vector<float>& distance) {
    FarthestFace farthest(seed_);
    const auto likeliest = at(std::max_element(bound_.begin(), bound_.end()) - bound_.begin());
    offer_run(likeliest, distance, farthest);
    for (std::size_t r = 0; r < bound_.size(); ++r) {
        const bool may_hold_it = farthest.face() < 0 || static_cast<double>(bound_[r]) >= farthest.score();
        if (r != likeliest && may_hold_it) offer_run(r, distance, farthest);
    }
    return farthest.face();
}

std::vector<int> farthest_point_samples(const TriMesh& mesh, const FaceGeometry& geometry,
                                        const SurfaceGraph& graph, int samples, std::uint64_t seed) {
    std::vector<float> nearest(at(graph.node_count()), infinity);
    RemoteFaces faces(mesh, seed);
    std::vector<int> sample_face;
    int next = most_remote_face(geometry, seed);
    while (true) {
        sample_face.push_back(next);
        faces.leave_out(next);
        lower_distances(graph, sources_of_face(mesh, geometry, next), nearest);
        if (sample_face.size() == 1) require_all_reached(mesh, nearest);
        if (static_cast<int>(sample_face.size()) == std::min(samples, mesh.face_count())) return sample_face;
        next = faces.farthest(nearest);
    }
}

/// Up to path_lanes samples that lie close together, and all nodes by distance from the first of them.
struct Batch {
    std::vector<int> faces;
    std::vector<int> order;
    std::vector<float> distance;
};

/// Takes the sample `start` of `remaining` and those nearest to it.
Batch take_batch(const TriMesh& mesh, const FaceGeometry& geometry, const SurfaceGraph& graph, int start,
                 std::vector<int>& remaining) {
    Batch batch;
    batch.distance.assign(at(graph.node_count()), infinity);
    batch.order = lower_distances(graph, sources_of_face(mesh, geometry, start), batch.distance);
    std::stable_sort(remaining.begin(), remaining.end(), [&](int f, int g) {
        const auto key = [&](int face) {
            return face == start ? -1.0F : corner_sum(mesh, face, batch.distance);
        };
        return key(f) < key(g);
    });
    const auto count = std::min<std::size_t>(path_lanes, remaining.size());
    batch.faces.assign(remaining.begin(), remaining.begin() + static_cast<std::ptrdiff_t>(count));
    remaining.erase(remaining.begin(), remaining.begin() + static_cast<std::ptrdiff_t>(count));
    return batch;
}

/// Batches whose distances are written to the table together: a face's rows of one batch are one cache line,
/// and lines that lie far apart are slow to write one by one.
constexpr std::size_t batches_at_once = 4;

/// The distances of all vertices from one batch of samples.
struct BatchDistances {
    std::vector<int> faces;
    std::vector<PathLanes> of_vertex;
};

void fill_rows(const TriMesh& mesh, std::span<const BatchDistances> batches, GeodesicTable& table) {
    const auto first_row = static_cast<Eigen::Index>(table.sample_face.size());
    for (int f = 0; f < mesh.face_count(); ++f) {
        float* column = table.distance.data() + f * table.distance.rows() + first_row;
        for (const BatchDistances& batch : batches) {
            const PathLanes mean =
                (batch.of_vertex[at(mesh.faces(0, f))] + batch.of_vertex[at(mesh.faces(1, f))] +
                 batch.of_vertex[at(mesh.faces(2, f))]) *
                (1.0F / 3.0F);
            const std::size_t rows = batch.faces.size();
            if (rows == path_lanes)
                Eigen::Map<PathLanes>{column} = mean;
            else
                std::copy_n(mean.data(), rows, column);
            column += rows;
        }
    }
    for (const BatchDistances& batch : batches) {
        for (const int face : batch.faces) {
            table.distance(static_cast<Eigen::Index>(table.sample_face.size()), face) = 0.0F;
            table.sample_face.push_back(face);
        }
    }
}

/// Takes batches away from the far ends of the surface inwards, so that each stays compact.
void fill_table(const TriMesh& mesh, const FaceGeometry& geometry, const SurfaceGraph& graph,
                std::vector<int> remaining, GeodesicTable& table) {
    table.distance.resize(static_cast<Eigen::Index>(remaining.size()), mesh.face_count());
    std::array<BatchDistances, batches_at_once> found;
    int start = remaining.front();
    while (!remaining.empty()) {
        std::size_t count = 0;
        for (; count < found.size() && !remaining.empty(); ++count) {
            const Batch batch = take_batch(mesh, geometry, graph, start, remaining);
            std::array<std::vector<PathSource>, path_lanes> sources;
            for (std::size_t l = 0; l < batch.faces.size(); ++l)
                sources[l] = sources_of_face(mesh, geometry, batch.faces[l]);
            path_distances(graph, sources, batch.order, found[count].of_vertex);
            found[count].faces = batch.faces;
            if (!remaining.empty()) start = remaining.front();
        }
        fill_rows(mesh, std::span(found).first(count), table);
    }
}

/// The first of the smallest values. The bits of nonnegative floats are ordered as the floats are, and
/// compilers find the smallest of integers with vector instructions.
COSEG_VECTOR_CLONES Eigen::Index smallest_of(const float* distance, int count) {
    int least = std::numeric_limits<int>::max();
    for (int k = 0; k < count; ++k) least = std::min(least, std::bit_cast<int>(distance[k]));
    int first = count;
    for (int k = 0; k < count; ++k)
        first = std::min(first, std::bit_cast<int>(distance[k]) == least ? k : count);
    return first;
}

Eigen::VectorXd voronoi_weights(const GeodesicTable& table, const FaceGeometry& geometry) {
    const Eigen::Index samples = table.distance.rows();
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(samples);
    for (Eigen::Index f = 0; f < table.distance.cols(); ++f) {
        const float* distance = table.distance.data() + f * samples;
        weight[smallest_of(distance, static_cast<int>(samples))] += geometry.area[f];
    }
    double total = 0.0;
    for (Eigen::Index k = 0; k < samples; ++k) total += weight[k];
    if (!(total > 0.0)) return Eigen::VectorXd::Constant(samples, 1.0 / static_cast<double>(samples));
    return weight / total;
}

}  // namespace

GeodesicTable geodesic_table(const TriMesh& mesh, const FaceGeometry& geometry, const DualGraph& graph,
                             int samples, std::uint64_t seed) {
    if (samples < 1 || mesh.face_count() < 1) {
        throw Error(ExitCode::internal, "a geodesic table needs at least one sample and one face, not " +
                                            std::to_string(samples) + " and " +
                                            std::to_string(mesh.face_count()));
    }
    const SurfaceGraph surface = surface_graph(mesh, graph);
    GeodesicTable table;
    fill_table(mesh, geometry, surface, farthest_point_samples(mesh, geometry, surface, samples, seed),
               table);
    table.sample_weight = voronoi_weights(table, geometry);
    return table;
}

}  // namespace coseg
