#pragma once
// Feature matrices with what is known about their columns, and the coefficients found for them, as HDF5.
// docs/formats.md describes the layouts.

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace coseg {

/// Pairs of items, and how much the two belong together apart from what the features say.
struct ItemPairs {
    std::vector<int> first;
    std::vector<int> second;
    std::vector<double> weight;
};

struct FeatureFile {
    std::vector<std::string> names;         ///< of the features, in byte order
    std::vector<Eigen::MatrixXd> features;  ///< d_h x N each; the solver refuses different N
    std::vector<int> mesh_of;             ///< N, or empty: the mesh (or whatever group) of each item, from 0
    std::vector<std::string> mesh_names;  ///< of each group, or empty
    std::vector<double> patch_area;       ///< N, or empty
    ItemPairs neighbors;                  ///< boundary lengths; may be empty
    std::vector<double> concavity;        ///< of neighbors
    ItemPairs overlaps;                   ///< intersections over unions; may be empty
};

/// Reads the group `features` and everything else of the layout that is there, from any HDF5 file. Throws
/// Error(input) where the file cannot be read or its parts do not fit together (lengths, numbers of items).
/// The values of the matrices are not checked here, but by the solver.
FeatureFile read_feature_file(const std::string& path);

/// Throws Error(output).
void write_feature_file(const std::string& path, const FeatureFile& file);

/// W by columns: column j has the entries offsets[j] .. offsets[j + 1]. Entry e is row rows[e] and has
/// `features` values.
struct CoefficientFile {
    std::int64_t size = 0;
    int features = 1;
    std::vector<std::int64_t> offsets;
    std::vector<int> rows;
    std::vector<double> values;
    double objective = 0.0;
    double lower_bound = 0.0;
    std::string reason;  ///< why the solver stopped
};

/// Throws Error(output).
void write_coefficient_file(const std::string& path, const CoefficientFile& file);

}  // namespace coseg
