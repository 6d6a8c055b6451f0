// How far coseg's average geodesic distances are from exact ones, which CGAL's shortest paths give.
//
//   geodesic_error [--faces N] [--samples N] MESH ...       one JSON object on standard output
//
// For N faces of each mesh, evenly spread over the file, the exact distance from the face's centroid to the
// centroid of every face, averaged by area, is compared with the weighted sum over coseg's sample points:
// relative errors, and the same after the best common scale, which histograms with ranges of their own a mesh
// do not see.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/mesh_files/mesh_reader.hpp"
#include "src/geodesics/geodesic.hpp"
#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/repair/mesh_repair.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Paths = CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>>;

constexpr Paths::Barycentric_coordinates centroid{{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}};

struct Request {
    int faces = 40;
    int samples = 300;
    std::vector<std::string> meshes;
};

Request request_of(int count, char** arguments) {
    Request request;
    for (int k = 1; k < count; ++k) {
        const std::string word = arguments[k];
        if (word == "--faces" && k + 1 < count)
            request.faces = std::atoi(arguments[++k]);
        else if (word == "--samples" && k + 1 < count)
            request.samples = std::atoi(arguments[++k]);
        else
            request.meshes.push_back(word);
    }
    if (request.meshes.empty() || request.faces < 1 || request.samples < 1)
        throw std::runtime_error("usage: geodesic_error [--faces N] [--samples N] MESH ...");
    return request;
}

Mesh cgal_mesh(const coseg::TriMesh& mesh) {
    Mesh result;
    for (int v = 0; v < mesh.vertex_count(); ++v)
        result.add_vertex({mesh.vertices(0, v), mesh.vertices(1, v), mesh.vertices(2, v)});
    for (int f = 0; f < mesh.face_count(); ++f) {
        result.add_face(Mesh::Vertex_index(mesh.faces(0, f)), Mesh::Vertex_index(mesh.faces(1, f)),
                        Mesh::Vertex_index(mesh.faces(2, f)));
    }
    if (static_cast<int>(result.number_of_faces()) != mesh.face_count())
        throw std::runtime_error("CGAL does not take the mesh as manifold");
    return result;
}

double exact_average(Paths& paths, const Mesh& mesh, const coseg::FaceGeometry& geometry, int from) {
    paths.remove_all_source_points();
    paths.add_source_point(Mesh::Face_index(from), centroid);
    double sum = 0.0;
    for (const Mesh::Face_index face : mesh.faces()) {
        const double distance = paths.shortest_distance_to_source_points(face, centroid).first;
        if (distance < 0.0) throw std::runtime_error("the mesh has faces that no path reaches");
        sum += distance * geometry.area[static_cast<int>(face)];
    }
    return sum / geometry.total_area;
}

void report(const std::string& path, const Request& request, bool is_first) {
    const coseg::TriMesh mesh = coseg::repair(coseg::read_mesh(path), path).mesh;
    const coseg::FaceGeometry geometry = coseg::face_geometry(mesh);
    const coseg::GeodesicTable table =
        coseg::geodesic_table(mesh, geometry, coseg::dual_graph(mesh, geometry), request.samples, 1);
    const Mesh exact_mesh = cgal_mesh(mesh);
    Paths paths(exact_mesh);
    std::vector<double> ours;
    std::vector<double> exact;
    const int count = std::min(request.faces, mesh.face_count());
    for (int k = 0; k < count; ++k) {
        const int face = static_cast<int>(static_cast<long long>(mesh.face_count()) * k / count);
        ours.push_back(table.distance.col(face).cast<double>().dot(table.sample_weight));
        exact.push_back(exact_average(paths, exact_mesh, geometry, face));
    }
    double product = 0.0;
    double square = 0.0;
    for (std::size_t k = 0; k < ours.size(); ++k) {
        product += ours[k] * exact[k];
        square += ours[k] * ours[k];
    }
    double mean = 0.0;
    double largest = 0.0;
    double largest_scaled = 0.0;
    for (std::size_t k = 0; k < ours.size(); ++k) {
        const double error = ours[k] / exact[k] - 1.0;
        mean += error / static_cast<double>(ours.size());
        largest = std::max(largest, std::abs(error));
        largest_scaled = std::max(largest_scaled, std::abs(ours[k] * product / square / exact[k] - 1.0));
    }
    std::cout << (is_first ? "" : ",\n ") << "{\"mesh\": \"" << path << "\", \"faces\": " << mesh.face_count()
              << ", \"compared\": " << ours.size() << ", \"mean_error\": " << mean
              << ", \"largest_error\": " << largest << ", \"largest_error_scaled\": " << largest_scaled << "}"
              << std::flush;
}

}  // namespace

int main(int count, char** arguments) {
    try {
        const Request request = request_of(count, arguments);
        std::cout << "{\"samples\": " << request.samples << ", \"meshes\": [\n ";
        for (std::size_t k = 0; k < request.meshes.size(); ++k) report(request.meshes[k], request, k == 0);
        std::cout << "\n]}\n";
    } catch (const std::exception& error) {
        std::cerr << "geodesic_error: " << error.what() << "\n";
        return 1;
    }
    return 0;
}
