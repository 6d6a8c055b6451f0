// The peer of bench/speed.py: CGAL's segmentation by shape diameter with its defaults. Each mesh is
// segmented on its own.
//
//   cgal_sdf DIRECTORY MESH.off ...
//
// It writes DIRECTORY/NAME.seg with a line for each face, and prints a line for each mesh.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO.h>
#include <CGAL/mesh_segmentation.h>

#include <chrono>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Mesh read(const std::string& path) {
    Mesh mesh;
    if (!CGAL::IO::read_polygon_mesh(path, mesh) || !CGAL::is_triangle_mesh(mesh))
        throw std::runtime_error(path + ": not a manifold triangle mesh");
    return mesh;
}

void write(const std::string& path, const Mesh& mesh,
           const Mesh::Property_map<Mesh::Face_index, std::size_t>& part) {
    std::ofstream file(path);
    for (const Mesh::Face_index face : mesh.faces()) file << part[face] << '\n';
    if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
}

void segment(const std::string& path, const std::string& folder) {
    const auto start = std::chrono::steady_clock::now();
    Mesh mesh = read(path);
    const auto diameter = mesh.add_property_map<Mesh::Face_index, double>("f:diameter").first;
    const auto part = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:part").first;
    CGAL::sdf_values(mesh, diameter);
    const std::size_t parts = CGAL::segmentation_from_sdf_values(mesh, diameter, part);
    write(folder + "/" + std::filesystem::path(path).stem().string() + ".seg", mesh, part);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::cout << path << " " << mesh.number_of_faces() << " faces " << parts << " parts " << seconds.count()
              << " s\n";
}

}  // namespace

int main(int count, char** arguments) {
    if (count < 3) {
        std::cerr << "usage: cgal_sdf DIRECTORY MESH.off ...\n";
        return 2;
    }
    try {
        std::filesystem::create_directories(arguments[1]);
        for (int k = 2; k < count; ++k) segment(arguments[k], arguments[1]);
    } catch (const std::exception& error) {
        std::cerr << "cgal_sdf: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
