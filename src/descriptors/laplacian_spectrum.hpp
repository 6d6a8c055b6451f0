#pragma once
// Computes the lowest eigenfunctions of a surface: the tones of a membrane of that shape.

#include <Eigen/Core>

#include "src/mesh/dual_graph.hpp"
#include "src/mesh/face_geometry.hpp"
#include "src/mesh/tri_mesh.hpp"

namespace coseg {

struct LaplacianSpectrum {
    Eigen::VectorXd eigenvalues;  ///< k, ascending, > 0; 1 / area
    /// V x k, column major: sum over v of area_v phi_i(v) phi_j(v) is 1 where i = j, else 0.
    Eigen::MatrixXd eigenfunctions;
};

/// The solutions of L phi = lambda A phi of smallest lambda without the constant one: `pairs` of them, or up
/// to a tenth fewer where the cut would go through a group of equal eigenvalues (relative 1e-3), or V - 1 if
/// there are no more. L is the cotangent Laplacian, A the vertex areas (a third of those around, never less
/// than 1e-6 of the mean). geometry = face_geometry(mesh), graph = dual_graph(mesh, geometry). A function of
/// the mesh alone; eigenfunctions are defined up to their sign and, for equal eigenvalues, up to a rotation.
///
/// Borders are free. Components that share no edge are coupled: each virtual edge of the graph is a spring of
/// weight 1, as an edge between two equilateral faces has it (4/3 of that), between the corners of its two
/// faces. There is then one constant solution, and a small component behaves as if it hung on a neck of one
/// edge. A seam that repair has cut is a border.
///
/// Lanczos with shift and invert (Spectra). Throws Error(internal) if L cannot be factorised or Lanczos does
/// not converge.
LaplacianSpectrum laplacian_spectrum(const TriMesh& mesh, const FaceGeometry& geometry,
                                     const DualGraph& graph, int pairs);

}  // namespace coseg
