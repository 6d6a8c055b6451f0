#include "src/mesh/closest_point.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/mesh/face_geometry.hpp"

namespace coseg {

namespace {

using Eigen::Vector3d;

constexpr int leaf_faces = 4;

Vector3d closest_on_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
    const Vector3d edge = b - a;
    const double length2 = edge.squaredNorm();
    const double t = length2 > 0.0 ? std::clamp((p - a).dot(edge) / length2, 0.0, 1.0) : 0.0;
    return a + t * edge;
}

Vector3d closest_on_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const Vector3d n = (b - a).cross(c - a);
    const double n2 = n.squaredNorm();
    if (n2 > 0.0) {
        const bool over = n.dot((b - a).cross(p - a)) >= 0.0 && n.dot((c - b).cross(p - b)) >= 0.0 &&
                          n.dot((a - c).cross(p - c)) >= 0.0;
        if (over) return p - n * (n.dot(p - a) / n2);
    }
    Vector3d best = closest_on_segment(p, a, b);
    for (const Vector3d& q : {closest_on_segment(p, b, c), closest_on_segment(p, c, a)}) {
        if ((q - p).squaredNorm() < (best - p).squaredNorm()) best = q;
    }
    return best;
}

double squared_distance_to_box(const Vector3d& p, const Vector3d& low, const Vector3d& high) {
    return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
}

}  // namespace

ClosestPointTree::ClosestPointTree(const TriMesh& mesh) : mesh_(mesh) {
    if (mesh.face_count() == 0) throw Error(ExitCode::input, "a mesh without faces has no nearest point");
    normals_ = face_normals(mesh);
    centroids_ = face_geometry(mesh).centroid;
    order_.resize(at(mesh.face_count()));
    std::iota(order_.begin(), order_.end(), 0);
    nodes_.reserve(order_.size());
    nodes_.emplace_back();
    build(0, 0, mesh.face_count());
}

void ClosestPointTree::build(int node, int begin, int end) {
    Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
    Vector3d high = -low;
    Vector3d centre_low = low, centre_high = high;
    for (int i = begin; i < end; ++i) {
        const int f = order_[i];
        for (int c = 0; c < 3; ++c) {
            low = low.cwiseMin(mesh_.vertices.col(mesh_.faces(c, f)));
            high = high.cwiseMax(mesh_.vertices.col(mesh_.faces(c, f)));
        }
        centre_low = centre_low.cwiseMin(centroids_.col(f));
        centre_high = centre_high.cwiseMax(centroids_.col(f));
    }
    if (end - begin <= leaf_faces) {
        nodes_[node] = {low, high, begin, end - begin};
        return;
    }
    int axis = 0;
    (centre_high - centre_low).maxCoeff(&axis);
    const int middle = begin + (end - begin) / 2;
    std::nth_element(
        order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int a, int b) {
            return std::make_pair(centroids_(axis, a), a) < std::make_pair(centroids_(axis, b), b);
        });
    const int left = static_cast<int>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node] = {low, high, left, 0};
    build(left, begin, middle);
    build(left + 1, middle, end);
}

ClosestPoint ClosestPointTree::search(const Vector3d& point, const Vector3d* normal) const {
    ClosestPoint best;
    double best2 = std::numeric_limits<double>::infinity();
    std::vector<std::pair<double, int>> open{{0.0, 0}};
    while (!open.empty()) {
        const auto [bound, index] = open.back();
        open.pop_back();
        if (bound > best2) continue;
        const Node& node = nodes_[index];
        if (node.count == 0) {
            const Node& left = nodes_[node.first];
            const Node& right = nodes_[node.first + 1];
            std::pair<double, int> near{squared_distance_to_box(point, left.low, left.high), node.first};
            std::pair<double, int> far{squared_distance_to_box(point, right.low, right.high), node.first + 1};
            if (far < near) std::swap(near, far);
            open.insert(open.end(), {far, near});
        }
        for (int i = node.first; i < node.first + node.count; ++i) {
            const int f = order_[i];
            if (normal != nullptr && normals_.col(f).dot(*normal) <= 0.0) continue;
            const Vector3d q = closest_on_triangle(point, mesh_.vertices.col(mesh_.faces(0, f)),
                                                   mesh_.vertices.col(mesh_.faces(1, f)),
                                                   mesh_.vertices.col(mesh_.faces(2, f)));
            const double d2 = (q - point).squaredNorm();
            if (d2 > best2 || (d2 == best2 && f > best.face)) continue;
            best2 = d2;
            best.point = q;
            best.face = f;
        }
    }
    best.distance = std::sqrt(best2);
    return best;
}

ClosestPoint ClosestPointTree::nearest(const Vector3d& point) const { return search(point, nullptr); }

ClosestPoint ClosestPointTree::nearest(const Vector3d& point, const Vector3d& normal) const {
    const ClosestPoint facing = search(point, &normal);
    return facing.face >= 0 ? facing : nearest(point);
}

std::vector<int> nearest_faces(const TriMesh& of, const TriMesh& on) {
    const ClosestPointTree tree(on);
    const Eigen::Matrix3Xd centroids = face_geometry(of).centroid;
    const Eigen::Matrix3Xd normals = face_normals(of);
    std::vector<int> faces(at(of.face_count()));
    for (int f = 0; f < of.face_count(); ++f) {
        faces[f] = tree.nearest(centroids.col(f), normals.col(f)).face;
    }
    return faces;
}

}  // namespace coseg
