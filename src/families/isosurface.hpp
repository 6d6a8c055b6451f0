#pragma once
// Finds the surface where a function of space is zero, as a closed 2-manifold triangle mesh.

#include <Eigen/Geometry>
#include <functional>

#include "src/mesh/tri_mesh.hpp"

namespace coseg {

using ScalarField = std::function<double(const Eigen::Vector3d&)>;

/// Marching tetrahedra on a body-centred cubic lattice. The solid is where field < 0. It must lie inside
/// `box`, which is widened by two cells. The result is closed and manifold whatever the field is, because
/// every tetrahedron has at most one sheet and its faces are shared. Vertices lie on lattice edges, at least
/// a tenth of the edge from either end, so that no triangle is degenerate. They are hence within a tenth of
/// `spacing` of the piecewise linear zero set. `slope` is an upper bound of the field's gradient, by which
/// blocks of cells without a zero are left out; 0 means that it is not known, and all cells are searched.
/// Solids thinner than about `spacing` may be missed. Throws Error(input) if the solid reaches the edge of
/// the lattice, or if the lattice would have over 2^27 cells.
/// Source: Treece, Prager, Gee 1999, "Regularised marching tetrahedra" (the lattice and its cases).
TriMesh isosurface(const ScalarField& field, const Eigen::AlignedBox3d& box, double spacing,
                   double slope = 0.0);

}  // namespace coseg
