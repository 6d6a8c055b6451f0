#pragma once
// Reads numbers that users give for every face of a mesh, for instance the output of a trained network.

#include <Eigen/Core>
#include <string>
#include <string_view>

namespace coseg {

/// The path FOLDER/NAME.npy or FOLDER/NAME.h5, where NAME is that of the mesh. Throws Error(input) if neither
/// or both are there.
std::string face_feature_path(const std::string& folder, const std::string& name);

/// d x F, column major: the numbers of each face of the mesh file, in the order of its faces. The file holds
/// F x d numbers, or F where d is 1: a NumPy file (.npy, versions 1 to 3, float32 or float64, little endian,
/// either order), or the dataset `features` of any HDF5 file. Double precision is rounded to single. Throws
/// Error(input) naming the file for: a file that cannot be read or is of another kind, a number of faces
/// other than `faces`, no numbers, and a number that is not finite in single precision.
Eigen::MatrixXf read_face_features(const std::string& path, int faces);

/// The same from the bytes of a NumPy file at `path`.
Eigen::MatrixXf parse_npy_features(std::string_view bytes, const std::string& path, int faces);

}  // namespace coseg
