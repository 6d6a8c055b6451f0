#include "src/remesh/mapped_remesh.hpp"

#include <cstddef>
#include <utility>
#include <vector>

#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/mesh/closest_point.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/remesh/isotropic_remesh.hpp"

namespace coseg {

namespace {

constexpr double sharp_angle = 0.52;    // radians: creases of drawn solids stay, the facets of round ones go
constexpr double smallest_share = 0.5;  // thin limbs keep triangles that fit around them

/// Per input face the new triangle nearest to the centroid of its first old triangle; -1 where it has none.
std::vector<int> nearest_new_face(const FaceMap& map, const TriMesh& before, const TriMesh& after) {
    const std::vector<int> nearest = nearest_faces(before, after);
    std::vector<int> of_input(at(map.input_faces), -1);
    for (std::size_t f = nearest.size(); f-- > 0;) of_input[at(map.input_face[f])] = nearest[f];
    return of_input;
}

}  // namespace

void remesh_evenly(TriMesh& mesh, FaceMap& map, int faces) {
    const double area = face_geometry(mesh).total_area;
    if (!(area > 0.0)) throw Error(ExitCode::input, "a mesh without area cannot be remeshed");
    TriMesh even = isotropic_remesh(mesh, {.edge_length = edge_length_for(area, faces),
                                           .smallest_share = smallest_share,
                                           .sharp_angle = sharp_angle});
    std::vector<int> input_face;
    for (const int old : nearest_faces(even, mesh)) input_face.push_back(map.input_face[at(old)]);
    map.nearest_working = nearest_new_face(map, mesh, even);
    map.input_face = std::move(input_face);
    mesh = std::move(even);
}

}  // namespace coseg
