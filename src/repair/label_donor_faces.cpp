#include "src/repair/label_donor_faces.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <nanoflann.hpp>
#include <tuple>

#include "src/base/index.hpp"

namespace coseg {

namespace {

using Eigen::Vector3d;

Vector3d corner_mean(const PolygonMesh& mesh, int face) {
    Vector3d sum = Vector3d::Zero();
    const int begin = mesh.offsets[at(face)];
    const int end = mesh.offsets[at(face) + 1];
    for (int k = begin; k < end; ++k) sum += mesh.vertices[at(mesh.corners[at(k)])];
    return end > begin ? Vector3d(sum / (end - begin)) : sum;
}

/// The working faces' centroids in the form nanoflann asks for.
struct CentroidCloud {
    std::vector<Vector3d> points;
    std::vector<int> faces;
    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
    [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return points[i][static_cast<Eigen::Index>(axis)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

class StandInFinder {
  public:
    StandInFinder(const PolygonMesh& mesh, const std::vector<int>& vertex_of,
                  const std::vector<char>& working)
        : mesh_(mesh), vertex_of_(vertex_of), working_(working) {
        offsets_.assign(mesh.vertices.size() + 1, 0);
        for_each_working_corner([&](int vertex, int) { ++offsets_[at(vertex) + 1]; });
        for (std::size_t v = 1; v < offsets_.size(); ++v) offsets_[v] += offsets_[v - 1];
        faces_.resize(at(offsets_.back()));
        std::vector<int> next(offsets_.begin(), offsets_.end() - 1);
        for_each_working_corner([&](int vertex, int face) { faces_[at(next[at(vertex)]++)] = face; });
    }

    int find(int face) {
        const int adjacent = best_adjacent(face);
        return adjacent >= 0 ? adjacent : nearest(face);
    }

  private:
    template <typename Visit>
    void for_each_working_corner(Visit visit) const {
        for (int f = 0; f < mesh_.face_count(); ++f) {
            if (working_[at(f)] == 0) continue;
            for (int k = mesh_.offsets[at(f)]; k < mesh_.offsets[at(f) + 1]; ++k) {
                visit(vertex_of_[at(mesh_.corners[at(k)])], f);
            }
        }
    }

    [[nodiscard]] int best_adjacent(int face) const {
        std::vector<int> own;
        for (int k = mesh_.offsets[at(face)]; k < mesh_.offsets[at(face) + 1]; ++k) {
            own.push_back(vertex_of_[at(mesh_.corners[at(k)])]);
        }
        std::sort(own.begin(), own.end());
        own.erase(std::unique(own.begin(), own.end()), own.end());
        std::vector<int> around;
        for (const int v : own)
            around.insert(around.end(), faces_.begin() + offsets_[at(v)],
                          faces_.begin() + offsets_[at(v) + 1]);
        std::sort(around.begin(), around.end());
        const Vector3d centre = corner_mean(mesh_, face);
        std::tuple<std::ptrdiff_t, double, int> best{0, 0.0, -1};
        for (auto run = around.begin(); run != around.end();) {
            const auto end = std::upper_bound(run, around.end(), *run);
            const std::tuple<std::ptrdiff_t, double, int> candidate{
                -(end - run), (corner_mean(mesh_, *run) - centre).squaredNorm(), *run};
            if (std::get<2>(best) < 0 || candidate < best) best = candidate;
            run = end;
        }
        return std::get<2>(best);
    }

    int nearest(int face) {
        if (!tree_) build_tree();
        const Vector3d centre = corner_mean(mesh_, face);
        std::size_t index = 0;
        double distance = 0.0;
        tree_->knnSearch(centre.data(), 1, &index, &distance);
        return cloud_.faces[index];
    }

    void build_tree() {
        for (int f = 0; f < mesh_.face_count(); ++f) {
            if (working_[at(f)] == 0) continue;
            cloud_.points.push_back(corner_mean(mesh_, f));
            cloud_.faces.push_back(f);
        }
        tree_ = std::make_unique<Tree>(3, cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(16));
        tree_->buildIndex();
    }

    using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, CentroidCloud>,
                                                     CentroidCloud, 3, std::size_t>;
    const PolygonMesh& mesh_;
    const std::vector<int>& vertex_of_;
    const std::vector<char>& working_;
    std::vector<int> offsets_;  ///< per welded vertex: the faces with a working face around it
    std::vector<int> faces_;
    CentroidCloud cloud_;
    std::unique_ptr<Tree> tree_;
};

}  // namespace

std::vector<int> label_donor_faces(const PolygonMesh& mesh, const std::vector<int>& vertex_of,
                                   const std::vector<char>& has_working_face) {
    std::vector<int> label_donor(has_working_face.size());
    std::unique_ptr<StandInFinder> finder;
    for (int f = 0; f < mesh.face_count(); ++f) {
        label_donor[at(f)] = f;
        if (has_working_face[at(f)] != 0) continue;
        if (!finder) finder = std::make_unique<StandInFinder>(mesh, vertex_of, has_working_face);
        label_donor[at(f)] = finder->find(f);
    }
    return label_donor;
}

}  // namespace coseg
