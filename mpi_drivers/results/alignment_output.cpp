#include "mpi_drivers/results/alignment_output.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "io/data_files/result_files.hpp"
#include "io/files/atomic_file.hpp"
#include "src/base/index.hpp"
#include "src/parallel/record_exchange.hpp"
#include "src/records/fields.hpp"

namespace coseg {

namespace {

/// Where a shape lies in its file: position p of patch_positions is (x - centre) / unit there.
struct FilePlace {
    int mesh = 0;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double unit = 1.0;
    static constexpr auto fields() {
        return std::tuple(field("mesh", &FilePlace::mesh), field("centre", &FilePlace::centre),
                          field("unit", &FilePlace::unit));
    }
};

/// The centroid of a polygon's surface by its fan of triangles; the mean of its corners if it has no area.
Eigen::Vector3d polygon_centroid(const PolygonMesh& mesh, int face) {
    const auto corner = [&](int k) { return mesh.vertices[at(mesh.corners[at(k)])]; };
    const int begin = mesh.offsets[at(face)];
    const int end = mesh.offsets[at(face) + 1];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Vector3d corners = Eigen::Vector3d::Zero();
    double area = 0.0;
    for (int k = begin; k < end; ++k) corners += corner(k) / (end - begin);
    for (int k = begin + 1; k + 1 < end; ++k) {
        const Eigen::Vector3d a = corner(begin);
        const double twice = (corner(k) - a).cross(corner(k + 1) - a).norm();
        sum += twice / 3.0 * (a + corner(k) + corner(k + 1));
        area += twice;
    }
    return area > 0.0 && std::isfinite(area) ? Eigen::Vector3d(sum / area) : corners;
}

/// Points with weights: their centroid, and the root mean square of their distance from it.
struct WeightedCloud {
    double weight = 0.0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double size = 0.0;

    WeightedCloud(const Eigen::Matrix3Xd& points, const Eigen::VectorXd& weights) {
        weight = weights.sum();
        sum = points * weights;
        if (!(weight > 0.0)) return;
        centre = sum / weight;
        size = std::sqrt((points.colwise() - centre).colwise().squaredNorm().dot(weights) / weight);
    }
};

/// The faces that the working mesh has of each input face stand for it, so that what the repair left out does
/// not count. Where they were made again by remeshing, this is nearly so.
FilePlace place_in_file(const MeshDescription& mesh) {
    const int faces = mesh.map.input_faces;
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(faces);
    Eigen::Matrix3Xd working = Eigen::Matrix3Xd::Zero(3, faces);
    for (std::size_t f = 0; f < mesh.map.input_face.size(); ++f) {
        const auto w = static_cast<Eigen::Index>(f);
        const int face = mesh.map.input_face[f];
        areas[face] += mesh.geometry.area[w];
        working.col(face) += mesh.geometry.area[w] * mesh.geometry.centroid.col(w);
    }
    Eigen::Matrix3Xd file = Eigen::Matrix3Xd::Zero(3, faces);
    for (int f = 0; f < faces; ++f) {
        if (!(areas[f] > 0.0)) continue;
        working.col(f) /= areas[f];
        file.col(f) = polygon_centroid(mesh.input, f);
    }
    const WeightedCloud in_file(file, areas);
    const WeightedCloud in_work(working, areas);
    const Eigen::VectorXd& all = mesh.geometry.area;
    const WeightedCloud surface(mesh.geometry.centroid, all);
    const double enlarged = in_work.size > 0.0 ? in_file.size / in_work.size : 1.0;
    const double unit = enlarged * surface.size / std::sqrt(3.0);
    return {mesh.mesh, in_file.centre + enlarged * (surface.centre - in_work.centre),
            unit > 0.0 ? unit : 1.0};
}

AlignedShape shape_in_file_units(const std::string& name, const ShapePose& pose, const FilePlace& place) {
    AlignedShape shape{pose, name};
    shape.scale = pose.scale / place.unit;
    shape.translation = pose.translation - shape.scale * (pose.rotation * place.centre);
    return shape;
}

}  // namespace

AlignmentFile alignment_in_file_units(const Comm& comm, const Collection& collection,
                                      const ShapeAlignment& alignment) {
    std::vector<FilePlace> local;
    agree(comm, [&] {
        for (const MeshDescription& mesh : collection.local) local.push_back(place_in_file(mesh));
    });
    std::vector<FilePlace> places = all_gather_records(comm, local);
    std::sort(places.begin(), places.end(),
              [](const FilePlace& a, const FilePlace& b) { return a.mesh < b.mesh; });
    AlignmentFile file{alignment.applied(),        alignment.reason,          alignment.standing_share,
                       alignment.agreement_before, alignment.agreement_after, {}};
    for (const FilePlace& place : places) {
        const ShapePose pose = alignment.applied() ? alignment.shapes[at(place.mesh)] : ShapePose{};
        file.shapes.push_back(shape_in_file_units(collection.meshes[at(place.mesh)].name, pose, place));
    }
    return file;
}

void write_alignment_file(const Comm& comm, const std::string& folder, const Collection& collection,
                          const ShapeAlignment& alignment) {
    const AlignmentFile file = alignment_in_file_units(comm, collection, alignment);
    agree(comm, [&] {
        if (comm.is_root()) write_file(folder + "/" + result_files::alignment, alignment_text(file));
    });
}

}  // namespace coseg
