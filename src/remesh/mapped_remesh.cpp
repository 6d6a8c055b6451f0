#include "src/remesh/mapped_remesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/mesh/closest_point.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/remesh/isotropic_remesh.hpp"
#include "src/remesh/strip_subdivision.hpp"

namespace coseg {

namespace {

constexpr double sharp_angle = 0.52;    // radians: creases of drawn solids stay, the facets of round ones go
constexpr double smallest_share = 0.5;  // thin limbs keep triangles that fit around them
constexpr int most_growth = 5;          // of the result, over the wanted number of faces
constexpr int most_growth_at_once = 8;
constexpr int always_allowed_at_once = 96'000;

/// Per input face the new triangle nearest to the centroid of its first old triangle; -1 where it has none.
std::vector<int> nearest_new_face(const FaceMap& map, const TriMesh& before, const TriMesh& after) {
    const std::vector<int> nearest = nearest_faces(before, after);
    std::vector<int> of_input(at(map.input_faces), -1);
    for (std::size_t f = nearest.size(); f-- > 0;) of_input[at(map.input_face[f])] = nearest[f];
    return of_input;
}

/// Remeshing visits all neighbours of a vertex once for each of them.
void refuse_crowded_vertices(const TriMesh& mesh) {
    constexpr double always_allowed = 1e7;
    constexpr double allowed_per_vertex = 400.0;
    std::vector<double> triangles(at(mesh.vertex_count()), 0.0);
    for (const int v : mesh.faces.reshaped()) triangles[at(v)] += 1.0;
    double visits = 0.0;
    for (const double count : triangles) visits += count * count;
    if (visits <= always_allowed + allowed_per_vertex * mesh.vertex_count()) return;
    const double most = *std::max_element(triangles.begin(), triangles.end());
    throw Error(ExitCode::input, std::to_string(std::llround(most)) + " triangles meet at one vertex");
}

/// Edges are halved in the order of their numbers, which makes of needles many more triangles than are
/// needed, to be collapsed again. Where that passes the budget, needles are first cut into strips.
TriMesh even_triangles(const TriMesh& mesh, double edge_length, int faces) {
    const RemeshOptions options{
        .edge_length = edge_length,
        .smallest_share = smallest_share,
        .sharp_angle = sharp_angle,
        .most_faces = most_growth * faces,
        .most_faces_at_once = std::max(always_allowed_at_once, most_growth_at_once * faces)};
    try {
        return isotropic_remesh(mesh, options);
    } catch (const Error&) {
        const std::optional<TriMesh> finer = cut_into_strips(mesh, edge_length, options.most_faces_at_once);
        if (!finer) throw;
        return isotropic_remesh(*finer, options);
    }
}

}  // namespace

void remesh_evenly(TriMesh& mesh, FaceMap& map, int faces) {
    const double area = face_geometry(mesh).total_area;
    if (!(area > 0.0)) throw Error(ExitCode::input, "a mesh without area cannot be remeshed");
    refuse_crowded_vertices(mesh);
    TriMesh even = even_triangles(mesh, edge_length_for(area, faces), faces);
    std::vector<int> input_face;
    for (const int old : nearest_faces(even, mesh)) input_face.push_back(map.input_face[at(old)]);
    map.nearest_working = nearest_new_face(map, mesh, even);
    map.input_face = std::move(input_face);
    mesh = std::move(even);
}

}  // namespace coseg
