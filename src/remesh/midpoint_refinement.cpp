#include "src/remesh/midpoint_refinement.hpp"

#include <algorithm>
#include <cstddef>
#include <queue>
#include <tuple>
#include <vector>

#include "src/base/index.hpp"
#include "src/mesh/edge_groups.hpp"

namespace coseg {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

/// Half-edge h = 3 f + k runs from corner k to corner k + 1 of face f; twin_[h] is the other side, -1 at a
/// boundary.
class EdgeSplitter {
  public:
    explicit EdgeSplitter(const TriMesh& mesh) {
        for (int v = 0; v < mesh.vertex_count(); ++v) vertices_.emplace_back(mesh.vertices.col(v));
        for (int f = 0; f < mesh.face_count(); ++f) faces_.emplace_back(mesh.faces.col(f));
        find_twins();
        for (int h = 0; h < 3 * face_count(); ++h) offer(h);
    }

    [[nodiscard]] int face_count() const { return static_cast<int>(faces_.size()); }

    /// False if the longest edge has no middle between its ends in double precision.
    bool split_longest(std::vector<int>& input_face) {
        const int h = take_longest();
        const int other = twin_[at(h)];
        const int middle = static_cast<int>(vertices_.size());
        const Vector3d& a = vertices_[at(start(h))];
        const Vector3d& b = vertices_[at(start(next(h)))];
        const Vector3d between = 0.5 * (a + b);
        if (between == a || between == b) return false;
        vertices_.push_back(between);
        const int far_half = split_face(h, middle, input_face);
        if (other < 0) {
            twin_[at(h)] = twin_[at(far_half)] = -1;
        } else {
            const int other_far_half = split_face(other, middle, input_face);
            make_twins(h, other_far_half);
            make_twins(other, far_half);
        }
        offer_face(h / 3);
        offer_face(far_half / 3);
        if (other >= 0) {
            offer_face(other / 3);
            offer_face(twin_[at(h)] / 3);
        }
        return true;
    }

    void write_to(TriMesh& mesh) const {
        mesh.vertices.resize(3, static_cast<Eigen::Index>(vertices_.size()));
        for (std::size_t v = 0; v < vertices_.size(); ++v)
            mesh.vertices.col(static_cast<Eigen::Index>(v)) = vertices_[v];
        mesh.faces.resize(3, static_cast<Eigen::Index>(faces_.size()));
        for (std::size_t f = 0; f < faces_.size(); ++f)
            mesh.faces.col(static_cast<Eigen::Index>(f)) = faces_[f];
    }

  private:
    /// Longest first; among equals the lower pair of vertices, then the lower half-edge.
    // (squared length, -lower vertex, -higher vertex, -half-edge).
    using Entry = std::tuple<double, int, int, int>;

    [[nodiscard]] static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
    [[nodiscard]] int start(int h) const { return faces_[at(h / 3)][h % 3]; }

    [[nodiscard]] Entry entry_of(int h) const {
        const int a = start(h);
        const int b = start(next(h));
        return {(vertices_[at(a)] - vertices_[at(b)]).squaredNorm(), -std::min(a, b), -std::max(a, b), -h};
    }

    void find_twins() {
        twin_.assign(3 * faces_.size(), -1);
        std::vector<int> from;
        std::vector<int> to;
        for (int h = 0; h < 3 * face_count(); ++h) {
            from.push_back(start(h));
            to.push_back(start(next(h)));
        }
        const EdgeGroups groups = group_edges(from, to, static_cast<int>(vertices_.size()));
        for (int g = 0; g < groups.count(); ++g) {
            const int begin = groups.offsets[at(g)];
            if (groups.offsets[at(g) + 1] - begin == 2)
                make_twins(groups.half_edges[at(begin)], groups.half_edges[at(begin + 1)]);
        }
    }

    void make_twins(int a, int b) {
        twin_[at(a)] = b;
        twin_[at(b)] = a;
    }

    void offer(int h) {
        if (twin_[at(h)] < 0 || start(h) < start(next(h))) queue_.push(entry_of(h));
    }

    void offer_face(int f) {
        for (int k = 0; k < 3; ++k) {
            const int h = 3 * f + k;
            queue_.push(entry_of(twin_[at(h)] >= 0 && start(h) > start(next(h)) ? twin_[at(h)] : h));
        }
    }

    /// Entries of edges that were split since, or whose half-edge moved, no longer match and are passed over.
    int take_longest() {
        while (true) {
            const Entry entry = queue_.top();
            queue_.pop();
            const int h = -std::get<3>(entry);
            if (entry_of(h) == entry) return h;
        }
    }

    /// Face (a, b, c) with h = a -> b becomes (a, middle, c); a new face (middle, b, c) takes the rest. h
    /// stays the half-edge a -> middle; returns the new face's middle -> b.
    int split_face(int h, int middle, std::vector<int>& input_face) {
        const int f = h / 3;
        const int k = h % 3;
        const Vector3i old = faces_[at(f)];
        const int b = old[(k + 1) % 3];
        const int c = old[(k + 2) % 3];
        faces_[at(f)][(k + 1) % 3] = middle;
        const int fresh = 3 * face_count();
        faces_.emplace_back(middle, b, c);
        input_face.push_back(input_face[at(f)]);
        const int inner = next(h);  // was b -> c, now middle -> c
        const int outside = twin_[at(inner)];
        twin_.resize(3 * faces_.size(), -1);
        if (outside >= 0) make_twins(fresh + 1, outside);
        make_twins(fresh + 2, inner);
        return fresh;
    }

    std::vector<Vector3d> vertices_;
    std::vector<Vector3i> faces_;
    std::vector<int> twin_;
    std::priority_queue<Entry> queue_;
};

}  // namespace

void refine_to_face_count(TriMesh& mesh, FaceMap& map, int minimum_faces) {
    if (mesh.face_count() == 0 || mesh.face_count() >= minimum_faces) return;
    EdgeSplitter splitter(mesh);
    while (splitter.face_count() < minimum_faces) {
        if (!splitter.split_longest(map.input_face)) break;
    }
    splitter.write_to(mesh);
}

}  // namespace coseg
