#pragma once
// Shapes without symmetry, and meshes that are hard on geometry code.

#include <string>
#include <utility>
#include <vector>

#include "src/mesh/tri_mesh.hpp"

namespace coseg::test {

/// A closed body with one long limb, bumps and no symmetry: 20 * 4^levels faces. The limb's tip is vertex
/// nearest +x.
TriMesh limbed_body(int levels);

/// The mesh turned about a skew axis and moved.
TriMesh moved(const TriMesh& mesh, double radians);

/// Vertices slid along a fixed pattern by a fraction of the mean edge, so that no two faces are alike.
TriMesh jittered(const TriMesh& mesh, double amount);

/// Named meshes that no descriptor may choke on: a single triangle, an open square, a face without area,
/// faces with coincident corners, needles, two components, a tetrahedron, an unused vertex.
std::vector<std::pair<std::string, TriMesh>> awkward_meshes();

}  // namespace coseg::test
