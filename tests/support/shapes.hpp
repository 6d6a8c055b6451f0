#pragma once
// Meshes with known properties, made in code.

#include <vector>

#include "src/mesh/tri_mesh.hpp"

namespace coseg::test {

/// Icosahedron subdivided `levels` times onto the sphere: 20 * 4^levels faces.
TriMesh sphere(int levels, double radius = 1.0);

/// A closed box [0,x] x [0,y] x [0,z], each side a grid of about `cells` cells along its longest edge.
TriMesh box(double x, double y, double z, int cells);

/// A right prism over an even polygon: two fans of `sides` - 2 triangles and `sides` walls of two each.
TriMesh prism(double radius, double height, int sides);

/// A torus with nu x nv quads split in two.
TriMesh torus(double major_radius, double minor_radius, int nu, int nv);

/// The square [0,1]^2 in the plane z = 0, n x n quads split in two, with a boundary.
TriMesh flat_square(int n);

/// Faces of `b` after those of `a`, no vertex shared.
TriMesh disjoint_union(const TriMesh& a, const TriMesh& b);

/// The same surface with faces in another order (seeded), each face rotated in its corner order too.
/// `order[k]` is the old number of new face k.
TriMesh shuffled_faces(const TriMesh& mesh, unsigned seed, std::vector<int>& order);

}  // namespace coseg::test
