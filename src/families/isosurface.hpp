#pragma once
// The surface where a function of space is zero, as a closed 2-manifold triangle mesh.

#include <Eigen/Geometry>
#include <functional>

#include "src/mesh/tri_mesh.hpp"

namespace coseg {

using ScalarField = std::function<double(const Eigen::Vector3d&)>;

/// Marching tetrahedra on a body-centred cubic lattice. The solid is where field < 0; it must lie inside
/// `box`, which is widened by two cells. The result is closed and manifold whatever the field: every
/// tetrahedron has at most one sheet, and its faces are shared. Vertices lie on lattice edges, at least a
/// tenth of the edge from either end (so that no triangle is degenerate), hence within a tenth of `spacing`
/// of the piecewise linear zero set. `slope`: an upper bound of the field's gradient, to pass over blocks of
/// cells without a zero; 0: not known, look everywhere. Solids thinner than about `spacing` may be missed.
/// Throws Error(input) if the solid reaches the edge of the lattice, or if the lattice would have over 2^27
/// cells. Source: Treece, Prager, Gee 1999, "Regularised marching tetrahedra" (the lattice and its cases).
TriMesh isosurface(const ScalarField& field, const Eigen::AlignedBox3d& box, double spacing,
                   double slope = 0.0);

}  // namespace coseg
